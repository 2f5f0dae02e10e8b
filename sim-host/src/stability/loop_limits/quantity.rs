//! What a limit is sought of, and where it is looked for.

use super::search::{Ladder, Tolerance};
use serde::{Deserialize, Serialize};
use surefoot::model::robots::biped;
use surefoot_sim::scene::{Feet, Scene};

/// A quantity of a scene that can be made harder until the loop fails.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Quantity {
    /// Largest speed of the thrown block, m/s; its direction and start stay.
    BlockSpeed,
    /// Lowest rate of the controller, Hz.
    ControlRate,
    /// Longest delay from a measurement to its torques, s.
    Delay,
    /// Lowest friction, static and dynamic alike.
    Friction,
    /// Largest scale of the gains: s for positions, √s for velocities, so that damping ratios stay.
    GainScale,
    /// Highest set point, m, towards the straight knee.
    SetPointHeight,
    /// Largest noise of the inertial sensors, in multiples of [`GYROSCOPE_NOISE`] and
    /// [`ACCELEROMETER_NOISE`]; encoders are exact.
    Noise,
    /// Smallest torque limits, as a share of those of [`biped::LIMITS`].
    TorqueShare,
}

/// Density of a cheap gyroscope's noise, rad/s/√Hz: 0.005 °/s/√Hz, of InvenSense's MPU-6050
/// (PS-MPU-6000A-00, revision 3.4, §6.1).
pub const GYROSCOPE_NOISE: f64 = 0.005 * std::f64::consts::PI / 180.0;
/// Density of its accelerometer's, m/s²/√Hz: 400 µg/√Hz (§6.2).
pub const ACCELEROMETER_NOISE: f64 = 400e-6 * 9.806_65;

impl Quantity {
    /// All, in the order of the table.
    pub const ALL: [Self; 8] = [
        Self::BlockSpeed,
        Self::ControlRate,
        Self::Delay,
        Self::Friction,
        Self::GainScale,
        Self::SetPointHeight,
        Self::Noise,
        Self::TorqueShare,
    ];

    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::BlockSpeed => "largest block speed",
            Self::ControlRate => "lowest control rate",
            Self::Delay => "longest delay",
            Self::Friction => "lowest friction",
            Self::GainScale => "largest gain scale",
            Self::SetPointHeight => "highest set point",
            Self::Noise => "largest sensor noise",
            Self::TorqueShare => "smallest torque limits",
        }
    }

    /// Its unit; multiples are `×`, plain numbers have none.
    pub fn unit(self) -> &'static str {
        match self {
            Self::BlockSpeed => "m/s",
            Self::ControlRate => "Hz",
            Self::Delay => "s",
            Self::SetPointHeight => "m",
            Self::GainScale | Self::Noise | Self::TorqueShare => "×",
            Self::Friction => "",
        }
    }

    /// What the scene itself has, where that is one number.
    pub fn of(self, scene: &Scene) -> Option<f64> {
        match self {
            Self::BlockSpeed => scene.block.map(|block| speed(&block.velocity_mps)),
            Self::ControlRate => Some(scene.controller.rate_hz),
            Self::Delay => Some(scene.acting.delay_s),
            Self::Friction => match &scene.feet {
                Feet::Floor { floor, .. } => Some(floor.static_friction),
                Feet::Welded {} => None,
            },
            Self::GainScale => Some(1.0),
            Self::SetPointHeight => Some(scene.set_point.position_m[2]),
            Self::Noise | Self::TorqueShare => None,
        }
    }

    /// Where its limit is looked for; `None` where the scene has no such thing: no block that moves, no
    /// floor.
    pub fn ladder(self, scene: &Scene) -> Option<Ladder> {
        let own = self.of(scene);
        Some(match self {
            Self::BlockSpeed => {
                let own = own.filter(|speed| speed.is_normal())?;
                Ladder::Geometric { from: 0.25 * own, ratio: 1.25, to: 16.0 * own }
            }
            Self::ControlRate => Ladder::Geometric { from: own?.max(1000.0), ratio: 0.8, to: 2.0 },
            Self::Delay => Ladder::Arithmetic { from: 0.0, step: 2e-3, to: 0.2 },
            Self::Friction => Ladder::Geometric { from: own?.max(1.0), ratio: 0.8, to: 0.01 },
            Self::GainScale => Ladder::Geometric { from: 1.0, ratio: 1.25, to: 1e4 },
            Self::SetPointHeight => Ladder::Arithmetic { from: own?, step: 5e-3, to: own? + 0.5 },
            Self::Noise => Ladder::Geometric { from: 0.1, ratio: 1.5, to: 1e5 },
            Self::TorqueShare => Ladder::Geometric { from: 1.0, ratio: 0.9, to: 0.01 },
        })
    }

    /// How near a limit is bisected.
    pub fn tolerance(self) -> Tolerance {
        match self {
            Self::Delay => Tolerance::Absolute(1e-4),
            Self::SetPointHeight => Tolerance::Absolute(5e-4),
            _ => Tolerance::Relative(0.01),
        }
    }

    /// Sets it in a scene that has it.
    pub fn set(self, scene: &mut Scene, value: f64) {
        match self {
            Self::BlockSpeed => {
                if let Some(block) = &mut scene.block {
                    let scale = value / speed(&block.velocity_mps);
                    block.velocity_mps = block.velocity_mps.map(|v| v * scale);
                }
            }
            Self::ControlRate => scene.controller.rate_hz = value,
            Self::Delay => scene.acting.delay_s = value,
            Self::Friction => {
                if let Feet::Floor { floor, .. } = &mut scene.feet {
                    (floor.static_friction, floor.dynamic_friction) = (value, value);
                }
            }
            Self::GainScale => {
                let settings = &mut scene.controller;
                for gain in [&mut settings.position_gain, &mut settings.orientation_gain] {
                    *gain = gain.map(|k| k * value);
                }
                for gain in [&mut settings.velocity_gain, &mut settings.angular_velocity_gain] {
                    *gain = gain.map(|k| k * value.sqrt());
                }
            }
            Self::SetPointHeight => scene.set_point.position_m[2] = value,
            Self::Noise => {
                scene.sensing.encoder_counts = 0;
                scene.sensing.gyroscope_noise = value * GYROSCOPE_NOISE;
                scene.sensing.accelerometer_noise = value * ACCELEROMETER_NOISE;
            }
            Self::TorqueShare => {
                let leg = biped::LIMITS.joints[0];
                scene.acting.torque_limits_nm = Some(leg.map(|joint| joint.torque * value));
            }
        }
    }
}

fn speed(velocity: &[f64; 3]) -> f64 {
    velocity.iter().map(|v| v * v).sum::<f64>().sqrt()
}

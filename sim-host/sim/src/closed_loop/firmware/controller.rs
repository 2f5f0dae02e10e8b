//! The controller on a target, in place of the host's.

use super::{LinkError, Target, Transport, image};
use crate::closed_loop::gait::GaitTally;
use crate::closed_loop::limiting::{Given, LimitTally};
use crate::closed_loop::walking::{self, WalkStart};
use crate::closed_loop::whole_body_settings::{Standing, firmware_id};
use crate::closed_loop::{Commanded, ControlFailure, Controller, Costs};
use crate::plant::PlantState;
use crate::robot::{LEG, Robot, SharedRobot, with_tree};
use crate::scene::{Scene, WalkCommand, Workspace};
use surefoot::balance::{Ground, JointLimits, Sole, StopReason, Thresholds};
use surefoot_link::{
    Clock, Counter, Joints, MOST_FEET, Pacing, Sensors, SetPoint, Settings, StanceSettings,
    ToTarget, Torques, WalkOrder, WalkerSettings, WrenchSettings,
};

/// A target that balances a scene's plant, in lock step with it.
pub struct FirmwareController<const JOINTS: usize> {
    target: Target<JOINTS>,
    robot: SharedRobot,
    /// What each tick has cost, in the target's unit.
    costs: Vec<u32>,
    stopped: Option<StopReason>,
    /// Of the next tick, s.
    time_s: f64,
    /// Feet that touch the ground then, as bits.
    contacts: u8,
    /// Of ticks within limits.
    tally: Option<LimitTally>,
    /// In which of them some limit bound.
    limited: Vec<bool>,
    /// Of a robot that walks.
    walk: Option<Walk>,
}

/// What a robot that walks is asked.
struct Walk {
    commands: Vec<WalkCommand>,
    /// The last that was told.
    told: Option<WalkOrder>,
    /// Normal forces on its feet at the next tick, N.
    forces: Joints<f32, MOST_FEET>,
    /// So far.
    steps: u32,
}

/// A scene's controller on a target of its robot.
///
/// # Errors
/// A [`LinkError`].
pub fn firmware_controller<T: Transport + 'static>(
    transport: T,
    scene: &Scene,
) -> Result<Box<dyn Controller>, LinkError> {
    with_tree!(&scene.robot().tree, _tree, LEGS => {
        let target = Target::<{ LEG * LEGS }>::connect(transport)?;
        Ok(Box::new(FirmwareController::new(target, scene)?))
    }, _tree, ROWS => {
        let target = Target::<{ LEG * ROWS }>::connect(transport)?;
        Ok(Box::new(FirmwareController::new(target, scene)?))
    })
}

impl<const JOINTS: usize> FirmwareController<JOINTS> {
    /// Configures a target for a scene, and arms it.
    ///
    /// # Errors
    /// [`LinkError::AnotherRobot`] for a target that has been built for another one than the scene's, or another
    /// [`LinkError`].
    pub fn new(mut target: Target<JOINTS>, scene: &Scene) -> Result<Self, LinkError> {
        let robot = scene.robot();
        let wanted = firmware_id(scene)
            .ok_or_else(|| LinkError::NoFirmware { robot: robot.name.clone() })?;
        let found = target.identity().robot;
        if wanted != found {
            let (name, command) = (robot.name.clone(), image::command(scene));
            return Err(LinkError::AnotherRobot { name, wanted, found, command });
        }
        if let Clock::Internal(reason) = target.identity().clock {
            eprintln!("the board runs without its crystal: {reason}");
        }
        target.order("disarm", &ToTarget::Disarm)?;
        target.order("configure", &ToTarget::Configure(settings(scene)))?;
        let walks = !scene.walk.is_empty();
        let is_limited = if robot.tree.is_six_jointed() && !walks {
            let limits = wrench_settings(scene);
            if let Some(limits) = &limits {
                target.order("limits of ground and motors", &ToTarget::Limit(limits.clone()))?;
            }
            limits.is_some()
        } else {
            target.order("how the robot stands", &ToTarget::Stand(stance_settings(scene)))?;
            true
        };
        let mut pose = set_point(scene);
        if walks {
            let WalkStart { stature, heading, height } = walking::start(scene);
            let settings = WalkerSettings::of(&stature, heading);
            target.order("how the robot walks", &ToTarget::Walker(settings))?;
            // Where the supervisor expects it.
            pose.position[2] = height;
        }
        target.order("set point", &ToTarget::SetPoint(pose))?;
        target.order("arm", &ToTarget::Arm(wanted))?;
        let (costs, stopped) = (Vec::new(), None);
        let tally = is_limited.then(LimitTally::default);
        let (time_s, contacts, limited) = (0.0, u8::MAX, Vec::new());
        let (commands, told) = (scene.walk.clone(), None);
        let forces = Joints::new([0.0; MOST_FEET], robot.feet.len());
        let walk = walks.then_some(Walk { commands, told, forces, steps: 0 });
        Ok(Self { target, robot, costs, stopped, time_s, contacts, tally, limited, walk })
    }

    /// What each tick has cost, in the target's unit.
    pub fn tick_costs(&self) -> &[u32] {
        &self.costs
    }

    /// In which ticks some limit of ground or motors bound.
    pub fn limited_ticks(&self) -> &[bool] {
        &self.limited
    }

    /// The target.
    pub fn target(&mut self) -> &mut Target<JOINTS> {
        &mut self.target
    }

    /// One tick.
    ///
    /// # Errors
    /// A [`LinkError`].
    pub fn exchange(&mut self, state: &PlantState) -> Result<Torques<JOINTS>, LinkError> {
        let mut sensors = Sensors { contacts: self.contacts, ..sensors(state) };
        if let Some(walk) = &mut self.walk {
            let asked = WalkOrder::from(&walking::asked::<f32>(&walk.commands, self.time_s));
            if walk.told != Some(asked) {
                self.target.order("walk", &ToTarget::Walk(asked))?;
                walk.told = Some(asked);
            }
            sensors.forces = walk.forces;
        }
        let torques = self.target.tick(&sensors)?;
        if let Some(walk) = &mut self.walk {
            walk.steps = torques.steps;
        }
        self.costs.push(torques.cost);
        self.limited.push(torques.limits.is_some_and(|limits| limits.is_active));
        Ok(torques)
    }
}

/// What sensors read of a state, in single precision; numbers that it does not have are NaN, which no target takes. All
/// feet touch the ground.
pub fn sensors<const JOINTS: usize>(state: &PlantState) -> Sensors<JOINTS> {
    fn of<const N: usize>(all: &[f64], from: usize) -> [f32; N] {
        std::array::from_fn(|i| all.get(from + i).copied().unwrap_or(f64::NAN) as f32)
    }
    let PlantState { positions, velocities } = state;
    let joints = state.joints();
    Sensors {
        position: of(positions, 0),
        orientation: of(positions, 3),
        velocity: of(velocities, 0),
        joint_angles: Joints::new(of(positions, 7), joints),
        joint_rates: Joints::new(of(velocities, 6), joints),
        contacts: u8::MAX,
        forces: Joints::new([0.0; MOST_FEET], 0),
    }
}

/// A scene's settings in single precision, with its robot's limits.
pub fn settings<const JOINTS: usize>(scene: &Scene) -> Settings<JOINTS> {
    let settings = &scene.controller;
    let (limits, thresholds) = single_precision(scene);
    let none = JointLimits { torque: f32::NAN, angle: [f32::NAN; 2], rate: f32::NAN };
    Settings {
        period: (1.0 / settings.rate_hz) as f32,
        pacing: Pacing::LockStep,
        gains: gains(scene),
        big_base: match settings.workspace {
            Workspace::FixedFoot => None,
            Workspace::BigBase(factor) => Some(factor as f32),
        },
        joint_limits: joints(&limits, none, scene),
        thresholds,
    }
}

/// Limits of the scene's robot.
fn single_precision(scene: &Scene) -> (Vec<JointLimits<f32>>, Thresholds<f32>) {
    let robot = scene.robot();
    if !scene.walk.is_empty() {
        return with_tree!(&robot.tree, _tree, ROWS => {
            walking_single::<ROWS>(&robot)
        }, _tree, ROWS => walking_single::<ROWS>(&robot));
    }
    with_tree!(&robot.tree, _tree, LEGS => {
        let limits = robot.limits.sized::<LEGS>().expect("a robot has limits for each of its joints");
        let limits = limits.to_f32();
        (limits.joints.as_flattened().to_vec(), limits.thresholds)
    }, _tree, ROWS => {
        let limits = robot.limits.in_rows::<ROWS>().expect("rows for each of its joints").to_f32();
        (limits.joints.as_flattened().to_vec(), limits.thresholds)
    })
}

/// The same of a robot that walks.
fn walking_single<const ROWS: usize>(robot: &Robot) -> (Vec<JointLimits<f32>>, Thresholds<f32>) {
    let limits =
        walking::walking_limits(&robot.limits).in_rows::<ROWS>().expect("rows for its joints");
    let limits = limits.to_f32();
    (limits.joints.as_flattened().to_vec(), limits.thresholds)
}

/// Diagonals of a scene's gain matrices, in the order of `Gains`.
pub(super) fn gains(scene: &Scene) -> [[f32; 3]; 4] {
    let settings = &scene.controller;
    let all = [
        settings.position_gain,
        settings.velocity_gain,
        settings.orientation_gain,
        settings.angular_velocity_gain,
    ];
    all.map(|gain| gain.map(|x| x as f32))
}

/// A scene's limits of ground and motors, if it has any, in single precision.
pub fn wrench_settings<const JOINTS: usize>(scene: &Scene) -> Option<WrenchSettings<JOINTS>> {
    let Given { ground, soles, torques } = Given::by(scene)?;
    let single = |range: [f64; 2]| range.map(|x| x as f32);
    let sole = |sole: &Sole<f64>| Sole { x: single(sole.x), y: single(sole.y), z: sole.z as f32 };
    Some(WrenchSettings {
        ground: Ground {
            least_force: ground.least_force as f32,
            greatest_force: ground.greatest_force as f32,
            friction: ground.friction as f32,
        },
        soles: soles.iter().map(sole).collect(),
        torques: joints(&single_precision_of(&torques), f32::NAN, scene),
    })
}

/// How the robot of a scene stands, in single precision.
fn stance_settings<const JOINTS: usize>(scene: &Scene) -> StanceSettings<JOINTS> {
    let Standing { height, gravity, ground, torques, posture } = Standing::of(scene);
    StanceSettings {
        ground: Ground {
            least_force: ground.least_force as f32,
            greatest_force: ground.greatest_force as f32,
            friction: ground.friction as f32,
        },
        height: height as f32,
        gravity: gravity as f32,
        torques: joints(&single_precision_of(&torques), f32::NAN, scene),
        posture: joints(&single_precision_of(&posture), f32::NAN, scene),
    }
}

fn single_precision_of(all: &[f64]) -> Vec<f32> {
    all.iter().map(|x| *x as f32).collect()
}

/// An entry for each joint of a scene's robot.
fn joints<T: Copy, const JOINTS: usize>(all: &[T], missing: T, scene: &Scene) -> Joints<T, JOINTS> {
    let entries = std::array::from_fn(|joint| all.get(joint).copied().unwrap_or(missing));
    Joints::new(entries, scene.robot().joint_count())
}

/// A scene's set point in single precision.
pub fn set_point(scene: &Scene) -> SetPoint {
    SetPoint {
        position: scene.set_point.position_m.map(|x| x as f32),
        orientation: scene.set_point.orientation.map(|x| x as f32),
    }
}

impl<const JOINTS: usize> Controller for FirmwareController<JOINTS> {
    fn stopped(&self) -> Option<StopReason> {
        self.stopped
    }

    fn touch(&mut self, time_s: f64, feet: &[bool]) {
        (self.time_s, self.contacts) = (time_s, Sensors::<JOINTS>::contact_bits(feet));
    }

    fn press(&mut self, time_s: f64, normal_forces: &[f64]) {
        self.time_s = time_s;
        if let Some(walk) = &mut self.walk {
            for (to, force) in walk.forces.iter_mut().zip(normal_forces) {
                *to = *force as f32;
            }
        }
    }

    fn gait(&self) -> Option<GaitTally> {
        let walk = self.walk.as_ref()?;
        Some(GaitTally { steps: walk.steps, told_s: walking::told(&walk.commands) })
    }

    fn limits(&self) -> Option<LimitTally> {
        self.tally.clone()
    }

    fn costs(&self) -> Option<Costs> {
        let identity = self.target.identity();
        let sum: f64 = self.costs.iter().map(|cost| f64::from(*cost)).sum();
        Some(Costs {
            unit: match identity.counter {
                Counter::Cycles => "cycles",
                Counter::Instructions => "instructions",
            },
            per_second: identity.per_second,
            min: *self.costs.iter().min()?,
            mean: sum / self.costs.len() as f64,
            max: *self.costs.iter().max()?,
        })
    }

    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let torques = self.exchange(state)?;
        self.stopped = torques.reason;
        if let (Some(tally), Some(limits)) = (&mut self.tally, &torques.limits) {
            tally.count_tick(&self.robot, self.time_s, limits);
        }
        Ok(Commanded {
            torques: torques.joint_torques.iter().map(|x| f64::from(*x)).collect(),
            desired_wrench: torques.desired_wrench.map(f64::from),
        })
    }
}

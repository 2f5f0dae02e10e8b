//! The motion of `vectors/estimate_vectors.py`, and what sensors read of it.

use nalgebra::Vector3;
use std::f64::consts::TAU;
use surefoot::Real;
use surefoot::estimate::{
    Estimator, EstimatorState, FootKind, FootReading, ImuReading, Readings, StartPose,
};
use surefoot::spatial::Quaternion;

/// Seconds a tick, and how many there are.
pub const PERIOD: f64 = 0.002;
pub const TICKS: u32 = 5000;
pub const GRAVITY: f64 = 9.81;
pub const BIAS_F: Vector3<f64> = Vector3::new(0.1, -0.1, 0.1);
pub const BIAS_W: Vector3<f64> = Vector3::new(0.01, -0.01, 0.01);

/// What the robot does at a time.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    pub position: Vector3<f64>,
    /// World axes.
    pub velocity: Vector3<f64>,
    pub orientation: Quaternion<f64>,
}

/// Three numbers between −1 and 1 that look random.
fn noise(tick: u32, channel: u32) -> Vector3<f64> {
    let k = f64::from(tick);
    Vector3::from_fn(|axis, _| {
        ((0.37 + 0.11 * f64::from(channel) + 0.017 * axis as f64) * k * k).sin()
    })
}

fn wave(t: f64, amplitude: f64, frequency: f64) -> [f64; 2] {
    let w = TAU * frequency;
    [amplitude * (1.0 - (w * t).cos()), amplitude * w * (w * t).sin()]
}

pub fn truth(t: f64) -> Truth {
    let [x, y, z] = [wave(t, 0.08, 0.1), wave(t, 0.02, 0.9), wave(t, -0.01, 1.7)];
    let about = |axis: Vector3<f64>, angle: f64| Quaternion::from_axis_angle(axis, angle);
    let yaw = about(Vector3::z(), wave(t, 0.1, 0.23)[0]);
    let pitch = about(Vector3::y(), wave(t, 0.03, 1.1)[0]);
    let roll = about(Vector3::x(), wave(t, -0.04, 0.8)[0]);
    Truth {
        position: Vector3::new(x[0], y[0], 0.9 + z[0]),
        velocity: Vector3::new(x[1], y[1], z[1]),
        orientation: yaw.product(pitch).product(roll),
    }
}

/// Which stance a foot is in, and whether it stands.
fn stance(tick: u32, foot: u32) -> (u32, bool) {
    if tick < 500 {
        return (0, true);
    }
    let (step, tick) = ((tick - 500) / 250, (tick - 500) % 250);
    let swings = step % 2 == foot;
    let made = if tick >= 200 || !swings { (step + 2 - foot) / 2 } else { (step - foot) / 2 };
    (made, !(swings && tick < 200))
}

/// Where a foot stands.
fn stood(number: u32, foot: u32) -> (Vector3<f64>, Quaternion<f64>) {
    let (n, side) = (f64::from(number), if foot == 0 { 0.1 } else { -0.1 });
    let yaw = Quaternion::from_axis_angle(Vector3::z(), 0.02 * n);
    let tilt = Quaternion::from_rotation_vector(Vector3::new(0.005, 0.01 + 0.002 * n, 0.0));
    (Vector3::new(0.02 * n, side + 0.003 * n, 0.001 * n), yaw.product(tilt))
}

/// The rotation vector of a quaternion near one.
fn logarithm(q: Quaternion<f64>) -> Vector3<f64> {
    let sine = q.v.norm();
    if sine < 1e-12 { q.v * 2.0 } else { q.v * (2.0 * sine.atan2(q.s) / sine) }
}

/// What is read at a tick.
pub fn readings(tick: u32) -> Readings<f64, 2> {
    let t = f64::from(tick) * PERIOD;
    let now = truth(t);
    let up = Vector3::new(0.0, 0.0, GRAVITY);
    let imu = if tick == 0 {
        let accelerometer = now.orientation.conjugate().rotate(up) + BIAS_F;
        ImuReading { accelerometer, gyroscope: BIAS_W }
    } else {
        let (before, middle) = (truth(t - PERIOD), truth(t - 0.5 * PERIOD));
        let turn = before.orientation.conjugate().product(now.orientation);
        let acceleration = (now.velocity - before.velocity) / PERIOD + up;
        ImuReading {
            accelerometer: middle.orientation.conjugate().rotate(acceleration)
                + BIAS_F
                + noise(tick, 1) * 0.02,
            gyroscope: logarithm(turn) / PERIOD + BIAS_W + noise(tick, 0) * 2e-3,
        }
    };
    let back = now.orientation.conjugate();
    let feet = [0, 1].map(|foot| {
        let (number, stands) = stance(tick, foot);
        let (p, phi) = stood(number, foot);
        let error = Quaternion::from_rotation_vector(noise(tick, 4 + foot) * 1e-3);
        FootReading {
            position: back.rotate(p - now.position) + noise(tick, 2 + foot) * 2e-4,
            orientation: back.product(phi).product(error),
            is_pressed: stands,
            is_planned: stands,
        }
    });
    Readings { imu, feet, feet_force: None }
}

/// The same in another precision.
pub fn rounded<T: Real>(readings: &Readings<f64, 2>) -> Readings<T, 2> {
    Readings {
        imu: ImuReading {
            accelerometer: readings.imu.accelerometer.map(T::of),
            gyroscope: readings.imu.gyroscope.map(T::of),
        },
        feet: readings.feet.map(|foot| FootReading {
            position: foot.position.map(T::of),
            orientation: Quaternion::from_array(foot.orientation.to_array().map(T::of)),
            is_pressed: foot.is_pressed,
            is_planned: foot.is_planned,
        }),
        feet_force: readings.feet_force.map(|force| force.map(T::of)),
    }
}

/// Two soles, standard noise.
pub fn soles<T: Real>() -> Estimator<T, 2> {
    Estimator::new(T::of(PERIOD), T::of(GRAVITY), [Some(FootKind::Sole); 2])
}

/// Started at tick 0.
pub fn started<T: Real>(settings: &Estimator<T, 2>) -> EstimatorState<T, 2> {
    let at_rest = rounded(&readings(0));
    EstimatorState::start(settings, &at_rest, &StartPose::origin()).expect("at rest")
}

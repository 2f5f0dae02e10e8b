//! The state estimator has no panicking path.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;
use nalgebra::Vector3;
use surefoot::balance::{ContactLimits, ContactPatch, WholeBodyFoot};
use surefoot::estimate::{
    Estimator, EstimatorState, Floor, FootKind, FootReading, ImuReading, Readings, StartPose, Turn,
    foot_poses,
};
use surefoot::model::robots::biped;
use surefoot::spatial::Quaternion;

/// A start and a step of which the optimiser knows nothing but the number of feet.
#[inline(always)]
fn opaque_estimate<const FEET: usize>() {
    let kinds = [Some(FootKind::Sole), Some(FootKind::Point), None, Some(FootKind::Sole)];
    let settings = black_box(Estimator {
        floor: Floor::LevelAt(0.0),
        turn: Turn::One,
        ..Estimator::<f32, FEET>::new(2e-3, 9.81, core::array::from_fn(|i| kinds[i % 4]))
    });
    let foot = FootReading {
        position: Vector3::new(0.0, 0.1, -1.0),
        orientation: Quaternion::identity(),
        is_pressed: true,
        is_planned: true,
    };
    let readings = Readings {
        imu: ImuReading { accelerometer: Vector3::z() * 9.81, gyroscope: Vector3::zeros() },
        feet: [foot; FEET],
        feet_force: Some(Vector3::z() * 700.0),
    };
    let pose = black_box(StartPose::origin());
    let start = EstimatorState::start(&settings, &black_box(readings), &pose);
    let Ok(mut state) = black_box(start) else { return };
    let report = settings.step(&mut state, &black_box(readings));
    black_box((report.is_ok(), state.deviations(), state));
}

/// Where feet of any bodies are, by encoders that read anything.
#[inline(always)]
fn opaque_feet() {
    let patch = black_box(ContactPatch::sole([-0.2, 0.05], [-0.05, 0.05], -0.06));
    let limits = ContactLimits {
        least_force: 5.0,
        greatest_force: 2000.0,
        friction: 0.24,
        patch,
        torques: [],
    };
    let foot = |body| WholeBodyFoot {
        body,
        reference: Vector3::zeros(),
        axes: Quaternion::identity(),
        limits,
    };
    let feet = black_box([Some(foot(6)), Some(foot(usize::MAX)), None, Some(foot(12))]);
    let tree = black_box(&biped::TREE_F32);
    black_box(foot_poses(tree, &feet, &black_box([0.1; 19])));
}

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    opaque_estimate::<2>();
    opaque_estimate::<4>();
    opaque_feet();
    panic_free::halt()
}

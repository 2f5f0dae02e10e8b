//! Legs from bent to straight: nothing leaps, nothing grows without bound, and what is lost is reported.

use super::command;
use nalgebra::Vector3;
use surefoot::Real;
use surefoot::balance::{
    ContactLimits, ContactPatch, Reference, WholeBodyFoot, WholeBodySettings, WholeBodyState,
};
use surefoot::model::Tree;
use surefoot::model::robots::biped;
use surefoot::spatial::Quaternion;

fn feet<T: Real>() -> [Option<WholeBodyFoot<T>>; 4] {
    let range = |a, b| [T::of(a), T::of(b)];
    let limits = ContactLimits {
        least_force: T::of(5.0),
        greatest_force: T::of(3000.0),
        friction: T::of(0.6),
        patch: ContactPatch::sole(range(-0.12, 0.12), range(-0.05, 0.05), T::of(-0.03)),
        torques: [],
    };
    let (reference, axes) = (Vector3::zeros(), Quaternion::identity());
    let foot = |body| Some(WholeBodyFoot { body, reference, axes, limits });
    [foot(biped::FEET[0]), foot(biped::FEET[1]), None, None]
}

/// Greatest torque, greatest acceleration that a foot keeps, whether a leg was singular, and the greatest
/// step of a torque from the knee angle before, while knees go from 30° to 0 (and a little beyond).
fn straighten<T: Real>(tree: &Tree<T, 13, 19, 18>, lift: f64) -> (f64, f64, Vec<bool>, f64) {
    let (mut most, mut lost, mut step) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut singular, mut last) = (Vec::new(), None::<[T; 18]>);
    let settings = WholeBodySettings {
        torques: biped_torques(),
        ..WholeBodySettings::<T, 18>::scaled(T::of(1.1), T::of(9.81), 2)
    };
    for tick in 0..=320 {
        let knee = (30.0 - 0.1 * f64::from(tick)).to_radians();
        let mut positions = [T::zero(); 19];
        positions[3] = T::one();
        for leg in 0..2 {
            for (k, share) in [(1, 0.5), (3, -1.0), (5, 0.5)] {
                positions[7 + 6 * leg + k] = T::of(share * knee);
            }
        }
        let position = Vector3::new(T::zero(), T::zero(), T::of(lift));
        let reference = Reference::at_rest(position, Quaternion::identity());
        let state = WholeBodyState { positions, velocities: [T::zero(); 18] };
        let out = command(tree, &feet(), &settings, &state, &reference).expect("torques");
        for torque in out.torques {
            most = most.max(torque.to_f64().abs());
        }
        for left in out.limits.singular.iter().flatten() {
            lost = lost.max(left.linear.norm().to_f64());
        }
        singular.push(out.limits.singular.iter().any(Option::is_some));
        if let Some(last) = last {
            for (a, b) in last.iter().zip(&out.torques) {
                step = step.max((*a - *b).to_f64().abs());
            }
        }
        last = Some(out.torques);
    }
    (most, lost, singular, step)
}

fn biped_torques<T: Real>() -> [T; 18] {
    let mut torques = [T::zero(); 18];
    let all = biped::LIMITS.joints;
    for (to, joint) in torques[6..].iter_mut().zip(all.as_flattened()) {
        *to = T::of(joint.torque);
    }
    torques
}

#[test]
fn a_knee_may_be_straight() {
    for (most, lost, singular, step) in [
        straighten(&biped::TREE, 0.0),
        straighten(&biped::TREE, -0.01),
        straighten(&biped::TREE, 0.02),
        straighten(&biped::TREE_F32, 0.0),
        straighten(&biped::TREE_F32, 0.02),
    ] {
        // Measured: 51.7 N·m, 3.4 N·m in 0.1 degrees, 1.8 m/s².
        assert!(most < 60.0 && step < 4.0 && lost < 2.0, "{most} {step} {lost}");
        // Exact at 30 degrees, damped from 6 degrees to straight.
        assert!(!singular[0] && singular[300]);
        let changes = singular.windows(2).take(300).filter(|pair| pair[0] != pair[1]).count();
        assert_eq!(changes, 1);
    }
}

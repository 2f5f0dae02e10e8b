//! What joints bear, from how momenta change: for every engine alike, whatever its own coordinates.
//!
//! # Notation
//! `P, L` linear and angular momentum about the world's origin of all that hangs from a joint, `x̄` means of positions
//! over a step `h`, `f` forces of the floor
//! ```text
//! F = ΔP/h + Σ m g ẑ − Σ f,   T = ΔL/h + Σ x̄ × m g ẑ − Σ r̄ × f,   about the joint's point p̄: T − p̄ × F
//! ```
//! Bodies of a tree only: of what hangs from two joints, momenta say what both bear together.

use super::layout::{Layout, LayoutKind, Rods};
use super::named_joint::{JointKind, NamedJoint};
use super::run::{Earlier, MechanismSample};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{BodyState, System};

/// What a joint bears: of the inboard body (or the world) on the outboard one, mean over the step before, world frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reaction {
    /// N
    pub force: Vector3<f64>,
    /// About the joint's point, N·m; that of a motor, spring or damper is part of it.
    pub torque: Vector3<f64>,
}

/// Two instants, one step apart.
struct Step<'a> {
    h: f64,
    x: [&'a [f64]; 2],
    v: [&'a [f64]; 2],
}

impl Layout {
    /// Whether momenta say what joints bear.
    pub fn has_reactions(&self) -> bool {
        match &self.kind {
            LayoutKind::Orientation => false,
            LayoutKind::Rods(_) => true,
            // What else acts between bodies would have to be told from what joints bear.
            LayoutKind::Bodies(system) => {
                system.closures().is_empty()
                    && system.springs().is_empty()
                    && system.rolling().is_empty()
                    && !self.joints.is_empty()
            }
        }
    }

    /// What all joints bear at a sample; none at the first one, and where a step was made in shorter ones.
    pub fn reactions(&self, samples: &[MechanismSample], sample: usize) -> Option<Vec<Reaction>> {
        let now = &samples[sample];
        let (time_s, x, v) = match &now.earlier {
            Earlier::Unknown => return None,
            Earlier::SampleBefore => {
                let before = &samples[sample.checked_sub(1)?];
                (before.time_s, &before.configuration, &before.velocity)
            }
            Earlier::State { time_s, configuration, velocity } => {
                (*time_s, configuration, velocity)
            }
        };
        let step =
            Step { h: now.time_s - time_s, x: [x, &now.configuration], v: [v, &now.velocity] };
        match &self.kind {
            _ if !self.has_reactions() => None,
            LayoutKind::Orientation => None,
            LayoutKind::Rods(rods) => Some(of_rods(rods, &step)),
            LayoutKind::Bodies(system) => Some(self.of_tree(system, &step, &now.contact_forces)),
        }
    }

    fn of_tree(&self, system: &System, step: &Step<'_>, floor: &[[f64; 3]]) -> Vec<Reaction> {
        let [x0, x1]: [&[BodyState]; 2] = step.x.map(|x| x.as_chunks().0);
        let [v0, v1]: [&[BodyState]; 2] = step.v.map(|v| v.as_chunks().0);
        let mean =
            |body: usize, at: Vector3<f64>| 0.5 * (placed(&x0[body], at) + placed(&x1[body], at));
        let links = system.links();
        // About the world's origin.
        let mut all: Vec<Reaction> = (0..links.len())
            .map(|k| {
                let body = &links[k].body;
                let ((p0, l0), (p1, l1)) =
                    (body.momentum(&x0[k], &v0[k]), body.momentum(&x1[k], &v1[k]));
                let weight = Vector3::z() * (body.mass * system.gravity());
                let change =
                    |a: [f64; 3], b: [f64; 3]| (Vector3::from(b) - Vector3::from(a)) / step.h;
                Reaction {
                    force: change(p0, p1) + weight,
                    torque: change(l0, l1) + mean(k, Vector3::zeros()).cross(&weight),
                }
            })
            .collect();
        for (point, force) in self.points.iter().zip(floor) {
            let force = Vector3::from(*force);
            all[point.body].force -= force;
            all[point.body].torque -= mean(point.body, point.at).cross(&force);
        }
        for k in (0..links.len()).rev() {
            if let Some(inboard) = links[k].inboard {
                let Reaction { force, torque } = all[k];
                all[inboard].force += force;
                all[inboard].torque += torque;
            }
        }
        let of = |named: &NamedJoint| {
            let Reaction { force, torque } = all[named.outboard];
            let at = match &named.kind {
                JointKind::Bodies(joint) => joint.outboard.into(),
                JointKind::Rod => Vector3::zeros(),
            };
            Reaction { force, torque: torque - mean(named.outboard, at).cross(&force) }
        };
        self.joints.iter().map(of).collect()
    }
}

/// Rods bear forces only, along themselves.
fn of_rods(rods: &Rods, step: &Step<'_>) -> Vec<Reaction> {
    let [v0, v1]: [&[[f64; 3]]; 2] = step.v.map(|v| v.as_chunks().0);
    let mut below = Vector3::zeros();
    let mut all: Vec<Reaction> = (0..rods.masses.len())
        .rev()
        .map(|k| {
            let change = (Vector3::from(v1[k]) - Vector3::from(v0[k])) / step.h;
            below += (change + Vector3::z() * rods.gravity) * rods.masses[k];
            Reaction { force: below, torque: Vector3::zeros() }
        })
        .collect();
    all.reverse();
    all
}

fn placed(&[x, y, z, ref q @ ..]: &BodyState, at: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(x, y, z) + Quaternion::from_array(*q).rotate(at)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::run;
    use crate::scene::{AnyScene, MechanismScene, open, parse};

    fn scene(name: &str) -> MechanismScene {
        match open(name).expect("a built-in scene") {
            AnyScene::Mechanism(scene) => scene,
            AnyScene::Robot(_) => panic!("{name} is a mechanism"),
        }
    }

    fn played(scene: &MechanismScene) -> (Layout, Vec<MechanismSample>) {
        let run = run(scene, &mut |_| {}).expect("a start");
        assert_eq!(run.failure, None);
        (Layout::of(&scene.mechanism).expect("as it was run"), run.samples)
    }

    /// A thin rod of mass m and length l on a hinge at its end, let go from level: at an angle θ below level its hinge
    /// bears `5/2 m g sin θ` along it and `¼ m g cos θ` across.
    #[test]
    fn a_falling_rod_pulls_at_its_hinge_as_the_textbook_has_it() {
        let text = "
            description = \"a rod on a hinge\"
            duration_s = 0.7
            [integrator]
            name = \"variational\"
            step_s = 1e-3
            [mechanism]
            kind = \"multibody\"
            gravity_m_s2 = 10.0
            [[mechanism.bodies]]
            name = \"rod\"
            mass_kg = 3.0
            inertia_kg_m2 = [0.00001, 1.0, 1.0]
            center_m = [1.0, 0.0, 0.0]
            joint = { kind = \"revolute\", point_m = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0] }
        ";
        let AnyScene::Mechanism(scene) = parse("rod", text).expect("a scene") else { panic!() };
        let (layout, samples) = played(&scene);
        assert_eq!(layout.reactions(&samples, 0), None);
        for i in [200, 450, 700] {
            // Mean over the step before: as at its middle.
            let angle = |k: usize| {
                let x = &samples[k].configuration;
                (-x[2]).atan2(x[0])
            };
            let (sin, cos) = (0.5 * (angle(i - 1) + angle(i))).sin_cos();
            let (along, across) = (2.5 * 30.0 * sin, 0.25 * 30.0 * cos);
            // Towards the hinge, and upwards across the rod.
            let expected =
                Vector3::new(-along * cos + across * sin, 0.0, along * sin + across * cos);
            let found = layout.reactions(&samples, i).expect("a tree")[0];
            // Off by at most 6e-5 N, of second order in the step, and 2e-12 N·m.
            assert!((found.force - expected).norm() < 1.2e-4, "{found:?} against {expected}");
            assert!(found.torque.norm() < 1e-11, "a free hinge: {found:?}");
        }
    }

    /// What hangs at rest bears what hangs below it; so does a pendulum of point masses.
    #[test]
    fn joints_of_a_hanging_chain_bear_the_weight_below() {
        let mut chain = scene("chain");
        chain.duration_s = 0.1;
        chain.integrator.name = surefoot_mechanics::integrators::Method::Variational;
        if let crate::scene::Mechanism::Chain { bend_deg, .. } = &mut chain.mechanism {
            *bend_deg = 0.0;
        }
        let (layout, samples) = played(&chain);
        let last = layout.reactions(&samples, samples.len() - 1).expect("a tree");
        for (k, reaction) in last.iter().enumerate() {
            let weight = 9.81 * (10 - k) as f64;
            assert!(
                (reaction.force - Vector3::z() * weight).norm() < 1e-15 * weight,
                "{reaction:?}"
            );
            assert!(reaction.torque.norm() < 1e-15, "{reaction:?}");
        }
    }

    /// The rod's force of a pendulum is along the rod: `m (g cos θ + l ω²)` of one.
    #[test]
    fn a_pendulums_rod_pulls_along_itself() {
        let mut pendulum = scene("spherical-pendulum");
        pendulum.duration_s = 1.0;
        pendulum.integrator.step_s = 1e-3;
        let (layout, samples) = played(&pendulum);
        let of = layout.reactions(&samples, samples.len() - 1).expect("rods");
        let x = &samples[samples.len() - 1].configuration;
        let last = of.len() - 1;
        let rod = Vector3::from_row_slice(&x[3 * last..])
            - if last > 0 {
                Vector3::from_row_slice(&x[3 * last - 3..3 * last])
            } else {
                Vector3::zeros()
            };
        let pull = of[last].force;
        // The direction is that half a step ago: off by 9.5e-4.
        assert!(pull.cross(&rod).norm() < 2e-3 * pull.norm() * rod.norm(), "{pull} along {rod}");
        assert!(pull.dot(&rod) < 0.0);
    }
}

//! Force on one contact point over a whole step of an implicit method, and how it answers to the step's end.
//!
//! # Notation
//! As in [`super::point`], with `p₀, p₁` the point at the step's ends, `v = (p₁ − p₀)/h`, and `p̄` their mean.
//! ```text
//! at-midpoint:    F_n = −(k_n p̄_n + b_n v_n) where p̄_n < 0                                      (§5.3)
//! within-the-step: F_n = 1/h ∫ max(0, −(k_n p_n + b_n v_n)) [p_n < 0] dt,  p from p₀ to p₁ in a line  (1)
//! ```
//! By (1) a point that meets the floor in the midst of a step feels it for the rest of the step. That keeps
//! the order of the method at touch-down and lift-off (§5.5 asks for it), and makes the force continuous
//! where the other jumps by `b_n v_n`, so that a step's equations have a solution in every case.

use super::{Conditions, ContactPoint, ContactState, Floor};
use nalgebra::{Matrix3, Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// When a point enters and leaves the floor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, clap::ValueEnum)]
#[serde(rename_all = "kebab-case")]
pub enum Switching {
    /// For the whole step that has its middle below the floor.
    AtMidpoint,
    /// When it does, on the straight line between the step's ends.
    #[default]
    WithinTheStep,
}

/// Mean force of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepForce {
    /// N, world frame.
    pub force: Vector3<f64>,
    /// Its derivative with respect to `p₁`, N/m.
    pub slope: Matrix3<f64>,
    /// The point's memory after the step.
    pub point: ContactPoint,
}

impl StepForce {
    /// What the force's numbers are made of, in absolute values, N: of a point that is this far from the origin, m.
    /// Nothing where there is no force.
    #[inline]
    pub fn terms(&self, away: f64) -> f64 {
        if self.force.z == 0.0 {
            return 0.0;
        }
        let (f, k) = (&self.force, &self.slope);
        let slope = k.m11.abs() + k.m22.abs() + k.m33.abs();
        f.x.abs() + f.y.abs() + f.z.abs() + slope * away
    }
}

/// `F_n` and its derivative with respect to the height at the end.
fn normal_force(floor: &Floor, switching: Switching, z0: f64, way: f64, h: f64) -> (f64, f64) {
    let (k, b) = (floor.normal_stiffness, floor.normal_damping);
    let (z1, v) = (z0 + way, way / h);
    let all = (-(k * (z0 + 0.5 * way) + b * v), -(0.5 * k + b / h));
    if switching == Switching::AtMidpoint {
        return if z0 + 0.5 * way < 0.0 { all } else { (0.0, 0.0) };
    }
    // Height below which the floor presses.
    let (c, c_slope) = if v > 0.0 { (-b * v / k, -b / (k * h)) } else { (0.0, 0.0) };
    match (z0 < c, z1 < c) {
        (true, true) => all,
        (false, false) => (0.0, 0.0),
        // Entering. With c = 0: share z₁/(z₁ − z₀) of the step, at a mean height of z₁/2.
        (false, true) => {
            let share = z1 / way;
            let share_slope = -z0 / (way * way);
            let force = -(0.5 * k * z1 + b * v);
            (share * force, share_slope * force - share * (0.5 * k + b / h))
        }
        // Leaving: from k (c − z₀) to zero, over a share (c − z₀)/(z₁ − z₀).
        (true, false) => {
            let depth = c - z0;
            let force = 0.5 * k * depth * depth / way;
            (force, k * depth * c_slope / way - force / way)
        }
    }
}

impl ContactPoint {
    /// The force over a step from `p₀` by `way = p₁ − p₀`, with the transitions of that step. The state
    /// entered acts in the same step.
    #[inline(always)]
    pub fn over_step(
        &self,
        floor: &Floor,
        switching: Switching,
        p0: Vector3<f64>,
        way: Vector3<f64>,
        h: f64,
    ) -> StepForce {
        let start = self.state.settled();
        let (normal, normal_slope) = normal_force(floor, switching, p0.z, way.z, h);
        let below_floor = match switching {
            Switching::AtMidpoint => p0.z + 0.5 * way.z < 0.0,
            Switching::WithinTheStep => p0.z + way.z < 0.0 || normal > 0.0,
        };
        let v_t = way.xy() / h;
        let speed = v_t.norm();
        let mean = p0.xy() + way.xy() * 0.5;
        let (k, b) = (floor.tangential_stiffness, floor.tangential_damping);
        let held = -((mean - self.anchor) * k + v_t * b);
        let conditions = Conditions {
            below_floor,
            pulls: normal <= 0.0,
            slow: speed <= floor.zero_velocity_threshold,
            slips: held.norm() > floor.static_friction * normal,
        };
        let mut state = start.next(conditions);
        if start == ContactState::Free && state == ContactState::Sliding {
            state = state.next(conditions);
        }
        let mut result = StepForce {
            force: Vector3::zeros(),
            slope: Matrix3::zeros(),
            point: Self { state, anchor: self.anchor, slide: v_t },
        };
        // Friction: μ times the normal force along u, whose derivative is u_slope.
        let (friction, along, along_slope) = match state {
            ContactState::Free | ContactState::NegativeNormalForce => return result,
            ContactState::Sliding | ContactState::SlidingToSticking => {
                if state == ContactState::SlidingToSticking {
                    result.point.anchor = mean;
                }
                let zvt = floor.zero_velocity_threshold;
                let (u, slope) =
                    if speed <= zvt { (v_t / zvt, 1.0 / zvt) } else { (v_t / speed, 1.0 / speed) };
                let radial = if speed <= zvt { 0.0 } else { slope };
                (-floor.dynamic_friction, u, (slope, radial, 1.0 / h))
            }
            ContactState::Sticking => {
                result.set_normal(normal, normal_slope);
                result.force.x = held.x;
                result.force.y = held.y;
                let stiffness = -(0.5 * k + b / h);
                result.slope[(0, 0)] = stiffness;
                result.slope[(1, 1)] = stiffness;
                return result;
            }
            ContactState::StickingToSliding => {
                let size = held.norm();
                (floor.static_friction, held / size, (1.0 / size, 1.0 / size, -(0.5 * k + b / h)))
            }
        };
        result.set_normal(normal, normal_slope);
        let (slope, radial, chain) = along_slope;
        let unit: Vector2<f64> = if radial > 0.0 { along } else { Vector2::zeros() };
        for i in 0..2 {
            result.force[i] = friction * normal * along[i];
            result.slope[(i, 2)] = friction * normal_slope * along[i];
            for j in 0..2 {
                let straight = if i == j { slope } else { 0.0 };
                result.slope[(i, j)] =
                    friction * normal * chain * (straight - radial * unit[i] * unit[j]);
            }
        }
        result
    }

    /// Energy that the floor's springs hold with the point at rest at `p`, J.
    pub fn spring_energy(&self, floor: &Floor, p: &Vector3<f64>) -> f64 {
        let depth = p.z.min(0.0);
        let stretch = match self.state.settled() {
            ContactState::Sticking => (p.xy() - self.anchor).norm_squared(),
            _ => 0.0,
        };
        let held = if self.state == ContactState::Free { 0.0 } else { stretch };
        0.5 * (floor.normal_stiffness * depth * depth + floor.tangential_stiffness * held)
    }
}

impl StepForce {
    fn set_normal(&mut self, force: f64, slope: f64) {
        self.force.z = force;
        self.slope[(2, 2)] = slope;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Floor = Floor { static_friction: 0.5, ..Floor::RUBBER };
    const H: f64 = 1e-3;

    fn cases() -> Vec<(ContactPoint, Vector3<f64>, Vector3<f64>)> {
        let at = |state, x: f64, y: f64| ContactPoint {
            state,
            anchor: Vector2::new(x, y),
            slide: Vector2::zeros(),
        };
        let mut all = Vec::new();
        for state in [ContactState::Free, ContactState::Sliding, ContactState::Sticking] {
            for (z0, z1) in [
                (-2e-3, -1.5e-3),
                (1e-4, -4e-4),
                (1e-4, -5e-5),
                (-3e-4, -2.9e-4),
                (-2e-3, 1e-4),
                (-8e-3, 1e-4),
                (1e-3, 2e-3),
            ] {
                for step in [2e-3, 3e-7] {
                    for anchor in [1e-3, 0.2] {
                        all.push((
                            at(state, 0.3 + anchor, 0.1 - 0.3 * anchor),
                            Vector3::new(0.3, 0.1, z0),
                            Vector3::new(0.3 + 0.8 * step, 0.1 - 0.6 * step, z1),
                        ));
                    }
                }
            }
        }
        all
    }

    #[test]
    fn slopes_are_derivatives() {
        for switching in [Switching::AtMidpoint, Switching::WithinTheStep] {
            for (point, p0, p1) in cases() {
                let at = |p: Vector3<f64>| point.over_step(&FLOOR, switching, p0, p - p0, H);
                let here = at(p1);
                for j in 0..3 {
                    let mut d = Vector3::zeros();
                    d[j] = 1e-9;
                    let slope = (at(p1 + d).force - at(p1 - d).force) / 2e-9;
                    let apart = (slope - here.slope.column(j)).norm();
                    let size = here.slope.norm().max(1.0);
                    assert!(
                        apart < 1e-5 * size,
                        "{switching:?} {point:?} {p0} {p1}: {slope} {here:?}"
                    );
                }
            }
        }
    }

    /// (1) by quadrature.
    #[test]
    fn the_normal_force_is_the_mean_over_the_step() {
        for (_, p0, p1) in cases() {
            let n = 100_000;
            let v = (p1.z - p0.z) / H;
            let mean = (0..n)
                .map(|i| {
                    let z = p0.z + (p1.z - p0.z) * (i as f64 + 0.5) / n as f64;
                    let force = -(FLOOR.normal_stiffness * z + FLOOR.normal_damping * v);
                    if z < 0.0 { force.max(0.0) } else { 0.0 }
                })
                .sum::<f64>()
                / n as f64;
            let (force, _) = normal_force(&FLOOR, Switching::WithinTheStep, p0.z, p1.z - p0.z, H);
            assert!((force - mean).abs() < 1e-4 * mean.max(1.0), "{p0} {p1}: {force} {mean}");
        }
    }

    /// At the midpoint it jumps where a point enters; within the step it does not, anywhere.
    #[test]
    fn only_the_midpoint_rule_jumps() {
        let largest_jump = |switching| {
            (0..20_000)
                .map(|i| 2e-3 - 4e-3 * f64::from(i) / 20_000.0)
                .map(|z1| normal_force(&FLOOR, switching, 1e-3, z1 - 1e-3, H).0)
                .fold((0.0_f64, None::<f64>), |(jump, last), force| {
                    (jump.max(last.map_or(0.0, |last| (force - last).abs())), Some(force))
                })
                .0
        };
        assert!(largest_jump(Switching::AtMidpoint) > 3000.0);
        assert!(largest_jump(Switching::WithinTheStep) < 5.0);
    }

    #[test]
    fn the_floor_never_pulls_and_friction_stays_in_its_cone() {
        for (point, p0, p1) in cases() {
            for switching in [Switching::AtMidpoint, Switching::WithinTheStep] {
                let StepForce { force, point: after, .. } =
                    point.over_step(&FLOOR, switching, p0, p1 - p0, H);
                assert!(force.z >= 0.0);
                assert!(
                    force.xy().norm() <= FLOOR.static_friction * force.z * (1.0 + 1e-12),
                    "{after:?}"
                );
            }
        }
    }
}

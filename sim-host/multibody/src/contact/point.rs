//! Force on one contact point, and its state after it.
//!
//! # Notation
//! World frame, z the floor's normal: `p_n`, `p_t` position normal and along the floor, `a_t` anchor.
//! ```text
//! F_n = −(k_n p_n + b_n ṗ_n)
//! sliding:  F_t = −μ_d F_n ṗ_t / max(|ṗ_t|, zvt)
//! sticking: F_t = −(k_t (p_t − a_t) + b_t ṗ_t), clipped to μ_s F_n when it slips
//! ```

use super::{Conditions, ContactState, Floor};
use nalgebra::{Vector2, Vector3};
use serde::{Deserialize, Serialize};

/// A contact point's memory: its state, and where it sticks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ContactPoint {
    /// State at the end of the last evaluation.
    pub state: ContactState,
    /// `a_t`, m; has a meaning in states 3 and 4.
    pub anchor: Vector2<f64>,
    /// Velocity along the floor when last evaluated, m/s; has a meaning in state 2.
    pub slide: Vector2<f64>,
}

/// What a point's evaluation gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointForce {
    /// Force on the point, N, world frame.
    pub force: Vector3<f64>,
    /// The point's memory after it.
    pub point: ContactPoint,
    /// Energy held by the floor's springs, J.
    pub spring_energy: f64,
}

impl Default for ContactPoint {
    fn default() -> Self {
        Self::FREE
    }
}

impl ContactPoint {
    /// A point that touches nothing.
    pub const FREE: Self = Self {
        state: ContactState::Free,
        anchor: Vector2::new(0.0, 0.0),
        slide: Vector2::new(0.0, 0.0),
    };

    /// The force at a position and velocity, with the transitions they cause. The state entered acts
    /// at once; a point entering the floor slides, and may come to rest, in the same evaluation.
    ///
    /// A sliding point whose velocity has turned back since the last evaluation was at rest in
    /// between, and counts as slow. Without this, friction that changes the velocity by more than
    /// the threshold in one step drives the point to and fro for ever.
    pub fn evaluate(
        &self,
        floor: &Floor,
        position: Vector3<f64>,
        velocity: Vector3<f64>,
    ) -> PointForce {
        let start = self.state.settled();
        let p_t = position.xy();
        let v_t = velocity.xy();
        let normal = -(floor.normal_stiffness * position.z + floor.normal_damping * velocity.z);
        let speed = v_t.norm();
        let turned_back = start == ContactState::Sliding && self.slide.dot(&v_t) < 0.0;
        let held =
            -((p_t - self.anchor) * floor.tangential_stiffness + v_t * floor.tangential_damping);
        let conditions = Conditions {
            below_floor: position.z < 0.0,
            pulls: normal < 0.0,
            slow: speed <= floor.zero_velocity_threshold || turned_back,
            slips: held.norm() > floor.static_friction * normal,
        };
        let mut state = start.next(conditions);
        if start == ContactState::Free && state == ContactState::Sliding {
            state = state.next(conditions);
        }

        let sliding =
            || v_t * (-floor.dynamic_friction * normal / speed.max(floor.zero_velocity_threshold));
        let mut anchor = self.anchor;
        let (normal, tangential) = match state {
            ContactState::Free | ContactState::NegativeNormalForce => (0.0, Vector2::zeros()),
            ContactState::Sliding => (normal, sliding()),
            ContactState::SlidingToSticking => {
                anchor = p_t;
                (normal, sliding())
            }
            ContactState::Sticking => (normal, held),
            ContactState::StickingToSliding => {
                (normal, held * (floor.static_friction * normal / held.norm()))
            }
        };
        let depth = position.z.min(0.0);
        let stretch = if state == ContactState::Sticking { p_t - anchor } else { Vector2::zeros() };
        PointForce {
            force: Vector3::new(tangential.x, tangential.y, normal),
            point: Self { state, anchor, slide: v_t },
            spring_energy: 0.5
                * (floor.normal_stiffness * depth * depth
                    + floor.tangential_stiffness * stretch.norm_squared()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Floor = Floor::RUBBER;

    fn at(state: ContactState, anchor: [f64; 2]) -> ContactPoint {
        ContactPoint { state, anchor: Vector2::from(anchor), slide: Vector2::zeros() }
    }

    #[test]
    fn free_points_feel_nothing() {
        let result = ContactPoint::default().evaluate(
            &FLOOR,
            Vector3::new(0.0, 0.0, 1e-9),
            Vector3::new(1.0, 0.0, -1.0),
        );
        assert_eq!(result.force, Vector3::zeros());
        assert_eq!(result.point.state, ContactState::Free);
    }

    #[test]
    fn touch_down_slides_at_once() {
        let result = ContactPoint::default().evaluate(
            &FLOOR,
            Vector3::new(0.0, 0.0, -1e-4),
            Vector3::new(0.6, -0.8, -0.1),
        );
        // 75000 · 1e-4 + 2000 · 0.1 = 207.5 N; friction 0.3 of it against the motion.
        assert!((result.force - Vector3::new(-37.35, 49.8, 207.5)).norm() < 1e-9);
        assert_eq!(result.point.state, ContactState::Sliding);
    }

    #[test]
    fn a_slow_point_sticks_where_it_is() {
        let p = Vector3::new(0.3, 0.1, -1e-3);
        let slow =
            at(ContactState::Sliding, [0.0; 2]).evaluate(&FLOOR, p, Vector3::new(5e-4, 0.0, 0.0));
        assert_eq!(slow.point.state, ContactState::SlidingToSticking);
        assert_eq!(slow.point.anchor, Vector2::new(0.3, 0.1));
        assert!((slow.force.x + 0.3 * 75.0 * 0.5).abs() < 1e-9);
        let later = slow.point.evaluate(&FLOOR, p + Vector3::x() * 1e-5, Vector3::zeros());
        assert_eq!(later.point.state, ContactState::Sticking);
        assert!((later.force - Vector3::new(-0.75, 0.0, 75.0)).norm() < 1e-9);
    }

    #[test]
    fn a_point_that_turned_back_sticks() {
        let p = Vector3::new(0.3, 0.1, -1e-3);
        let sliding =
            at(ContactState::Sliding, [0.0; 2]).evaluate(&FLOOR, p, Vector3::new(4e-3, 0.0, 0.0));
        assert_eq!(sliding.point.state, ContactState::Sliding);
        let onward = sliding.point.evaluate(&FLOOR, p, Vector3::new(0.0, 3e-3, 0.0));
        assert_eq!(onward.point.state, ContactState::Sliding);
        let back = sliding.point.evaluate(&FLOOR, p, Vector3::new(-4e-3, 0.0, 0.0));
        assert_eq!(back.point.state, ContactState::SlidingToSticking);
        // Friction does not push harder than the cone in the state between.
        assert!((back.force.xy().norm() - 0.3 * 75.0).abs() < 1e-9);
    }

    #[test]
    fn a_point_pulled_too_hard_slips_on_the_cone() {
        let stuck = at(ContactState::Sticking, [0.0; 2]);
        let result = stuck.evaluate(&FLOOR, Vector3::new(0.03, 0.04, -1e-3), Vector3::zeros());
        assert_eq!(result.point.state, ContactState::StickingToSliding);
        assert!((result.force.xy().norm() - 0.3 * 75.0).abs() < 1e-9);
        assert!(result.force.x < 0.0 && result.force.y < 0.0);
    }

    #[test]
    fn the_floor_never_pulls() {
        for state in [ContactState::Sliding, ContactState::Sticking] {
            let result = at(state, [0.0; 2]).evaluate(
                &FLOOR,
                Vector3::new(0.0, 0.0, -1e-4),
                Vector3::new(0.0, 0.0, 1.0),
            );
            assert_eq!(result.force, Vector3::zeros());
            assert_eq!(result.point.state, ContactState::NegativeNormalForce);
        }
    }
}

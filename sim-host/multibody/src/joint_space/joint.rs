//! One joint's coordinates: where they begin, how they change, and how a body moves with them.

use super::super::body::BodyState;
use super::super::joint::{Joint, JointConstraint};
use super::kinematics::{Body, Dof};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

/// The body that hangs from `on` by a joint, with the joint's degrees of freedom; accelerations are those where `u̇ = 0`.
pub(super) fn moved(joint: &Joint, on: &Body, q: &[f64], u: &[f64], dofs: &mut Vec<Dof>) -> Body {
    let point = on.center + on.turn.rotate(joint.inboard.into());
    let home = Quaternion::from_array(joint.home);
    // Velocities and accelerations of the inboard body's point at the joint.
    let arm = point - on.center;
    let at_point = (on.velocity_at(&arm), on.acceleration_at(&arm));
    let hung = |turn: Quaternion<f64>, omega: Vector3<f64>, alpha: Vector3<f64>| {
        let arm = -turn.rotate(joint.outboard.into());
        let body = Body {
            center: point + arm,
            turn,
            omega,
            alpha,
            velocity: at_point.0 + omega.cross(&arm),
            acceleration: at_point.1 + alpha.cross(&arm) + omega.cross(&omega.cross(&arm)),
            last: on.last,
        };
        (body, point)
    };
    let mut about = |axis: Vector3<f64>, point: Vector3<f64>, last: &mut Option<usize>| {
        dofs.push(Dof { angular: axis, linear: Vector3::zeros(), point, parent: *last });
        *last = Some(dofs.len() - 1);
    };
    match &joint.constraint {
        JointConstraint::Fixed => hung(on.turn.product(home), on.omega, on.alpha).0,
        JointConstraint::Revolute { axis } => {
            let axis = Vector3::from(*axis);
            let turn = on.turn.product(home).product(Quaternion::from_axis_angle(axis, q[0]));
            let along = turn.rotate(axis);
            let alpha = on.alpha + on.omega.cross(&along) * u[0];
            let (mut body, point) = hung(turn, on.omega + along * u[0], alpha);
            about(along, point, &mut body.last);
            body
        }
        JointConstraint::Universal { outboard_axis, inboard_axis } => {
            let (first, second) = (Vector3::from(*inboard_axis), Vector3::from(*outboard_axis));
            let between = on.turn.product(Quaternion::from_axis_angle(first, q[0])).product(home);
            let turn = between.product(Quaternion::from_axis_angle(second, q[1]));
            let (first, second) = (on.turn.rotate(first), between.rotate(second));
            let middle = on.omega + first * u[0];
            let alpha = on.alpha + on.omega.cross(&first) * u[0] + middle.cross(&second) * u[1];
            let (mut body, point) = hung(turn, middle + second * u[1], alpha);
            about(first, point, &mut body.last);
            about(second, point, &mut body.last);
            body
        }
        JointConstraint::Spherical => {
            let turn = on.turn.product(unit(q));
            let own = turn.rotate(Vector3::new(u[0], u[1], u[2]));
            let (mut body, point) = hung(turn, on.omega + own, on.alpha + on.omega.cross(&own));
            for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
                about(turn.rotate(axis), point, &mut body.last);
            }
            body
        }
        JointConstraint::Prismatic { axis } => {
            let turn = on.turn.product(home);
            let along = on.turn.rotate((*axis).into());
            let center = point + along * q[0] - turn.rotate(joint.outboard.into());
            let arm = center - on.center;
            let linear = along;
            let zero = Vector3::zeros();
            dofs.push(Dof { angular: zero, linear, point: zero, parent: on.last });
            Body {
                center,
                turn,
                velocity: on.velocity_at(&arm) + along * u[0],
                acceleration: on.acceleration_at(&arm) + on.omega.cross(&along) * (2.0 * u[0]),
                last: Some(dofs.len() - 1),
                ..*on
            }
        }
        // What is free is free of its inboard body.
        JointConstraint::Floating => {
            let turn = unit(&q[3..]);
            let center = Vector3::new(q[0], q[1], q[2]);
            let mut last = None;
            for linear in [Vector3::x(), Vector3::y(), Vector3::z()] {
                let zero = Vector3::zeros();
                dofs.push(Dof { angular: zero, linear, point: zero, parent: last });
                last = Some(dofs.len() - 1);
            }
            for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
                let (angular, linear) = (turn.rotate(axis), Vector3::zeros());
                dofs.push(Dof { angular, linear, point: center, parent: last });
                last = Some(dofs.len() - 1);
            }
            Body {
                center,
                turn,
                velocity: Vector3::new(u[0], u[1], u[2]),
                omega: turn.rotate(Vector3::new(u[3], u[4], u[5])),
                last,
                ..Body::WORLD
            }
        }
    }
}

fn unit(q: &[f64]) -> Quaternion<f64> {
    let given = Quaternion::from_array([q[0], q[1], q[2], q[3]]);
    given.normalized().unwrap_or(given)
}

/// Rates of a joint's coordinates.
pub(super) fn rates(constraint: &JointConstraint, q: &[f64], u: &[f64], rates: &mut [f64]) {
    let turning = |q: &[f64], omega: &[f64], to: &mut [f64]| {
        let q = Quaternion::from_array([q[0], q[1], q[2], q[3]]);
        to.copy_from_slice(&q.rate(Vector3::new(omega[0], omega[1], omega[2])).to_array());
    };
    match constraint {
        JointConstraint::Spherical => turning(q, u, rates),
        JointConstraint::Floating => {
            rates[..3].copy_from_slice(&u[..3]);
            turning(&q[3..], &u[3..], &mut rates[3..]);
        }
        _ => rates.copy_from_slice(u),
    }
}

/// Where among a joint's coordinates a unit quaternion is.
pub(super) fn quaternion(constraint: &JointConstraint) -> Option<usize> {
    match constraint {
        JointConstraint::Spherical => Some(0),
        JointConstraint::Floating => Some(3),
        _ => None,
    }
}

/// A body's pose and velocities in world axes.
struct Seen {
    center: Vector3<f64>,
    turn: Quaternion<f64>,
    velocity: Vector3<f64>,
    omega: Vector3<f64>,
}

impl Seen {
    fn of(x: &BodyState, v: &BodyState) -> Self {
        let turn = Quaternion::from_array([x[3], x[4], x[5], x[6]]);
        let rate = Quaternion::from_array([v[3], v[4], v[5], v[6]]);
        // q̇ = ½ q ⋆ (0, ω)
        let own = turn.conjugate().product(rate).v * 2.0;
        Self {
            center: Vector3::new(x[0], x[1], x[2]),
            turn,
            velocity: Vector3::new(v[0], v[1], v[2]),
            omega: turn.rotate(own),
        }
    }
}

/// A joint's coordinates and velocities where the bodies are: (outboard state, rate), (inboard state, rate).
pub(super) fn start(
    joint: &Joint,
    (x_o, v_o): (&BodyState, &BodyState),
    (x_i, v_i): (&BodyState, &BodyState),
    (q, u): (&mut Vec<f64>, &mut Vec<f64>),
) {
    let (o, i) = (Seen::of(x_o, v_o), Seen::of(x_i, v_i));
    let apart = o.omega - i.omega;
    let relative = i.turn.conjugate().product(o.turn);
    let own = |axis: &[f64; 3]| o.turn.rotate((*axis).into());
    match &joint.constraint {
        JointConstraint::Fixed => {}
        JointConstraint::Revolute { axis } => {
            let turned = Quaternion::from_array(joint.home).conjugate().product(relative);
            q.push(2.0 * turned.v.dot(&Vector3::from(*axis)).atan2(turned.s));
            u.push(own(axis).dot(&apart));
        }
        JointConstraint::Universal { outboard_axis, inboard_axis } => {
            // (c₁ + s₁ a) ⋆ (c₂ + s₂ b) = c₁c₂ + s₁c₂ a + c₁s₂ b + s₁s₂ a × b
            let home = Quaternion::from_array(joint.home);
            let turned = relative.product(home.conjugate());
            let (a, b) = (Vector3::from(*inboard_axis), home.rotate((*outboard_axis).into()));
            q.push(2.0 * turned.v.dot(&a).atan2(turned.s));
            q.push(2.0 * turned.v.dot(&b).atan2(turned.s));
            u.push(i.turn.rotate(a).dot(&apart));
            u.push(own(outboard_axis).dot(&apart));
        }
        JointConstraint::Spherical => {
            q.extend(relative.to_array());
            u.extend(o.turn.conjugate().rotate(apart).iter());
        }
        JointConstraint::Prismatic { axis } => {
            let along = i.turn.rotate((*axis).into());
            let (at_o, at_i) =
                (o.turn.rotate(joint.outboard.into()), i.turn.rotate(joint.inboard.into()));
            q.push(along.dot(&(o.center + at_o - i.center - at_i)));
            let arm = o.center - i.center;
            u.push(along.dot(&(o.velocity - i.velocity - i.omega.cross(&arm))));
        }
        JointConstraint::Floating => {
            q.extend(x_o);
            u.extend(o.velocity.iter());
            u.extend(o.turn.conjugate().rotate(o.omega).iter());
        }
    }
}

//! Constraints beside the tree: rows of their rates, and what is left of their second derivatives.
//!
//! # Notation
//! `o, i` outboard and inboard body; `d` from the inboard body's point to the outboard one's; `w, v` axes fixed in the
//! outboard and the inboard body; `c` a wheel's centre, `e` its axis, `n` the plane's normal, `ρ` from the centre to the
//! lowest point; `a⁰, α⁰` accelerations where `u̇ = 0`:
//! ```text
//! along v:  v·d = 0,   rate v·ḋ + (ω_i × v)·d,
//!           rest v·d̈⁰ + 2 (ω_i × v)·ḋ + (α⁰_i × v + ω_i × (ω_i × v))·d                                  (1)
//! square:   v·w = 0,   rate (ω_o − ω_i)·(w × v),
//!           rest (α⁰_o − α⁰_i)·(w × v) + (ω_o − ω_i)·((ω_o × w) × v + w × (ω_i × v))                    (2)
//! rolling:  ċ + ω × ρ = 0,   rest a⁰ + α⁰ × ρ + ω × ρ̇,   and along n the position n·(c + ρ) = n·ground    (3)
//!           ρ = −r m/‖m‖,   m = n − (n·e) e;   of a ball ρ = −r n
//! ```

use super::super::closure::Closing;
use super::super::joint::{JointConstraint, across, rotated};
use super::super::planar_loops::InPlane;
use super::super::rolling::Rolling;
use super::super::system::System;
use super::kinematics::{Body, Kinematics};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;

type V3 = Vector3<f64>;

/// A constraint.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// Degrees of freedom, descending, and what the rate is of each.
    pub entries: Vec<(usize, f64)>,
    /// What is left of the second derivative.
    pub rest: f64,
    /// Of the position; zero for what has none.
    pub error: f64,
}

impl Row {
    pub fn rate(&self, u: &[f64]) -> f64 {
        self.entries.iter().map(|(i, x)| x * u[*i]).sum()
    }
}

/// What a row takes of a body: of the velocity of its point with an arm, and of its angular velocity.
struct Part {
    link: Option<usize>,
    arm: V3,
    linear: V3,
    angular: V3,
}

/// Rows of all closures, then of all that roll.
pub(super) fn rows(system: &System, planar: &[Option<InPlane>], now: &Kinematics) -> Vec<Row> {
    let mut all = Vec::new();
    for (closure, in_plane) in system.closures().iter().zip(planar) {
        // Others are refused when the equations are made.
        let Closing::Joint(joint) = &closure.closing else { continue };
        let (outboard, inboard) = (Some(closure.outboard), closure.inboard);
        let pair =
            Pair { now, links: [outboard, inboard], o: now.body(outboard), i: now.body(inboard) };
        let arms =
            [pair.o.turn.rotate(joint.outboard.into()), pair.i.turn.rotate(joint.inboard.into())];
        let own = |frame: &Body, v: &[f64; 3]| frame.turn.rotate((*v).into());
        let home = Quaternion::from_array(joint.home);
        let mut along = |v: V3| all.push(pair.along(&arms, v));
        if let Some(InPlane { axes }) = in_plane {
            axes.iter().for_each(|v| along(own(pair.i, v)));
            continue;
        }
        let axes = [V3::x(), V3::y(), V3::z()].map(|v| pair.i.turn.rotate(v));
        match &joint.constraint {
            JointConstraint::Floating => {}
            JointConstraint::Prismatic { axis } => {
                across(axis).iter().for_each(|v| along(own(pair.i, v)));
            }
            _ => axes.into_iter().for_each(along),
        }
        let mut square = |w: V3, v: V3| all.push(pair.square(w, v));
        match &joint.constraint {
            JointConstraint::Universal { outboard_axis, inboard_axis } => {
                square(own(pair.o, outboard_axis), own(pair.i, inboard_axis));
            }
            JointConstraint::Revolute { axis } => {
                for v in across(&rotated(&joint.home, axis)) {
                    square(own(pair.o, axis), own(pair.i, &v));
                }
            }
            JointConstraint::Prismatic { .. } | JointConstraint::Fixed => {
                // Axes of the outboard body where it is at home, against those of the inboard one.
                let back = |v: V3| pair.o.turn.rotate(home.conjugate().rotate(v));
                square(back(V3::y()), axes[0]);
                square(back(V3::z()), axes[1]);
                square(back(V3::x()), axes[2]);
            }
            _ => {}
        }
    }
    for wheel in system.rolling() {
        rolling(wheel, now, &mut all);
    }
    all
}

/// The bodies of a closure.
struct Pair<'a> {
    now: &'a Kinematics,
    links: [Option<usize>; 2],
    o: &'a Body,
    i: &'a Body,
}

impl Pair<'_> {
    /// (1)
    fn along(&self, arms: &[V3; 2], v: V3) -> Row {
        let Self { now, links: [outboard, inboard], o, i } = *self;
        let d = o.center + arms[0] - i.center - arms[1];
        let d_dot = o.velocity_at(&arms[0]) - i.velocity_at(&arms[1]);
        let d_rest = o.acceleration_at(&arms[0]) - i.acceleration_at(&arms[1]);
        let v_dot = i.omega.cross(&v);
        let v_rest = i.alpha.cross(&v) + i.omega.cross(&v_dot);
        let parts = [
            Part { link: outboard, arm: arms[0], linear: v, angular: V3::zeros() },
            Part { link: inboard, arm: arms[1], linear: -v, angular: v.cross(&d) },
        ];
        Row {
            entries: entries(now, &parts),
            rest: v.dot(&d_rest) + 2.0 * v_dot.dot(&d_dot) + v_rest.dot(&d),
            error: v.dot(&d),
        }
    }

    /// (2)
    fn square(&self, w: V3, v: V3) -> Row {
        let Self { now, links: [outboard, inboard], o, i } = *self;
        let about = w.cross(&v);
        let changed = o.omega.cross(&w).cross(&v) + w.cross(&i.omega.cross(&v));
        let none = V3::zeros();
        let parts = [
            Part { link: outboard, arm: none, linear: none, angular: about },
            Part { link: inboard, arm: none, linear: none, angular: -about },
        ];
        Row {
            entries: entries(now, &parts),
            rest: (o.alpha - i.alpha).dot(&about) + (o.omega - i.omega).dot(&changed),
            error: v.dot(&w),
        }
    }
}

/// (3)
fn rolling(wheel: &Rolling, now: &Kinematics, all: &mut Vec<Row>) {
    let body = now.body(Some(wheel.link));
    let normal = V3::from(wheel.normal);
    let to_center = body.turn.rotate(wheel.center.into());
    let (rho, rho_dot) = lowest(wheel, body, normal);
    let arm = to_center + rho;
    // The contact point's path is not the body's: its own velocity is the centre's, and ω × ρ.
    let rest =
        body.acceleration_at(&to_center) + body.alpha.cross(&rho) + body.omega.cross(&rho_dot);
    let height = normal.dot(&(body.center + arm - V3::from(wheel.ground)));
    let [a, b] = across(&wheel.normal).map(V3::from);
    for (direction, error) in [(normal, height), (a, 0.0), (b, 0.0)] {
        let part = Part { link: Some(wheel.link), arm, linear: direction, angular: V3::zeros() };
        all.push(Row { entries: entries(now, &[part]), rest: direction.dot(&rest), error });
    }
}

/// From the centre to the lowest point, and its rate.
fn lowest(wheel: &Rolling, body: &Body, n: V3) -> (V3, V3) {
    let Some(axis) = wheel.axis else { return (-n * wheel.radius, V3::zeros()) };
    let e = body.turn.rotate(axis.into());
    let e_dot = body.omega.cross(&e);
    let (s, s_dot) = (n.dot(&e), n.dot(&e_dot));
    let m = n - e * s;
    let m_dot = -e * s_dot - e_dot * s;
    let size = m.norm();
    let size_dot = m.dot(&m_dot) / size;
    (-m * (wheel.radius / size), (m * (size_dot / size) - m_dot) * (wheel.radius / size))
}

/// Of all degrees of freedom on the way to the bodies, descending, each once.
fn entries(now: &Kinematics, parts: &[Part]) -> Vec<(usize, f64)> {
    let mut all: Vec<(usize, f64)> = Vec::new();
    for Part { link, arm, linear, angular } in parts {
        let point = now.body(*link).center + arm;
        for i in now.path(*link) {
            let dof = &now.dofs[i];
            let value = linear.dot(&dof.velocity_of(&point)) + angular.dot(&dof.angular);
            match all.iter_mut().find(|(other, _)| *other == i) {
                Some((_, sum)) => *sum += value,
                None => all.push((i, value)),
            }
        }
    }
    all.sort_unstable_by_key(|(i, _)| std::cmp::Reverse(*i));
    all
}

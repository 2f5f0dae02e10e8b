//! From a description to a motion.

use super::{BuildError, JointEntry, LoopEntry, Misdescribed, Multibody};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_multibody::{
    Body, BodyState, Closing, Closure, Joint, JointConstraint, Link, Simulation, Site, System,
};

/// Position, orientation and velocities of a body at the start.
#[derive(Clone, Copy)]
struct Frame {
    center: Vector3<f64>,
    orientation: Quaternion<f64>,
    velocity: Vector3<f64>,
    omega: Vector3<f64>,
}

const WORLD: Frame = Frame {
    center: Vector3::new(0.0, 0.0, 0.0),
    orientation: Quaternion { s: 1.0, v: Vector3::new(0.0, 0.0, 0.0) },
    velocity: Vector3::new(0.0, 0.0, 0.0),
    omega: Vector3::new(0.0, 0.0, 0.0),
};

impl Multibody {
    /// The motion that begins here, with steps of `h`.
    ///
    /// # Errors
    /// A [`BuildError`] with the field's name.
    pub fn start(&self, h: f64) -> Result<Simulation, BuildError> {
        self.check()?;
        let (mut links, mut frames, mut sites) = (Vec::new(), Vec::<Frame>::new(), Vec::new());
        for (k, entry) in self.bodies.iter().enumerate() {
            let field = |what: &str| format!("mechanism.bodies[{k}].{what}");
            let inboard = match &entry.inboard {
                None => None,
                Some(name) => Some(self.index(name, k).ok_or_else(|| {
                    Misdescribed::new(
                        field("inboard"),
                        format!("the name of an earlier body, not {name:?}"),
                    )
                })?),
            };
            if self.index(&entry.name, k).is_some() {
                return Err(
                    Misdescribed::new(field("name"), "a name that no other body has").into()
                );
            }
            let on = inboard.map_or(WORLD, |i| frames[i]);
            let mut frame = Frame {
                center: entry.center_m.into(),
                orientation: unit(entry.orientation, &field("orientation"))?,
                ..WORLD
            };
            let joint = joint(&entry.joint, &frame, &on);
            set_velocity(&entry.joint, &mut frame, &on);
            let body = Body { mass: entry.mass_kg, inertia: entry.inertia_kg_m2 };
            links.push(Link { inboard, joint, body });
            frames.push(frame);
            sites.extend(entry.contact_points_m.iter().map(|p| Site { link: k, position: *p }));
        }
        let mut system = System::new(links, self.gravity_m_s2)?;
        for (k, entry) in self.bodies.iter().enumerate() {
            if let Some(law) = entry.law {
                system = system.with_law(k, law)?;
            }
        }
        for (number, entry) in self.loops.iter().enumerate() {
            system = system.with_closure(self.closure(number, entry, &frames)?)?;
        }
        if let Some(floor) = self.floor {
            system = system.on_floor(floor, self.switching, sites)?;
        }
        let (states, rates): (Vec<BodyState>, Vec<BodyState>) =
            frames.iter().map(Frame::state_and_rate).unzip();
        let mut simulation = Simulation::new(system, h, &states, &rates)?;
        for (k, entry) in self.bodies.iter().enumerate() {
            simulation.set_torque(k, entry.torque);
        }
        Ok(simulation)
    }

    /// The body of a name among the first ones.
    fn index(&self, name: &str, before: usize) -> Option<usize> {
        self.bodies[..before].iter().position(|body| body.name == name)
    }

    fn closure(
        &self,
        number: usize,
        entry: &LoopEntry,
        frames: &[Frame],
    ) -> Result<Closure, Misdescribed> {
        let field = |what: &str| format!("mechanism.loops[{number}].{what}");
        let find = |name: &String| {
            self.index(name, self.bodies.len()).ok_or_else(|| {
                Misdescribed::new(field("between"), format!("names of bodies, not {name:?}"))
            })
        };
        let (outboard, inboard) = match &entry.between[..] {
            [a] => (find(a)?, None),
            [a, b] => (find(a)?, Some(find(b)?)),
            _ => return Err(Misdescribed::new(field("between"), "one or two names")),
        };
        let on = inboard.map_or(WORLD, |i| frames[i]);
        let joint = joint(&entry.joint.into(), &frames[outboard], &on);
        Ok(Closure { outboard, inboard, closing: Closing::Joint(joint) })
    }
}

impl Frame {
    fn state_and_rate(&self) -> (BodyState, BodyState) {
        let both = |x: &Vector3<f64>, [s, a, b, c]: [f64; 4]| [x.x, x.y, x.z, s, a, b, c];
        let q = self.orientation;
        let q_dot = q.rate(q.conjugate().rotate(self.omega));
        (both(&self.center, q.to_array()), both(&self.velocity, q_dot.to_array()))
    }
}

/// A joint between two bodies where they are; its axes have a length.
fn joint(entry: &JointEntry, outboard: &Frame, inboard: &Frame) -> Joint {
    let seen = |frame: &Frame, v: Vector3<f64>| frame.orientation.conjugate().rotate(v);
    let axis = |axis: &[f64; 3], frame: &Frame| -> [f64; 3] {
        seen(frame, Vector3::from(*axis).normalize()).into()
    };
    let center: [f64; 3] = outboard.center.into();
    let (point, constraint) = match entry {
        JointEntry::Floating { .. } => (center, JointConstraint::Floating),
        JointEntry::Fixed {} => (center, JointConstraint::Fixed),
        JointEntry::Revolute { point_m, axis: a, .. } => {
            (*point_m, JointConstraint::Revolute { axis: axis(a, outboard) })
        }
        JointEntry::Prismatic { axis: a, .. } => {
            (center, JointConstraint::Prismatic { axis: axis(a, inboard) })
        }
        JointEntry::Universal { point_m, axes: [a, b], .. } => {
            let constraint = JointConstraint::Universal {
                inboard_axis: axis(a, inboard),
                outboard_axis: axis(b, outboard),
            };
            (*point_m, constraint)
        }
        JointEntry::Spherical { point_m, .. } => (*point_m, JointConstraint::Spherical),
    };
    let point = Vector3::from(point);
    Joint {
        outboard: seen(outboard, point - outboard.center).into(),
        inboard: seen(inboard, point - inboard.center).into(),
        home: inboard.orientation.conjugate().product(outboard.orientation).to_array(),
        constraint,
    }
}

/// Velocity of a body that its joint and its inboard body give it.
fn set_velocity(entry: &JointEntry, body: &mut Frame, on: &Frame) {
    let unit = |axis: &[f64; 3]| Vector3::from(*axis).normalize();
    let (omega, about) = match entry {
        JointEntry::Floating { velocity_m_s, angular_velocity_rad_s } => {
            body.velocity = (*velocity_m_s).into();
            body.omega = (*angular_velocity_rad_s).into();
            return;
        }
        JointEntry::Fixed {} => (Vector3::zeros(), body.center),
        JointEntry::Revolute { point_m, axis, rate_rad_s } => {
            (unit(axis) * *rate_rad_s, Vector3::from(*point_m))
        }
        JointEntry::Prismatic { axis, rate_m_s } => {
            body.omega = on.omega;
            body.velocity =
                on.velocity + on.omega.cross(&(body.center - on.center)) + unit(axis) * *rate_m_s;
            return;
        }
        JointEntry::Universal { point_m, axes, rates_rad_s } => {
            let omega = unit(&axes[0]) * rates_rad_s[0] + unit(&axes[1]) * rates_rad_s[1];
            (omega, Vector3::from(*point_m))
        }
        JointEntry::Spherical { point_m, angular_velocity_rad_s } => {
            (Vector3::from(*angular_velocity_rad_s), Vector3::from(*point_m))
        }
    };
    body.omega = on.omega + omega;
    let of_point = on.velocity + on.omega.cross(&(about - on.center));
    body.velocity = of_point + body.omega.cross(&(body.center - about));
}

fn unit(q: [f64; 4], field: &str) -> Result<Quaternion<f64>, Misdescribed> {
    let given = Quaternion::from_array(q);
    let norm = given.norm_squared().sqrt();
    let expected = || format!("a unit quaternion, scalar first (its norm is {norm})");
    if !((norm - 1.0).abs() < 1e-3) {
        return Err(Misdescribed::new(field.to_owned(), expected()));
    }
    given.normalized().ok_or_else(|| Misdescribed::new(field.to_owned(), expected()))
}

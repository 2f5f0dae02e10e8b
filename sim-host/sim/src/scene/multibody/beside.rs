//! What acts beside joints: springs between points, and rolling without slip.

use super::Misdescribed;
use super::build::Frame;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use surefoot_multibody::{PointSpring, Rolling, SpringEnd};

/// A spring and a damper between two points, along the line between them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpringEntry {
    /// The bodies that it joins; the second may be left out for the world.
    pub between: Vec<String>,
    /// Its ends, on these bodies, m.
    pub points_m: [[f64; 3]; 2],
    /// N/m
    #[serde(default)]
    pub stiffness_n_m: f64,
    /// Length at which the spring is at rest, m.
    #[serde(default)]
    pub rest_m: f64,
    /// N·s/m
    #[serde(default)]
    pub damping_n_s_m: f64,
}

/// A wheel, as a thin disc, or a ball, that rolls on a plane and neither slips nor leaves it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RollingEntry {
    /// The body.
    pub body: String,
    /// m
    pub radius_m: f64,
    /// The wheel's axis, of any length; none for a ball.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<[f64; 3]>,
    /// The wheel's centre; none for the body's centre of mass, m.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub center_m: Option<[f64; 3]>,
    /// A point of the plane, m.
    #[serde(default)]
    pub plane_point_m: [f64; 3],
    /// Normal of the plane, of any length.
    #[serde(default = "up")]
    pub plane_normal: [f64; 3],
}

fn up() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

type Checked = Result<(), Misdescribed>;

fn finite(field: &str, values: &[f64]) -> Checked {
    let all = values.iter().all(|x| x.is_finite());
    if all { Ok(()) } else { Err(Misdescribed::new(field, "finite numbers")) }
}

fn axis(field: &str, v: &[f64; 3]) -> Checked {
    let length = Vector3::from(*v).norm();
    let is_one = length > 1e-9 && length.is_finite();
    if is_one { Ok(()) } else { Err(Misdescribed::new(field, "an axis with a length")) }
}

impl SpringEntry {
    pub(super) fn check(&self) -> Checked {
        for point in &self.points_m {
            finite("points_m", point)?;
        }
        let sizes = [
            ("stiffness_n_m", self.stiffness_n_m),
            ("rest_m", self.rest_m),
            ("damping_n_s_m", self.damping_n_s_m),
        ];
        for (field, value) in sizes {
            if !(value.is_finite() && value >= 0.0) {
                return Err(Misdescribed::new(field, "a finite number, zero or more"));
            }
        }
        if self.stiffness_n_m == 0.0 && self.rest_m != 0.0 {
            return Err(Misdescribed::new("rest_m", "none, as the spring has no stiffness"));
        }
        if self.stiffness_n_m == 0.0 && self.damping_n_s_m == 0.0 {
            return Err(Misdescribed::new("stiffness_n_m", "a stiffness or a damping above zero"));
        }
        Ok(())
    }

    /// Between these links.
    pub(super) fn spring(&self, links: [Option<usize>; 2], frames: &[Frame]) -> PointSpring {
        let end = |k: usize| SpringEnd {
            link: links[k],
            point: Frame::seen_from(links[k], frames, self.points_m[k]),
        };
        PointSpring {
            ends: [end(0), end(1)],
            stiffness: self.stiffness_n_m,
            rest: self.rest_m,
            damping: self.damping_n_s_m,
        }
    }
}

impl RollingEntry {
    pub(super) fn check(&self) -> Checked {
        if !(self.radius_m.is_finite() && self.radius_m > 0.0) {
            return Err(Misdescribed::new("radius_m", "a finite number above zero"));
        }
        finite("plane_point_m", &self.plane_point_m)?;
        finite("center_m", &self.center_m.unwrap_or_default())?;
        axis("plane_normal", &self.plane_normal)?;
        let Some(own) = &self.axis else { return Ok(()) };
        axis("axis", own)?;
        let [a, n] = [own, &self.plane_normal].map(|v| Vector3::from(*v).normalize());
        // A wheel that lies flat has no lowest point.
        let stands = a.cross(&n).norm() > 1e-3;
        if stands {
            Ok(())
        } else {
            Err(Misdescribed::new("axis", "one across the plane's normal"))
        }
    }

    /// Of a link.
    pub(super) fn rolling(&self, link: usize, frames: &[Frame]) -> Rolling {
        let frame = &frames[link];
        let back = |v: [f64; 3]| -> [f64; 3] {
            frame.orientation.conjugate().rotate(Vector3::from(v).normalize()).into()
        };
        let center = self.center_m.map(|center| Frame::seen_from(Some(link), frames, center));
        Rolling {
            link,
            center: center.unwrap_or_default(),
            axis: self.axis.map(back),
            radius: self.radius_m,
            normal: Vector3::from(self.plane_normal).normalize().into(),
            ground: self.plane_point_m,
        }
    }
}

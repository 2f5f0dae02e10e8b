//! A parallel projection.

use nalgebra::Vector3;

/// From where a picture is taken.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    right: Vector3<f64>,
    up: Vector3<f64>,
    towards: Vector3<f64>,
    center: Vector3<f64>,
    pixels_per_metre: f64,
    middle: [f64; 2],
}

impl View {
    /// From a direction given by its azimuth (from +x towards +y) and elevation, rad, at a point, which comes
    /// to lie at `middle` (px).
    pub(super) fn new(
        azimuth: f64,
        elevation: f64,
        center: Vector3<f64>,
        pixels_per_metre: f64,
        middle: [f64; 2],
    ) -> Self {
        let ((sa, ca), (se, ce)) = (azimuth.sin_cos(), elevation.sin_cos());
        Self {
            right: Vector3::new(-sa, ca, 0.0),
            up: Vector3::new(-se * ca, -se * sa, ce),
            towards: Vector3::new(ce * ca, ce * sa, se),
            center,
            pixels_per_metre,
            middle,
        }
    }

    /// Where a point is seen, px.
    pub(super) fn project(&self, point: &Vector3<f64>) -> [f64; 2] {
        let arm = (point - self.center) * self.pixels_per_metre;
        [self.middle[0] + self.right.dot(&arm), self.middle[1] - self.up.dot(&arm)]
    }

    /// A point so far towards the eye that it stands for an eye at infinity.
    pub(super) fn eye(&self) -> Vector3<f64> {
        self.center + self.towards * 1e3
    }

    /// Whether a face with this normal is seen from its front.
    pub(super) fn faces_us(&self, normal: &Vector3<f64>) -> bool {
        self.towards.dot(normal) > 0.0
    }
}

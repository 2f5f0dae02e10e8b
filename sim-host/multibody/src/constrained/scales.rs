//! What residuals of (5.11) are measured by: see [`super::super::scale`].

use super::super::body::{Body, BodyState};
use super::super::scale::Scale;
use super::super::system::Link;
use super::simulation::ConstrainedSimulation;

impl ConstrainedSimulation {
    /// (2) and (3) of [`super::super::scale`] where a step begins: here bodies are apart, and what constraints do to
    /// them belongs to the terms.
    pub(super) fn measured(&self) -> Scale {
        let weight = 0.5 * self.progress.h * self.system.gravity();
        let mut scale = Scale::default();
        for (k, link) in self.system.links().iter().enumerate() {
            let moved = self.momenta[k].iter().zip(&self.d[k]);
            scale.motion += moved.map(|(p, d)| (p * d).abs()).sum::<f64>();
            scale.motion += link.body.mass * weight * weight;
            let (node, tried) = (&self.equations.nodes[k], &self.multipliers[k]);
            let energy = |row: &BodyState, m: f64, body: &Body| -> f64 {
                let inertia = inertia(body);
                row.iter().zip(inertia).map(|(g, inertia)| (g * m).powi(2) / inertia).sum()
            };
            scale.terms += energy(&node.norm[0], tried.norm_multiplier, &link.body);
            for c in 0..node.constraints {
                let m = tried.multipliers[c];
                scale.terms += energy(&node.outboard_rows[0][c], m, &link.body);
                if let Some(inboard) = link.inboard {
                    let body = &self.system.links()[inboard].body;
                    scale.terms += energy(&node.inboard_rows[0][c], m, body);
                }
            }
        }
        scale
    }
}

/// What moves with each of a body's coordinates: of a quaternion's, four times the largest moment.
pub(super) fn inertia(body: &Body) -> BodyState {
    let moment = 4.0 * body.inertia.iter().fold(0.0_f64, |m, i| m.max(*i));
    let m = body.mass;
    [m, m, m, moment, moment, moment, moment]
}

/// Arms of a link's joint, and the body's radius of gyration, m.
pub(super) fn extent(link: &Link) -> f64 {
    let size = |arm: &[f64; 3]| arm.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    let radius = (inertia(&link.body)[3] / link.body.mass).sqrt();
    radius.max(size(&link.joint.outboard)).max(size(&link.joint.inboard))
}

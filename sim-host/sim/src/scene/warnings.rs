//! What the user should know of a scene that is sound: numbers that were taken though they are off, and energy that a
//! start has in the floor.

use super::inertia::rounded;
use super::{BodyEntry, Feet, Mechanism, MechanismScene, Multibody, Scene};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_multibody::contact::Floor;

impl MechanismScene {
    /// What the user should know before it runs.
    pub fn warnings(&self) -> Vec<String> {
        match &self.mechanism {
            Mechanism::RigidBody { inertia_kg_m2, .. } => {
                rounded("mechanism.inertia_kg_m2", inertia_kg_m2).into_iter().collect()
            }
            Mechanism::Multibody(bodies) => bodies.warnings(),
            Mechanism::Pendulum { .. } | Mechanism::Chain { .. } | Mechanism::Biped(_) => {
                Vec::new()
            }
        }
    }
}

impl Multibody {
    fn warnings(&self) -> Vec<String> {
        let inertias = self.bodies.iter().enumerate().filter_map(|(k, body)| {
            rounded(&format!("mechanism.bodies[{k}].inertia_kg_m2"), &body.inertia_kg_m2)
        });
        let mut all: Vec<String> = inertias.collect();
        if let Some(floor) = &self.floor {
            let weight =
                self.gravity_m_s2 * self.bodies.iter().map(|body| body.mass_kg).sum::<f64>();
            let heights = self.bodies.iter().flat_map(BodyEntry::heights);
            all.extend(sunk("the contact points", heights, floor, weight));
        }
        all
    }
}

impl BodyEntry {
    /// Of its contact points, m.
    fn heights(&self) -> impl Iterator<Item = f64> {
        let q = Quaternion::from_array(self.orientation).normalized();
        self.contact_points_m
            .iter()
            .filter_map(move |point| Some(self.center_m[2] + q?.rotate(Vector3::from(*point)).z))
    }
}

impl Scene {
    /// What the user should know before it runs.
    pub fn warnings(&self) -> Vec<String> {
        let Feet::Floor { floor, .. } = &self.feet else { return Vec::new() };
        // A start that is no configuration is the plant's to refuse.
        let robot = self.robot();
        let Ok(poses) = robot.tree.body_poses(&self.initial.state().positions) else {
            return Vec::new();
        };
        let heights = robot.feet.iter().flat_map(|foot| {
            let pose = &poses[foot.body];
            foot.points.iter().map(|point| pose.transform_point(point.at).z)
        });
        let weight = -robot.tree.gravity()[2] * robot.tree.mass();
        sunk("the soles", heights, floor, weight).into_iter().collect()
    }
}

/// What to say of points that start so deep in a floor that its springs hold more energy than the weight takes up
/// until they are out of it, so that the floor throws them up. At rest on it they are at half that depth at most.
fn sunk(
    what: &str,
    heights: impl Iterator<Item = f64>,
    floor: &Floor,
    weight_n: f64,
) -> Option<String> {
    let depths = heights.map(|z| (-z).max(0.0));
    let (deepest, squares) = depths.fold((0.0, 0.0), |(m, sum), d| (f64::max(m, d), sum + d * d));
    let energy = 0.5 * floor.normal_stiffness * squares;
    (energy > weight_n.max(0.0) * deepest).then(|| {
        format!(
            "{what} start up to {:.1} mm deep in the floor, whose springs hold {energy:.1} J there and give them back",
            1e3 * deepest
        )
    })
}

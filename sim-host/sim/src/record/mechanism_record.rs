//! What a run of a mechanism has recorded.

use super::recorded::{Details, JointReading, Record};
use crate::mechanism::{JointMotion, Layout, LayoutKind, MechanismSample, Reaction, StartFailure};
use crate::picture::{Moment, Shown};
use crate::scene::Mechanism;
use serde_json::{Value, json};
use surefoot::dynamics::DynamicsFault;

const AXES: [&str; 3] = ["x", "y", "z"];
const POSE: [&str; 7] = ["x_m", "y_m", "z_m", "q_s", "q_x", "q_y", "q_z"];
const TWIST: [&str; 6] = ["v_x_mps", "v_y_mps", "v_z_mps", "w_x_radps", "w_y_radps", "w_z_radps"];

/// What a run of a mechanism has recorded.
pub struct MechanismRecord<'a> {
    shown: Shown,
    layout: Layout,
    samples: &'a [MechanismSample],
    /// By sample and joint.
    joints: Vec<Vec<JointMotion>>,
    /// Likewise.
    reactions: Vec<Option<Vec<Reaction>>>,
}

impl<'a> MechanismRecord<'a> {
    /// Of a mechanism's run.
    ///
    /// # Errors
    /// As for [`Layout::of`]: none for what has run.
    pub fn new(
        mechanism: &Mechanism,
        samples: &'a [MechanismSample],
    ) -> Result<Self, StartFailure> {
        let layout = Layout::of(mechanism)?;
        let shown = Shown::of_mechanism(mechanism, &layout, samples);
        let joints = layout.joints_over(samples);
        let reactions = (0..samples.len()).map(|i| layout.reactions(samples, i)).collect();
        Ok(Self { shown, layout, samples, joints, reactions })
    }

    /// Its parts by name.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Its samples.
    pub fn samples(&self) -> &'a [MechanismSample] {
        self.samples
    }

    /// Where joints are, by sample and joint.
    pub fn joint_motions(&self) -> &[Vec<JointMotion>] {
        &self.joints
    }

    /// What joints bear, by sample and joint.
    pub fn reactions(&self) -> &[Option<Vec<Reaction>>] {
        &self.reactions
    }

    fn of_bodies(&self, numbers: &[&str]) -> impl Iterator<Item = String> {
        let bodies = self.layout.body_columns.iter();
        bodies.flat_map(|body| numbers.iter().map(move |number| format!("{body}_{number}")))
    }

    /// What joints bear at a sample, as fields; empty where that is not known.
    fn of_reactions(&self, sample: usize) -> Vec<String> {
        let joints = self.layout.joints.iter();
        match &self.reactions[sample] {
            _ if !self.layout.has_reactions() => Vec::new(),
            None => vec![String::new(); joints.map(|joint| joint.reaction_numbers()).sum()],
            Some(all) => {
                let numbers = joints.zip(all).flat_map(|(joint, reaction)| {
                    let both = reaction.force.iter().chain(&reaction.torque);
                    both.take(joint.reaction_numbers())
                });
                numbers.map(f64::to_string).collect()
            }
        }
    }

    /// How many numbers of angular momentum are kept.
    fn momenta(&self) -> usize {
        self.samples.first().map_or(0, |sample| sample.momentum.len())
    }
}

impl Record for MechanismRecord<'_> {
    fn shown(&self) -> &Shown {
        &self.shown
    }

    fn times(&self) -> Vec<f64> {
        self.samples.iter().map(|sample| sample.time_s).collect()
    }

    /// Time; bodies, joints; their velocities; torques of driven joints, what joints bear; contact states and forces; energies, what is
    /// kept of angular momentum, the largest constraint.
    fn columns(&self) -> Vec<String> {
        let Layout { joints, points, kind, .. } = &self.layout;
        let (pose, twist) = match kind {
            LayoutKind::Orientation => (&POSE[3..], &TWIST[3..]),
            LayoutKind::Rods(_) => (&POSE[..3], &TWIST[..3]),
            LayoutKind::Bodies(_) => (&POSE[..], &TWIST[..]),
        };
        let mut names = vec!["time_s".to_owned()];
        names.extend(self.of_bodies(pose));
        names.extend(joints.iter().flat_map(|joint| joint.columns().0));
        names.extend(self.of_bodies(twist));
        names.extend(joints.iter().flat_map(|joint| joint.columns().1));
        names.extend(joints.iter().filter(|j| j.is_driven()).map(|j| j.effort_column()));
        if self.layout.has_reactions() {
            names.extend(joints.iter().flat_map(|joint| joint.reaction_columns()));
        }
        names.extend(points.iter().map(|point| format!("{}_state", point.column)));
        for point in points {
            names.extend(AXES.map(|axis| format!("{}_f_{axis}_n", point.column)));
        }
        names.extend(["kinetic_j", "potential_j", "energy_j"].map(str::to_owned));
        let momenta = match (kind, self.momenta()) {
            (LayoutKind::Rods(_), _) => &AXES[2..],
            (_, momenta) => &AXES[..momenta.min(3)],
        };
        names.extend(momenta.iter().map(|axis| format!("momentum_{axis}_nms")));
        names.push("constraint".to_owned());
        names
    }

    fn row(&self, sample: usize) -> Vec<String> {
        let reactions = self.of_reactions(sample);
        let (sample, joints) = (&self.samples[sample], &self.joints[sample]);
        let driven = self.layout.joints.iter().zip(joints).filter(|(joint, _)| joint.is_driven());
        let efforts: Vec<f64> = driven.map(|(joint, motion)| joint.effort(motion)).collect();
        let (velocities, potential) =
            (self.layout.velocities(sample), sample.energy - sample.kinetic);
        let before = std::iter::once(&sample.time_s)
            .chain(&sample.configuration)
            .chain(joints.iter().flat_map(|joint| &joint.positions))
            .chain(&velocities)
            .chain(joints.iter().flat_map(|joint| &joint.rates))
            .chain(&efforts);
        let mut fields: Vec<String> = before.map(f64::to_string).collect();
        fields.extend(reactions);
        fields.extend(sample.contacts.iter().map(|state| state.number().to_string()));
        let after = sample
            .contact_forces
            .iter()
            .flatten()
            .chain([&sample.kinetic, &potential, &sample.energy])
            .chain(&sample.momentum)
            .chain([&sample.constraint]);
        fields.extend(after.map(f64::to_string));
        fields
    }

    fn moment(&self, sample: usize) -> Result<Moment, DynamicsFault> {
        let sample = &self.samples[sample];
        Ok(Moment {
            poses: self.layout.poses(sample),
            contacts: sample.contacts.clone(),
            forces: sample.contact_forces.clone(),
            block: None,
            tracking: None,
        })
    }

    /// Those of one coordinate, as viewers know no others.
    fn joints(&self, sample: usize) -> Vec<JointReading<'_>> {
        let all = self.layout.joints.iter().zip(&self.joints[sample]);
        let readings =
            all.filter_map(|(joint, motion)| match (&motion.positions[..], &motion.rates[..]) {
                ([position], [velocity]) => Some(JointReading {
                    name: &joint.name,
                    position: *position,
                    velocity: *velocity,
                    effort: joint.is_driven().then(|| joint.effort(motion)),
                }),
                _ => None,
            });
        readings.collect()
    }

    fn details(&self) -> Details {
        let number = json!({ "type": "number" });
        let schema = json!({
            "type": "object",
            "title": "surefoot.Conserved",
            "properties": {
                "kinetic_j": number,
                "potential_j": number,
                "energy_j": number,
                "angular_momentum_nms": { "type": "array", "items": number },
                "constraint": number,
            },
        });
        Details { topic: "/conserved", schema_name: "surefoot.Conserved", schema }
    }

    fn detail(&self, sample: usize) -> Value {
        let sample = &self.samples[sample];
        json!({
            "kinetic_j": sample.kinetic,
            "potential_j": sample.energy - sample.kinetic,
            "energy_j": sample.energy,
            "angular_momentum_nms": sample.momentum,
            "constraint": sample.constraint,
        })
    }
}

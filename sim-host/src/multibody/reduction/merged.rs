//! Links on fixed joints as one body with what they are fixed to.

use super::super::{JointConstraint, System, SystemError};
use super::frame::Frame;
use super::rebuild::{Fate, rebuild};
use super::reduced::Reduced;
use surefoot::spatial::Quaternion;

/// The system without joints that do not move. Links that are fixed to the world stay: there is no body that
/// they could be part of. The motion is that of the larger system, to round-off.
///
/// # Errors
/// [`SystemError::Unsupported`] where a thrown body strikes a box that would be askew in the new body's axes.
pub fn merged(system: &System) -> Result<Reduced, SystemError> {
    let mut fates: Vec<Fate> = Vec::with_capacity(system.links().len());
    for (k, link) in system.links().iter().enumerate() {
        let fate = match (link.joint.constraint, link.inboard) {
            (JointConstraint::Fixed, Some(inboard)) => {
                let home = Quaternion::from_array(link.joint.home);
                let on = Frame {
                    position: nalgebra::Vector3::from(link.joint.inboard)
                        - home.rotate(link.joint.outboard.into()),
                    orientation: home,
                };
                match fates[inboard] {
                    Fate::Leads { .. } => Fate::Joins { leader: inboard, at: on },
                    Fate::Joins { leader, at } | Fate::Given { leader, at } => {
                        Fate::Joins { leader, at: at.then(&on) }
                    }
                }
            }
            _ => Fate::unchanged(system, k),
        };
        fates.push(fate);
    }
    rebuild(system, &fates)
}

//! Links on fixed joints as one body with what they are fixed to.

use super::super::{JointConstraint, System, SystemError};
use super::frame::Frame;
use super::rebuild::{Fate, rebuild};
use super::reduced::Reduced;
use surefoot::spatial::Quaternion;

/// The system without joints that do not move. Links that are fixed to the world become part of it, but for those
/// that can touch a floor or be struck: forces on them are still told. The motion is that of the larger system, to
/// round-off.
///
/// # Errors
/// [`SystemError::Unsupported`] where a thrown body strikes a box that would be askew in the new body's axes.
pub fn merged(system: &System) -> Result<Reduced, SystemError> {
    let mut fates: Vec<Fate> = Vec::with_capacity(system.links().len());
    for (k, link) in system.links().iter().enumerate() {
        let fate = match (link.joint.constraint, link.inboard) {
            (JointConstraint::Fixed, inboard) => {
                let home = Quaternion::from_array(link.joint.home);
                let on = Frame {
                    position: nalgebra::Vector3::from(link.joint.inboard)
                        - home.rotate(link.joint.outboard.into()),
                    orientation: home,
                };
                let still = |at: Frame| {
                    if is_touched(system, k) {
                        return Fate::unchanged(system, k);
                    }
                    Fate::Still { at }
                };
                match inboard.map(|i| (i, fates[i])) {
                    None => still(on),
                    Some((_, Fate::Still { at })) => still(at.then(&on)),
                    Some((leader, Fate::Leads { .. })) => Fate::Joins { leader, at: on },
                    Some((_, Fate::Joins { leader, at } | Fate::Given { leader, at })) => {
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

/// Whether forces on a link are told.
fn is_touched(system: &System, link: usize) -> bool {
    system.sites().iter().any(|site| site.link == link)
        || system.strikers().iter().any(|striker| striker.struck == link)
}

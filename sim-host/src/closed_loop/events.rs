//! Events from contact states.

use crate::contact::ContactState;
use crate::record::{Event, EventKind};

/// Watches the contact states of both feet.
#[derive(Debug, Default)]
pub(super) struct Watch {
    down: [bool; 2],
    slipping: [bool; 2],
}

const FEET: [&str; 2] = ["left foot", "right foot"];

impl Watch {
    /// From contact states on, as if they had been looked at before.
    pub(super) fn from(contacts: &[[ContactState; 4]; 2]) -> Self {
        let mut watch = Self::default();
        watch.look(0.0, contacts, &mut Vec::new());
        watch
    }

    /// Appends what changed since the last look.
    pub(super) fn look(
        &mut self,
        time_s: f64,
        contacts: &[[ContactState; 4]; 2],
        events: &mut Vec<Event>,
    ) {
        for (foot, points) in contacts.iter().enumerate() {
            let down = points.iter().any(|state| *state != ContactState::Free);
            let slipping = points.iter().any(|state| {
                matches!(state, ContactState::Sliding | ContactState::StickingToSliding)
            });
            let mut push = |kind| events.push(Event { time_s, kind, place: FEET[foot].to_owned() });
            match (self.down[foot], down) {
                (false, true) => push(EventKind::TouchDown),
                (true, false) => push(EventKind::LiftOff),
                _ => {}
            }
            // A foot that lands or leaves slides by definition; only a standing one slips.
            match (self.slipping[foot], slipping) {
                (false, true) if self.down[foot] && down => push(EventKind::SlipStart),
                (true, false) if down => push(EventKind::SlipEnd),
                _ => {}
            }
            self.down[foot] = down;
            self.slipping[foot] = slipping;
        }
    }

    /// Whether a foot is on the floor.
    pub(super) fn touched(&self) -> bool {
        self.down.contains(&true)
    }
}

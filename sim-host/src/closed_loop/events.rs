//! Events from contact states.

use crate::contact::ContactState;
use crate::record::{Event, EventKind};

/// Watches the contact states of both feet.
#[derive(Debug, Default)]
pub(super) struct Watch {
    down: [bool; 2],
    slipping: [bool; 2],
    /// Heel and toe, by foot.
    ends_down: [[bool; 2]; 2],
    struck: bool,
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
            let ends = [0, 2].map(|k| points[k..k + 2].iter().any(|s| *s != ContactState::Free));
            // A foot that comes or goes as a whole has said so.
            if self.down[foot] && down {
                let kinds = [
                    [EventKind::HeelOff, EventKind::HeelDown],
                    [EventKind::ToeOff, EventKind::ToeDown],
                ];
                for ((before, now), [off, on]) in self.ends_down[foot].iter().zip(ends).zip(kinds) {
                    if *before != now {
                        push(if now { on } else { off });
                    }
                }
            }
            self.ends_down[foot] = ends;
            self.down[foot] = down;
            self.slipping[foot] = slipping;
        }
    }

    /// Appends whether a block's touch has begun or ended since the last look.
    pub(super) fn look_at_block(&mut self, time_s: f64, struck: bool, events: &mut Vec<Event>) {
        if struck != self.struck {
            let kind = if struck { EventKind::Strike } else { EventKind::StrikeEnd };
            events.push(Event { time_s, kind, place: "central body".to_owned() });
        }
        self.struck = struck;
    }

    /// Whether a foot is on the floor.
    pub(super) fn touched(&self) -> bool {
        self.down.contains(&true)
    }
}

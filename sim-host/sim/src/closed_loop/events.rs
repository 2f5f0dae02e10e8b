//! Events from contact states.

use crate::plant::PerPoint;
use crate::record::{Event, EventKind};
use crate::robot::SharedRobot;
use surefoot_multibody::contact::ContactState;

/// Watches the contact states of all feet.
#[derive(Debug)]
pub(super) struct Watch {
    robot: SharedRobot,
    down: Vec<bool>,
    slipping: Vec<bool>,
    /// Heel and toe, by foot.
    ends_down: Vec<[bool; 2]>,
    struck: bool,
}

impl Watch {
    /// Of a robot in the air.
    pub(super) fn new(robot: SharedRobot) -> Self {
        let feet = robot.feet.len();
        let (down, slipping) = (vec![false; feet], vec![false; feet]);
        Self { robot, down, slipping, ends_down: vec![[false; 2]; feet], struck: false }
    }

    /// From contact states on, as if they had been looked at before.
    pub(super) fn begin_with(&mut self, contacts: &PerPoint<ContactState>) {
        self.look(0.0, contacts, &mut Vec::new());
    }

    /// Appends what changed since the last look.
    pub(super) fn look(
        &mut self,
        time_s: f64,
        contacts: &PerPoint<ContactState>,
        events: &mut Vec<Event>,
    ) {
        for (foot, (of, points)) in self.robot.feet.iter().zip(contacts).enumerate() {
            let down = points.iter().any(|state| *state != ContactState::Free);
            let slipping = points.iter().any(|state| {
                matches!(state, ContactState::Sliding | ContactState::StickingToSliding)
            });
            let mut push = |kind| events.push(Event { time_s, kind, place: of.name.clone() });
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
            let is_down = |points_there: &Vec<usize>| {
                points_there
                    .iter()
                    .any(|k| points.get(*k).is_some_and(|s| *s != ContactState::Free))
            };
            let ends = [is_down(&of.ends[0]), is_down(&of.ends[1])];
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

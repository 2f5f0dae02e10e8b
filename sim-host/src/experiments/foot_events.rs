//! What feet did, from a run's events.

use surefoot_sim::closed_loop::Run;
use surefoot_sim::record::EventKind;

/// The longest interval (s) that begins with one kind of event at a foot and ends with another: a heel or
/// toe that chatters has many, and the text speaks of one. An interval that nothing ends lasts to the end
/// of the run.
pub(super) fn longest_apart(
    run: &Run,
    foot: &str,
    begins: EventKind,
    ends: EventKind,
) -> Option<(f64, f64)> {
    let last = run.samples.last().map_or(0.0, |sample| sample.time_s);
    let (mut longest, mut open): (Option<(f64, f64)>, Option<f64>) = (None, None);
    let mut close = |from: f64, to: f64| {
        if longest.is_none_or(|(a, b)| to - from > b - a) {
            longest = Some((from, to));
        }
    };
    for event in run.events.iter().filter(|event| event.place == foot) {
        if event.kind == begins {
            open.get_or_insert(event.time_s);
        } else if event.kind == ends
            && let Some(from) = open.take()
        {
            close(from, event.time_s);
        }
    }
    if let Some(from) = open {
        close(from, last);
    }
    longest
}

/// The first event of a kind, s.
pub(super) fn first(run: &Run, kind: EventKind) -> Option<f64> {
    run.events.iter().find(|event| event.kind == kind).map(|event| event.time_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use EventKind::{HeelDown, HeelOff, Strike};
    use surefoot_sim::closed_loop::{Outcome, Run};
    use surefoot_sim::record::Event;

    fn run(events: &[(f64, EventKind, &str)]) -> Run {
        let event = |(time_s, kind, place): &(f64, EventKind, &str)| Event {
            time_s: *time_s,
            kind: *kind,
            place: (*place).to_owned(),
        };
        Run {
            outcome: Outcome::Completed,
            is_interrupted: false,
            failure: None,
            cause: None,
            samples: Vec::new(),
            events: events.iter().map(event).collect(),
            steps: 0,
            constraint_max: 0.0,
            wall: std::time::Duration::ZERO,
            progress: None,
            saved: None,
            costs: None,
            limits: None,
            gait: None,
            cut_torques: surefoot_sim::closed_loop::CutTorques::default(),
            stop: None,
            estimate: None,
        }
    }

    #[test]
    fn bounces_are_not_what_the_text_speaks_of() {
        let run = run(&[
            (0.08, Strike, "central body"),
            (0.10, HeelOff, "left foot"),
            (0.11, HeelDown, "left foot"),
            (0.13, HeelOff, "left foot"),
            (0.14, HeelOff, "right foot"),
            (0.36, HeelDown, "right foot"),
            (0.38, HeelDown, "left foot"),
            (0.39, HeelOff, "left foot"),
            (0.40, HeelDown, "left foot"),
        ]);
        assert_eq!(longest_apart(&run, "left foot", HeelOff, HeelDown), Some((0.13, 0.38)));
        assert_eq!(longest_apart(&run, "right foot", HeelOff, HeelDown), Some((0.14, 0.36)));
        assert_eq!(first(&run, Strike), Some(0.08));
        assert_eq!(first(&run, EventKind::ToeOff), None);
    }
}

//! What feet did, from a run's events.

use crate::closed_loop::Run;
use crate::record::EventKind;

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

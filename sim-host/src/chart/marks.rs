//! Which events charts mark.

use super::Mark;
use surefoot_sim::record::{Event, EventKind};

/// Marks that stay legible in one chart.
const MOST_MARKS: usize = 16;

/// Events of one kind at both feet, or at several points, this close together (s) are one mark.
const TOGETHER_S: f64 = 2e-3;

/// The events that a chart marks: those of contact, not those of slipping, which come and go too fast.
pub fn marks(events: &[Event]) -> Vec<Mark> {
    let mut marks: Vec<(Mark, EventKind)> = Vec::new();
    for event in events {
        let Some(word) = word(event.kind) else { continue };
        let same = |(mark, kind): &&mut (Mark, EventKind)| {
            *kind == event.kind && (mark.time_s - event.time_s).abs() <= TOGETHER_S
        };
        // Points have numbers.
        let number = event.place.strip_prefix("point ");
        if let Some((mark, _)) = marks.iter_mut().rev().find(same) {
            mark.label = match number {
                None => format!("both {word}"),
                Some(number) => {
                    format!("{}, {number} {word}", mark.label.trim_end_matches(word).trim())
                }
            };
            continue;
        }
        let place = match (event.place.as_str(), number) {
            ("left foot", _) => "left ".to_owned(),
            ("right foot", _) => "right ".to_owned(),
            (_, Some(number)) => format!("{number} "),
            _ => String::new(),
        };
        let mark = Mark { time_s: event.time_s, label: format!("{place}{word}") };
        marks.push((mark, event.kind));
    }
    marks.truncate(MOST_MARKS);
    marks.into_iter().map(|(mark, _)| mark).collect()
}

/// An event in as few letters as the legend of a chart has room for.
fn word(kind: EventKind) -> Option<&'static str> {
    match kind {
        EventKind::TouchDown => Some("down"),
        EventKind::LiftOff => Some("off"),
        EventKind::HeelOff => Some("heel off"),
        EventKind::HeelDown => Some("heel down"),
        EventKind::ToeOff => Some("toe off"),
        EventKind::ToeDown => Some("toe down"),
        EventKind::Strike => Some("block strikes"),
        EventKind::StrikeEnd => Some("block leaves"),
        EventKind::SlipStart | EventKind::SlipEnd => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_feet_at_once_are_one_mark_and_slips_none() {
        let event =
            |time_s: f64, kind, place: &str| Event { time_s, kind, place: place.to_owned() };
        let events = [
            event(0.004, EventKind::TouchDown, "left foot"),
            event(0.004, EventKind::TouchDown, "right foot"),
            event(0.018, EventKind::SlipEnd, "left foot"),
            event(0.08, EventKind::Strike, "central body"),
            event(0.36, EventKind::HeelDown, "right foot"),
            event(0.38, EventKind::HeelDown, "left foot"),
        ];
        let labels: Vec<String> = marks(&events).into_iter().map(|mark| mark.label).collect();
        assert_eq!(labels, ["both down", "block strikes", "right heel down", "left heel down"]);
        let events = [
            event(0.1, EventKind::TouchDown, "point 2"),
            event(0.101, EventKind::TouchDown, "point 12"),
            event(0.1015, EventKind::LiftOff, "point 3"),
        ];
        let labels: Vec<String> = marks(&events).into_iter().map(|mark| mark.label).collect();
        assert_eq!(labels, ["2, 12 down", "3 off"]);
    }
}

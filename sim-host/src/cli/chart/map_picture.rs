//! How a map looks.

use crate::chart::{CellAxis, CellKind, CellLine, HeatMap};
use crate::stability::loop_limits::Manner;
use crate::stability::maps::{Axis, Column, Failure, Foretold, Map, Outcome, significant};
use surefoot_mechanics::forecast::FailureKind;

/// Of cells that work: nearly white, so that what fails stands out.
const WORKS: (u8, u8, u8) = (240, 246, 242);

/// Okabe and Ito's colours by failure. Those that meet in one map differ in lightness too, and the letters tell
/// them apart where colours do not.
fn color(failure: Failure) -> (u8, u8, u8) {
    const YELLOW: (u8, u8, u8) = (240, 228, 66);
    const ORANGE: (u8, u8, u8) = (230, 159, 0);
    const SKY: (u8, u8, u8) = (86, 180, 233);
    const GREEN: (u8, u8, u8) = (0, 158, 115);
    const VERMILION: (u8, u8, u8) = (213, 94, 0);
    const BLUE: (u8, u8, u8) = (0, 114, 178);
    const PURPLE: (u8, u8, u8) = (204, 121, 167);
    const GREY: (u8, u8, u8) = (150, 150, 150);
    const BLACK: (u8, u8, u8) = (40, 40, 40);
    match failure {
        Failure::Motion(kind) => match kind {
            FailureKind::Energy => YELLOW,
            FailureKind::NoRoot => BLUE,
            FailureKind::WrongBranch => SKY,
            FailureKind::Constraint => PURPLE,
            FailureKind::Iterations => GREY,
            FailureKind::Singular => GREEN,
            FailureKind::Tolerance => ORANGE,
            FailureKind::Unbalanced => SKY,
            FailureKind::Runaway => VERMILION,
            FailureKind::NotFinite => BLACK,
        },
        Failure::Loop(manner) => match manner {
            Manner::DoesNotSettle => YELLOW,
            Manner::Slip => SKY,
            Manner::Tip => BLUE,
            Manner::Runaway => VERMILION,
            Manner::Collapse => GREEN,
            Manner::ControllerFault | Manner::Measurement => ORANGE,
            Manner::SingularLeg => PURPLE,
            Manner::TorqueLimit | Manner::NotReachable => GREY,
            Manner::StepFailure => BLACK,
        },
    }
}

/// A map as a grid of coloured cells, with what was foretold and what was found.
pub(super) fn picture(map: &Map, columns: &[Column]) -> HeatMap {
    let failures: Vec<Failure> =
        Column::count_failures(columns).into_iter().map(|(failure, _)| failure).collect();
    let kind = |failure: &Failure| CellKind {
        name: failure.words().to_owned(),
        letter: failure.letter(),
        color: color(*failure),
    };
    let works = CellKind { name: "works".to_owned(), letter: "", color: WORKS };
    let number = |outcome: &Outcome| match outcome {
        Outcome::Works => 0,
        Outcome::Fails(failure) => {
            // Every failure has been counted.
            1 + failures.iter().position(|known| known.words() == failure.words()).unwrap_or(0)
        }
    };
    HeatMap {
        title: map.title.clone(),
        x: axis(&map.x),
        y: axis(&map.y),
        cells: columns.iter().map(|column| column.cells.iter().map(number).collect()).collect(),
        lines: lines(map, columns),
        kinds: std::iter::once(works).chain(failures.iter().map(kind)).collect(),
    }
}

fn lines(map: &Map, columns: &[Column]) -> Vec<CellLine> {
    let line = |name: &str, is_dashed, y: &dyn Fn(&Column) -> Option<f64>| CellLine {
        name: name.to_owned(),
        points: columns
            .iter()
            .enumerate()
            .map(|(number, column)| Some((number as f64, map.y.place(y(column)?))))
            .collect(),
        is_dashed,
    };
    let found = line("limit found", false, &|column| {
        column.fails_from.and(Some(column.works_to.unwrap_or(0.0)))
    });
    let foretold = line("limit foretold", true, &|column| match column.foretold {
        Foretold::At(at) => Some(at),
        Foretold::NothingWorks => Some(map.y.from * 1e-9),
        Foretold::Unlimited => None,
    });
    let is_shown = |line: &CellLine| line.points.iter().any(Option::is_some);
    [found, foretold].into_iter().filter(is_shown).collect()
}

/// Ticks at round values: 1, 2 and 5 times powers of ten, or evenly.
fn axis(axis: &Axis) -> CellAxis {
    let [low, high] = [axis.from * axis.shown, axis.to * axis.shown];
    let values: Vec<f64> = if axis.is_logarithmic {
        let decades = (high / low).log10();
        let shares: &[f64] = if decades > 2.6 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        (low.log10().floor() as i32..=high.log10().ceil() as i32)
            .flat_map(|power| shares.iter().map(move |share| share * 10_f64.powi(power)))
            .collect()
    } else {
        let step = 10_f64.powf((high - low).log10().floor());
        let step = if (high - low) / step > 4.0 { step } else { 0.5 * step };
        (0..=20).map(|number| (low / step).ceil() * step + step * f64::from(number)).collect()
    };
    let half = 0.5;
    let ticks = values
        .into_iter()
        .map(|value| (axis.place(value / axis.shown), significant(value)))
        .filter(|(place, _)| (-half..=axis.cells as f64 - half).contains(place))
        .collect();
    let description = match axis.unit {
        "" => axis.name.to_owned(),
        unit => format!("{} ({unit})", axis.name),
    };
    CellAxis { description, cells: axis.cells, ticks }
}

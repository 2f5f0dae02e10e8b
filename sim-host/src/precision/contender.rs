//! A method on a problem.

use super::course::Course;
use super::measure::{Level, Played, Span, play, time};
use surefoot_sim::mechanism::StartFailure;

/// Starts a motion with a step (s), and the tolerance that a method which chooses its steps is to keep.
pub type Start = Box<dyn Fn(f64, f64) -> Result<Box<dyn Course>, StartFailure> + Send + Sync>;

/// Plays or times a whole run at a level.
pub trait Runs: Send + Sync {
    /// The step at a level, s.
    fn step_s(&self, span: &Span, level: Level) -> f64;

    /// Plays it.
    fn play(&self, span: &Span, level: Level) -> Played;

    /// Seconds that its steps take; none where it fails.
    fn time(&self, span: &Span, level: Level) -> Option<f64>;
}

/// The longest step that a method is foretold to bear, s, where something is foretold.
pub type Foretell = Box<dyn Fn() -> Option<f64> + Send + Sync>;

/// A method on a problem.
pub struct Contender {
    /// Its name.
    pub name: String,
    /// Order of its trajectories' error, where it has one.
    pub order: Option<u32>,
    /// How finely it can be made, coarsest first.
    pub levels: Vec<Level>,
    /// Runs it.
    pub runs: Box<dyn Runs>,
    /// Foretells its limit.
    pub foretell: Foretell,
}

impl Contender {
    /// A method that makes steps from a start.
    pub fn stepping(name: impl Into<String>, order: Option<u32>, start: Start) -> Self {
        Self::of_starts(name.into(), order, Self::levels_of_steps(), start)
    }

    /// Those of a method with steps of its own.
    pub fn levels_of_steps() -> Vec<Level> {
        divisions().map(|divisions| Level { divisions, tolerance: None }).collect()
    }

    /// The same of a method that chooses its steps within a tolerance.
    pub fn adaptive(name: impl Into<String>, start: Start) -> Self {
        let level = |tenths: i32| Level {
            divisions: 1,
            tolerance: Some(10_f64.powf(-0.5 * f64::from(tenths))),
        };
        let levels = (2..=26).map(level).collect();
        Self::of_starts(name.into(), None, levels, start)
    }

    fn of_starts(name: String, order: Option<u32>, levels: Vec<Level>, start: Start) -> Self {
        Self { name, order, levels, runs: Box::new(Stepping(start)), foretell: Box::new(|| None) }
    }

    /// The same with its limit foretold.
    #[must_use]
    pub fn foretold_by(self, foretell: Foretell) -> Self {
        Self { foretell, ..self }
    }

    /// Whether it chooses its steps.
    pub fn is_adaptive(&self) -> bool {
        self.levels.iter().any(|level| level.tolerance.is_some())
    }
}

/// 1, 2, 3, 4, 6, 8, 12, …: doubled, with the halves between.
fn divisions() -> impl Iterator<Item = u32> {
    [1].into_iter().chain((0..20).flat_map(|power| [2 << power, 3 << power]))
}

struct Stepping(Start);

/// Without one, the tolerance of a run whose error is to be round-off.
const CLOSE: f64 = 1e-12;

impl Stepping {
    fn start(&self, span: &Span, level: Level) -> Result<Box<dyn Course>, StartFailure> {
        (self.0)(self.step_s(span, level), level.tolerance.unwrap_or(CLOSE))
    }
}

impl Runs for Stepping {
    fn step_s(&self, span: &Span, level: Level) -> f64 {
        span.duration_s / f64::from(span.samples) / f64::from(level.divisions)
    }

    fn play(&self, span: &Span, level: Level) -> Played {
        match self.start(span, level) {
            Ok(mut course) => play(course.as_mut(), span, level.divisions),
            Err(failure) => Played { failure: Some(failure.into()), ..Played::default() },
        }
    }

    fn time(&self, span: &Span, level: Level) -> Option<f64> {
        time(self.start(span, level).ok()?.as_mut(), span, level.divisions)
    }
}

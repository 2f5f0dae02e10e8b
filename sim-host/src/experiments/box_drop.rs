//! §5.3, figures 5.3 to 5.6: a box thrown onto the floor.

use super::comparison::{Asked, Comparison};
use super::figure::Figure;
use crate::chart::{XyChart, XySeries};
use surefoot_mechanics::integrators::StepError;
use surefoot_multibody::contact::{ContactState, Switching};
use surefoot_multibody::{BodyState, Simulation};
use surefoot_sim::mechanism::StartFailure;
use surefoot_sim::scene::{AnyScene, Mechanism, SceneError, open};

/// How §5.3 is read.
pub const READING: &str = "friction 0.40 (not printed; 0.37 to 0.445 fit); states, positions and velocities \
                           at midpoints, inside the Newton iteration";

/// Why there is no run.
#[derive(Debug, thiserror::Error)]
pub enum BoxFailure {
    /// The scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Its start.
    #[error(transparent)]
    Start(#[from] StartFailure),
    /// A step.
    #[error(transparent)]
    Step(#[from] StepError),
}

/// The run of §5.3.
pub struct Run {
    times: Vec<f64>,
    states: Vec<BodyState>,
    contacts: Vec<Vec<ContactState>>,
    iterations: Vec<f64>,
    /// From when on nothing moves faster than 1 cm/s, s.
    settled_s: f64,
    split_steps: u64,
}

impl Run {
    /// Runs the scene `box-drop` as the text does: 1.5 s in steps of 1 ms.
    ///
    /// # Errors
    /// A [`BoxFailure`].
    pub fn new() -> Result<Self, BoxFailure> {
        let mut simulation = start()?;
        let mut run = Self {
            times: Vec::new(),
            states: Vec::new(),
            contacts: Vec::new(),
            iterations: Vec::new(),
            settled_s: 0.0,
            split_steps: 0,
        };
        for step in 0..=1500 {
            let before = simulation.progress().iterations;
            if step > 0 {
                simulation.step()?;
            }
            let progress = *simulation.progress();
            run.times.push(progress.time_s);
            run.states.push(simulation.state(0));
            run.contacts.push(simulation.contacts().iter().map(|point| point.state).collect());
            run.iterations.push((progress.iterations - before) as f64);
            if simulation.column_rates()?.iter().any(|v| v.abs() > 1e-2) {
                run.settled_s = progress.time_s;
            }
            run.split_steps = progress.split_steps;
        }
        Ok(run)
    }

    /// Figures 5.3 to 5.6.
    pub fn figures(&self) -> Vec<Figure> {
        let curve = |name: &str, value: &dyn Fn(usize) -> f64| {
            let points = self.times.iter().enumerate().map(|(k, t)| (*t, value(k)));
            XySeries::curve(name, points)
        };
        let coordinate = |name: &str, i: usize| curve(name, &|k| self.states[k][i]);
        let panel = |title: &str, name: &str, i: usize| {
            XyChart::new(title, "time (s)", "m").with(vec![coordinate(name, i)])
        };
        // Each point's states in a row of its own, 8 at the top.
        let states = (0..8_usize)
            .map(|point| {
                let base = 8.0 * point as f64;
                curve(&format!("vertex {}", point + 1), &|k| {
                    base + f64::from(self.contacts[k][point].number())
                })
            })
            .collect();
        vec![
            Figure {
                name: "figure-5.3",
                reading: READING,
                chart: panel("Figure 5.3: centre of mass", "x", 0)
                    .below(panel("sideways", "y", 1))
                    .below(panel("height", "z", 2)),
                rows: self.motion(),
            },
            Figure {
                name: "figure-5.4",
                reading: READING,
                chart: XyChart::new("Figure 5.4: orientation", "time (s)", "unit quaternion").with(
                    ["scalar", "x", "y", "z"]
                        .iter()
                        .enumerate()
                        .map(|(i, name)| coordinate(name, 3 + i))
                        .collect(),
                ),
                rows: self.turn(),
            },
            Figure {
                name: "figure-5.5",
                reading: READING,
                chart: XyChart::new(
                    "Figure 5.5: friction states (1 free, 2 sliding, 4 sticking, 6 leaving)",
                    "time (s)",
                    "state + 8 (vertex − 1)",
                )
                .with(states),
                rows: self.friction(),
            },
            Figure {
                name: "figure-5.6",
                reading: READING,
                chart: XyChart::new("Figure 5.6: Newton iterations", "time (s)", "iterations")
                    .with(vec![curve("iterations", &|k| self.iterations[k])]),
                rows: self.newton(),
            },
        ]
    }

    fn first_contact(&self) -> usize {
        let touches = |states: &Vec<ContactState>| states.iter().any(|s| *s != ContactState::Free);
        self.contacts.iter().position(touches).unwrap_or(0)
    }

    fn motion(&self) -> Vec<Comparison> {
        let first = self.first_contact();
        let sideways = self.states[..first].iter().map(|x| x[1].abs()).fold(0.0, f64::max);
        let sideways = Comparison::new("largest |y| before the impact", "m", sideways, 0.0);
        vec![
            Comparison::new("vertex 1 strikes", "s", self.times[first], 0.102)
                .asked(Asked::PrintedDigits(3)),
            sideways.asked(Asked::Absolute(1e-9)),
            Comparison::new("at rest from", "s", self.settled_s, 1.3).asked(Asked::Relative(0.05)),
        ]
    }

    /// Height of the top's direction at the end: −1 when it lies below.
    fn turn(&self) -> Vec<Comparison> {
        let last = self.states.last().map_or([0.0; 7], |x| *x);
        let up = 1.0 - 2.0 * (last[4] * last[4] + last[5] * last[5]);
        let row = Comparison::new("the top's direction, at the end", "", up, -1.0);
        vec![row.asked(Asked::Absolute(1e-3))]
    }

    fn friction(&self) -> Vec<Comparison> {
        let count = |states: &[ContactState], which: ContactState| {
            states.iter().filter(|state| **state == which).count() as f64
        };
        let touched = (2..4)
            .filter(|k| self.contacts.iter().any(|states| states[*k] != ContactState::Free))
            .count() as f64;
        let last = self.contacts.last().map_or(&[][..], |states| states);
        let sticking = count(last.get(4..).unwrap_or(&[]), ContactState::Sticking);
        vec![
            Comparison::new("of vertices 3 and 4, ever in contact", "", touched, 0.0)
                .asked(Asked::Absolute(0.0)),
            Comparison::new("of vertices 5 to 8, sticking at the end", "", sticking, 4.0)
                .asked(Asked::Absolute(0.0)),
        ]
    }

    fn newton(&self) -> Vec<Comparison> {
        let most = self.iterations.iter().copied().fold(0.0, f64::max);
        vec![
            Comparison::new("iterations, at most", "", most, 5.0).asked(Asked::Absolute(0.0)),
            Comparison::new("steps made in shorter ones", "", self.split_steps as f64, 0.0)
                .asked(Asked::Absolute(0.0)),
        ]
    }
}

/// The scene as the text reads it.
fn start() -> Result<Simulation, BoxFailure> {
    let name = "box-drop";
    let scene = match open(name)? {
        AnyScene::Mechanism(scene) => scene,
        AnyScene::Robot(scene) => return Err(not_a_box(&scene.name)),
    };
    let Mechanism::Multibody(mut bodies) = scene.mechanism else { return Err(not_a_box(name)) };
    bodies.switching = Switching::AtMidpoint;
    Ok(bodies.start(1e-3).map_err(StartFailure::from)?)
}

fn not_a_box(name: &str) -> BoxFailure {
    let (name, field) = (name.to_owned(), "mechanism.kind".to_owned());
    BoxFailure::Scene(SceneError::Value {
        line: None,
        name,
        field,
        value: "another".to_owned(),
        expected: "multibody".to_owned(),
    })
}

//! §2.4.1, table 2.1 and figures 2.2 to 2.6: the free rigid body under the discrete Euler–Lagrange
//! equations.
//!
//! Reading: 301 samples, every 0.1 s from 0 to 30 s, with the error (2.53). The first pair is an Euler
//! step of 10⁻⁵ s, normalized; with it the method itself goes on at 10⁻⁵ s to the second point of each
//! larger step. Energy and momentum are compared with those of the first pair, orientations with the
//! run of 10⁻⁴ s.

use super::comparison::{Asked, Comparison};
use super::figure::{Figure, against_step};
use super::samples::{SAMPLES, Sampled, mean_distance, sampled_every, slope_of};
use crate::chart::{XyChart, XySeries};
use std::time::Instant;
use surefoot_mechanics::integrators::{Integrator, StepError, Variational};
use surefoot_mechanics::systems::FreeRigidBody;

/// How the table is read.
pub const READING: &str = "301 samples, every 0.1 s from 0 to 30 s; energy and momentum against the \
    first pair of 1e-5 s, quaternions against the run of 1e-4 s";

const BODY: FreeRigidBody = FreeRigidBody::PRINTED;
const FINE: f64 = 1e-5;

/// Step, printed errors in quaternion, energy and momentum, printed CPU time in s (SGI Indy, 100 MHz).
pub const PRINTED: [(f64, [f64; 3], f64); 4] = [
    (1e-4, [0.0, 6.256e-7, 1.671e-7], 97.620),
    (1e-3, [3.960e-6, 6.274e-5, 1.687e-5], 9.905),
    (1e-2, [3.997e-4, 6.274e-3, 1.687e-3], 1.397),
    (1e-1, [3.648e-2, 6.217e-1, 1.665e-1], 0.301),
];

/// The runs, the finest first.
pub struct Runs {
    runs: Vec<Sampled<4, 3>>,
    energy: [f64; 1],
    momentum: [f64; 3],
}

impl Runs {
    /// Makes them.
    ///
    /// # Errors
    /// A step that could not be made.
    pub fn new() -> Result<Self, StepError> {
        let first = [1.0, 0.0, 0.0, 0.0];
        let second = euler_step(&first, &[0.0, 3.0, 4.0], FINE);
        let d = std::array::from_fn(|i| (second[i] - first[i]) / FINE);
        let energy = [BODY.kinetic_energy(&FreeRigidBody::angular_velocity(&first, &d))];
        let momentum = BODY.discrete_momentum(&first, &d, FINE);
        let runs = PRINTED.iter().map(|(h, ..)| run(&first, &second, *h)).collect::<Result<_, _>>();
        Ok(Self { runs: runs?, energy, momentum })
    }

    /// Errors in quaternion, energy and momentum of each run.
    fn errors(&self) -> Vec<[f64; 3]> {
        let standard = &self.runs[0].configurations;
        self.runs
            .iter()
            .map(|run| {
                [
                    mean_distance(run.configurations.iter().zip(standard)),
                    mean_distance(run.energies.iter().map(|e| (e, &self.energy))),
                    mean_distance(run.momenta.iter().map(|m| (m, &self.momentum))),
                ]
            })
            .collect()
    }

    /// All rows of table 2.1. Asked for: all four printed digits, and 1 % of the energy at 10⁻⁴ s,
    /// which is the round-off of its day.
    pub fn table_2_1(&self) -> Vec<Comparison> {
        let names = [("quaternion error", "1"), ("energy error", "J"), ("momentum error", "N·m·s")];
        let mut rows = Vec::new();
        for (errors, (h, printed, _)) in self.errors().into_iter().zip(PRINTED) {
            for (k, ((what, unit), ours)) in names.into_iter().zip(errors).enumerate() {
                let row = Comparison::new(format!("{what}, h = {h:e} s"), unit, ours, printed[k]);
                rows.push(match (h < 5e-4, k) {
                    (false, _) => row.asked(Asked::PrintedDigits(4)),
                    (true, 1) => row.asked(Asked::Relative(0.01)),
                    (true, _) => row,
                });
            }
        }
        rows
    }

    /// Figures 2.2 to 2.6.
    pub fn figures(&self) -> Vec<Figure> {
        let steps: Vec<f64> = PRINTED.iter().map(|(h, ..)| *h).collect();
        let errors = self.errors();
        let of = |k: usize| -> Vec<f64> { errors.iter().map(|e| e[k]).collect() };
        let printed = |k: usize| -> Vec<f64> { PRINTED.iter().map(|(_, e, _)| e[k]).collect() };
        let times: Vec<f64> = self.runs.iter().map(|run| run.wall_s).collect();
        let printed_times: Vec<f64> = PRINTED.iter().map(|(.., cpu)| *cpu).collect();
        let curves = |ours: &[f64], printed: &[f64], of: &str| {
            vec![
                XySeries::against(format!("{of}, ours"), &steps, ours),
                XySeries::against(format!("{of}, printed"), &steps, printed).rings(),
            ]
        };
        let second_order = |ours: &[f64], printed: &[f64]| {
            // The errors at 10⁻⁴ s are zero or round-off.
            let slope = |y: &[f64]| slope_of(&steps[1..], &y[1..]);
            vec![Comparison::new("slope from 1e-3 to 1e-1 s", "1", slope(ours), slope(printed))]
        };
        let error = |name, k: usize, what: &str, axis: &str| {
            let (ours, theirs) = (of(k), printed(k));
            let chart = against_step(format!("{what} of the free rigid body"), axis)
                .with(curves(&ours, &theirs, what));
            Figure { name, reading: READING, chart, rows: second_order(&ours, &theirs) }
        };
        vec![
            Figure {
                name: "figure-2.2",
                reading: "time on this machine, and on the SGI Indy of the text; starts not counted",
                chart: against_step("Time of the rigid body's simulation", "s for 30 s")
                    .with(curves(&times, &printed_times, "time")),
                rows: vec![Comparison::new(
                    "slope of time",
                    "1",
                    slope_of(&steps, &times),
                    slope_of(&steps, &printed_times),
                )],
            },
            error("figure-2.3", 0, "Quaternion error", "1"),
            Figure {
                name: "figure-2.4",
                reading: "component y of the quaternion",
                chart: XyChart::new(
                    "Quaternion coordinate of the free rigid body",
                    "time (s)",
                    "q_y",
                )
                .with(vec![self.coordinate(0), self.coordinate(3)]),
                rows: Vec::new(),
            },
            error("figure-2.5", 1, "Energy error", "J"),
            error("figure-2.6", 2, "Momentum error", "N·m·s"),
        ]
    }

    fn coordinate(&self, run: usize) -> XySeries {
        let run = &self.runs[run];
        let points = run.times().zip(run.configurations.iter().map(|q| q[2]));
        XySeries::curve(format!("h = {:e} s", run.h), points)
    }
}

/// `q + h q̇`, normalized.
fn euler_step(q: &[f64; 4], omega: &[f64; 3], h: f64) -> [f64; 4] {
    let rate = FreeRigidBody::rate(q, omega);
    let moved: [f64; 4] = std::array::from_fn(|i| q[i] + h * rate[i]);
    let norm = moved.iter().map(|x| x * x).sum::<f64>().sqrt();
    moved.map(|x| x / norm)
}

fn run(first: &[f64; 4], second: &[f64; 4], h: f64) -> Result<Sampled<4, 3>, StepError> {
    let mut start = Variational::<_, 4, 1, 5>::from_two(BODY, FINE, *first, *second);
    for _ in 0..(h / FINE).round() as usize {
        start.step()?;
    }
    let mut motion = Variational::<_, 4, 1, 5>::from_two(BODY, h, *first, *start.configuration());
    let begun = Instant::now();
    let every = sampled_every(h);
    let mut samples = Sampled::new("DVP", h);
    for step in 0..=every * (SAMPLES - 1) {
        let x = *motion.configuration();
        motion.step()?;
        if step % every == 0 {
            let d = motion.mean_velocity();
            samples.configurations.push(x);
            samples.energies.push([BODY.kinetic_energy(&FreeRigidBody::angular_velocity(&x, d))]);
            samples.momenta.push(BODY.discrete_momentum(&x, d, h));
        }
    }
    samples.wall_s = begun.elapsed().as_secs_f64();
    Ok(samples)
}

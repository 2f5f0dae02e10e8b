//! §2.4.2, table 2.2 and figures 2.7 to 2.12: the double spherical pendulum by SHAKE ("DVP") and by
//! the energy-momentum method ("EM").
//!
//! Reading: 301 samples, every 0.1 s from 0 to 30 s, with the error (2.56). Positions are compared with
//! the energy-momentum run of 10⁻⁴ s, whose first step also starts DVP; energy and momentum with the
//! start's. DVP's energy is `½ |Δq/h|²_M + V` of the midpoint, its momentum `Σ m (x_k × Δx/h)_z`.

use super::comparison::{Asked, Comparison};
use super::figure::{Figure, against_step};
use super::samples::{SAMPLES, Sampled, mean_distance, sampled_every, slope_of};
use crate::chart::{XyChart, XySeries};
use std::time::Instant;
use surefoot_mechanics::Lagrangian;
use surefoot_mechanics::integrators::{EnergyMomentum, Form, Integrator, Shake, StepError};
use surefoot_mechanics::systems::DoubleSphericalPendulum;

/// How the table is read.
pub const READING: &str = "301 samples, every 0.1 s from 0 to 30 s; against the energy-momentum run of \
    1e-4 s, and the start's energy and momentum; initial values as printed, rounded";

const PENDULUM: DoubleSphericalPendulum = DoubleSphericalPendulum::PRINTED;
const FINE: f64 = 1e-4;

/// Step, printed errors in position, energy and momentum of DVP and of EM, and printed CPU times in s.
pub const PRINTED: [(f64, [[f64; 3]; 2], [f64; 2]); 4] = [
    (1e-4, [[2.329e-7, 6.475e-6, 2.547e-6], [0.0; 3]], [73.648, 103.871]),
    (1e-3, [[1.146e-5, 3.269e-4, 1.707e-4], [1.214e-5, 0.0, 0.0]], [9.065, 13.250]),
    (1e-2, [[1.135e-3, 3.224e-2, 1.696e-2], [1.225e-3, 0.0, 0.0]], [1.152, 1.549]),
    (1e-1, [[9.576e-2, 2.665, 1.560], [1.184e-1, 0.0, 0.0]], [0.211, 0.263]),
];

const METHODS: [&str; 2] = ["DVP", "EM"];

/// The runs, the finest first, of DVP and EM each.
pub struct Runs {
    runs: Vec<[Sampled<6, 1>; 2]>,
    /// `λ` of both rods at DVP's samples.
    multipliers: Vec<Vec<[f64; 2]>>,
    /// The start's.
    energy: [f64; 1],
    /// The start's.
    momentum: [f64; 1],
}

impl Runs {
    /// Makes them.
    ///
    /// # Errors
    /// A step that could not be made.
    pub fn new() -> Result<Self, StepError> {
        let (q, v) = PENDULUM.printed_start();
        Self::from(q, v, &PRINTED.map(|(h, ..)| h))
    }

    /// The same from other initial values, and for other steps.
    ///
    /// # Errors
    /// A step that could not be made.
    pub fn from(q: [f64; 6], v: [f64; 6], steps: &[f64]) -> Result<Self, StepError> {
        let (energy, momentum) = ([PENDULUM.energy(&q, &v)], [PENDULUM.vertical_momentum(&q, &v)]);
        let (mut runs, mut multipliers) = (Vec::new(), Vec::new());
        for h in steps {
            let (dvp, lambda) = variational(q, v, *h)?;
            runs.push([dvp, energy_momentum(q, v, *h)?]);
            multipliers.push(lambda);
        }
        Ok(Self { runs, multipliers, energy, momentum })
    }

    /// Errors in position, energy and momentum of each run, of DVP and EM.
    pub fn errors(&self) -> Vec<[[f64; 3]; 2]> {
        let standard = &self.runs[0][1].configurations;
        let errors = |run: &Sampled<6, 1>| {
            [
                mean_distance(run.configurations.iter().zip(standard)),
                mean_distance(run.energies.iter().map(|e| (e, &self.energy))),
                mean_distance(run.momenta.iter().map(|m| (m, &self.momentum))),
            ]
        };
        self.runs.iter().map(|[dvp, em]| [errors(dvp), errors(em)]).collect()
    }

    /// All rows of table 2.2. Asked for: 0.4 % of what is printed, as the printed initial values are
    /// rounded; EM's conserved quantities to round-off.
    pub fn table_2_2(&self) -> Vec<Comparison> {
        let names = [("position error", "m"), ("energy error", "J"), ("momentum error", "N·m·s")];
        let mut rows = Vec::new();
        for (ours, (h, printed, _)) in self.errors().into_iter().zip(PRINTED) {
            for (m, method) in METHODS.into_iter().enumerate() {
                for (k, (what, unit)) in names.into_iter().enumerate() {
                    let figure = format!("{method}: {what}, h = {h:e} s");
                    let (ours, printed) = (ours[m][k], printed[m][k]);
                    let asked =
                        if printed == 0.0 { Asked::Absolute(1e-10) } else { Asked::Relative(4e-3) };
                    rows.push(Comparison::new(figure, unit, ours, printed).asked(asked));
                }
            }
        }
        rows
    }

    /// Figures 2.7 to 2.12.
    pub fn figures(&self) -> Vec<Figure> {
        let steps: Vec<f64> = self.runs.iter().map(|[dvp, _]| dvp.h).collect();
        let errors = self.errors();
        let error = |name, k: usize, what: &str, axis: &str| {
            let mut curves = Vec::new();
            for (m, method) in METHODS.into_iter().enumerate() {
                let ours: Vec<f64> = errors.iter().map(|e| e[m][k]).collect();
                let printed: Vec<f64> = PRINTED.iter().map(|(_, e, _)| e[m][k]).collect();
                if printed.iter().any(|e| *e > 0.0) {
                    curves.push(XySeries::against(format!("{method}, ours"), &steps, &ours));
                    curves.push(
                        XySeries::against(format!("{method}, printed"), &steps, &printed).rings(),
                    );
                }
            }
            let slope = |values: Vec<f64>| slope_of(&steps[1..], &values[1..]);
            let rows = vec![Comparison::new(
                "DVP: slope from 1e-3 to 1e-1 s",
                "1",
                slope(errors.iter().map(|e| e[0][k]).collect()),
                slope(PRINTED.iter().map(|(_, e, _)| e[0][k]).collect()),
            )];
            let title = format!("{what} of the double spherical pendulum");
            Figure { name, reading: READING, chart: against_step(title, axis).with(curves), rows }
        };
        vec![
            self.figure_2_7(&steps),
            error("figure-2.8", 0, "Position error", "m"),
            Figure {
                name: "figure-2.9",
                reading: "y of the second mass",
                chart: XyChart::new(
                    "Second mass of the double spherical pendulum",
                    "time (s)",
                    "y (m)",
                )
                .with(vec![
                    self.series(0, 1, |run, k| run.configurations[k][4]),
                    self.series(3, 0, |run, k| run.configurations[k][4]),
                    self.series(3, 1, |run, k| run.configurations[k][4]),
                ]),
                rows: Vec::new(),
            },
            error("figure-2.10", 1, "Energy error", "J"),
            error("figure-2.11", 2, "Momentum error", "N·m·s"),
            self.figure_2_12(),
        ]
    }

    fn figure_2_7(&self, steps: &[f64]) -> Figure {
        let mut curves = Vec::new();
        for (m, method) in METHODS.into_iter().enumerate() {
            let ours: Vec<f64> = self.runs.iter().map(|runs| runs[m].wall_s).collect();
            let printed = PRINTED.map(|(.., cpu)| cpu[m]);
            curves.push(XySeries::against(format!("{method}, ours"), steps, &ours));
            curves.push(XySeries::against(format!("{method}, printed"), steps, &printed).rings());
        }
        let rows = self.runs.iter().zip(PRINTED).map(|([dvp, em], (h, _, [dvp_s, em_s]))| {
            let ratio = dvp.wall_s / em.wall_s;
            Comparison::new(format!("time of DVP over EM's, h = {h:e} s"), "1", ratio, dvp_s / em_s)
        });
        Figure {
            name: "figure-2.7",
            reading: "time on this machine, and on the SGI Indy of the text; starts not counted",
            rows: rows.collect(),
            chart: against_step("Time of the double spherical pendulum's simulation", "s for 30 s")
                .with(curves),
        }
    }

    /// Energies, and below them the multipliers that their swings go with.
    fn figure_2_12(&self) -> Figure {
        let energy = |title: &str, runs: [usize; 2]| {
            let series = runs.map(|run| self.series(run, 0, |run, k| run.energies[k][0]));
            XyChart::new(title, "time (s)", "energy (J)").with(series.to_vec())
        };
        let h = self.runs[2][0].h;
        let rods = (0..2).map(|rod| {
            // Those of the first step, which the start gives, are not known.
            let lambda = self.multipliers[2].iter().map(|lambda| lambda[rod]);
            let points = self.runs[2][0].times().zip(lambda).skip(1);
            XySeries::curve(format!("rod {}, h = {h:e} s", rod + 1), points)
        });
        let extremes = |run: usize| {
            let energies = self.runs[run][0].energies.iter().map(|e| e[0]);
            (energies.clone().fold(f64::INFINITY, f64::min), energies.fold(0.0, f64::max))
        };
        let (low, high) = extremes(3);
        let (fine_low, fine_high) = extremes(0);
        Figure {
            name: "figure-2.12",
            reading: "energy ½|Δq/h|² + V(midpoint) at 301 samples; λ of (2.55)",
            chart: energy("Energy of the double spherical pendulum, short steps", [0, 1])
                .below(XyChart::new("Multipliers", "time (s)", "λ (N/m)").with(rods.collect()))
                .below(energy("Energy, long steps", [2, 3])),
            rows: vec![
                Comparison::new("least energy, h = 1e-1 s", "J", low, 20.910_805_793),
                Comparison::new("greatest energy, h = 1e-1 s", "J", high, 25.583_335_766),
                Comparison::new("swing of energy, h = 1e-4 s", "J", fine_high - fine_low, 4.719e-6),
            ],
        }
    }

    fn series(
        &self,
        run: usize,
        method: usize,
        value: impl Fn(&Sampled<6, 1>, usize) -> f64,
    ) -> XySeries {
        let run = &self.runs[run][method];
        let points = run.times().enumerate().map(|(k, time)| (time, value(run, k)));
        XySeries::curve(format!("{}, h = {:e} s", run.method, run.h), points)
    }
}

fn energy_momentum(q: [f64; 6], v: [f64; 6], h: f64) -> Result<Sampled<6, 1>, StepError> {
    let mut motion = EnergyMomentum::<_, 6, 2, 8>::new(PENDULUM, h, q, &v);
    let begun = Instant::now();
    let every = sampled_every(h);
    let mut samples = Sampled::new("EM", h);
    for step in 0..=every * (SAMPLES - 1) {
        if step % every == 0 {
            let (q, v) = (motion.configuration(), motion.velocity()?);
            samples.configurations.push(*q);
            samples.energies.push([PENDULUM.energy(q, &v)]);
            samples.momenta.push([PENDULUM.vertical_momentum(q, &v)]);
        }
        motion.step()?;
    }
    samples.wall_s = begun.elapsed().as_secs_f64();
    Ok(samples)
}

type WithMultipliers = (Sampled<6, 1>, Vec<[f64; 2]>);

fn variational(q: [f64; 6], v: [f64; 6], h: f64) -> Result<WithMultipliers, StepError> {
    let mut start = EnergyMomentum::<_, 6, 2, 8>::new(PENDULUM, FINE, q, &v);
    for _ in 0..(h / FINE).round() as usize {
        start.step()?;
    }
    let mut motion = Shake::from_two(PENDULUM, Form::Velocities, h, q, *start.configuration());
    let begun = Instant::now();
    let every = sampled_every(h);
    let (mut samples, mut multipliers) = (Sampled::new("DVP", h), Vec::new());
    for step in 0..=every * (SAMPLES - 1) {
        if step % every == 0 {
            let (x, d) = (*motion.configuration(), motion.mean_velocity());
            let middle = std::array::from_fn(|i| x[i] + 0.5 * h * d[i]);
            samples.configurations.push(x);
            samples.energies.push([PENDULUM.energy(&middle, &d)]);
            samples.momenta.push([PENDULUM.vertical_momentum(&x, &d)]);
            multipliers.push(*motion.multipliers());
        }
        motion.step()?;
    }
    samples.wall_s = begun.elapsed().as_secs_f64();
    Ok((samples, multipliers))
}

//! Table 2.2: the double spherical pendulum of §2.4.2, by SHAKE ("DVP") and by the energy-momentum
//! method ("EM").
//!
//! Reading: 301 samples, every 0.1 s from 0 to 30 s, with the error (2.56). Positions are compared with
//! the energy-momentum run of 10⁻⁴ s, whose first step also starts DVP; energy and momentum with the
//! start's. DVP's energy is `½ |Δq/h|²_M + V` of the midpoint, its momentum `Σ m (x_k × Δx/h)_z`.
//! Printed initial values are rounded, which leaves some 0.3 %.

use super::{Comparison, mean_distance};
use crate::integrators::{EnergyMomentum, StepError, Variational};
use crate::mechanics::systems::DoubleSphericalPendulum;
use crate::mechanics::{Endpoint, Natural};

const PENDULUM: DoubleSphericalPendulum = DoubleSphericalPendulum::PRINTED;
const FINE: f64 = 1e-4;
const SAMPLES: usize = 301;
const SAMPLE_S: f64 = 0.1;

/// Step, and printed errors in position, energy and momentum of DVP and of EM.
pub const PRINTED: [(f64, [f64; 3], [f64; 3]); 4] = [
    (1e-4, [2.329e-7, 6.475e-6, 2.547e-6], [0.0; 3]),
    (1e-3, [1.146e-5, 3.269e-4, 1.707e-4], [1.214e-5, 0.0, 0.0]),
    (1e-2, [1.135e-3, 3.224e-2, 1.696e-2], [1.225e-3, 0.0, 0.0]),
    (1e-1, [9.576e-2, 2.665, 1.560], [1.184e-1, 0.0, 0.0]),
];

struct Samples {
    positions: Vec<[f64; 6]>,
    energies: Vec<[f64; 1]>,
    momenta: Vec<[f64; 1]>,
}

impl Samples {
    fn new() -> Self {
        Self { positions: Vec::new(), energies: Vec::new(), momenta: Vec::new() }
    }

    fn errors(&self, positions: &[[f64; 6]], energy: f64, momentum: f64) -> [f64; 3] {
        let (energy, momentum) = ([energy], [momentum]);
        [
            mean_distance(self.positions.iter().zip(positions)),
            mean_distance(self.energies.iter().map(|e| (e, &energy))),
            mean_distance(self.momenta.iter().map(|m| (m, &momentum))),
        ]
    }
}

/// All rows of the table.
///
/// # Errors
/// A step that could not be made.
pub fn table_2_2() -> Result<Vec<Comparison>, StepError> {
    let (q, v) = PENDULUM.printed_start();
    let energy = PENDULUM.energy(&q, &v);
    let momentum = PENDULUM.vertical_momentum(&q, &v);
    let standard = energy_momentum(FINE)?;
    let mut rows = Vec::new();
    for (h, dvp, em) in PRINTED {
        for (method, samples, printed) in
            [("DVP", variational(h)?, dvp), ("EM", energy_momentum(h)?, em)]
        {
            let errors = samples.errors(&standard.positions, energy, momentum);
            let names =
                [("position error", "m"), ("energy error", "J"), ("momentum error", "N·m·s")];
            for (((what, unit), ours), printed) in names.into_iter().zip(errors).zip(printed) {
                rows.push(Comparison::new(
                    format!("{method}: {what}, h = {h:e} s"),
                    unit,
                    ours,
                    printed,
                ));
            }
        }
    }
    Ok(rows)
}

fn energy_momentum(h: f64) -> Result<Samples, StepError> {
    let (q, v) = PENDULUM.printed_start();
    let mut motion = EnergyMomentum::<_, 6, 2, 8>::new(PENDULUM, h, q, &v);
    let every = (SAMPLE_S / h).round() as usize;
    let mut samples = Samples::new();
    for step in 0..=every * (SAMPLES - 1) {
        if step % every == 0 {
            let (q, v) = (motion.configuration(), motion.velocity());
            samples.positions.push(*q);
            samples.energies.push([PENDULUM.energy(q, &v)]);
            samples.momenta.push([PENDULUM.vertical_momentum(q, &v)]);
        }
        motion.step()?;
    }
    Ok(samples)
}

fn variational(h: f64) -> Result<Samples, StepError> {
    let (q, v) = PENDULUM.printed_start();
    let mut start = EnergyMomentum::<_, 6, 2, 8>::new(PENDULUM, FINE, q, &v);
    for _ in 0..(h / FINE).round() as usize {
        start.step()?;
    }
    let second = *start.configuration();
    let mut motion = Variational::<_, 6, 2, 8>::from_two(Endpoint(PENDULUM), h, q, second);
    let every = (SAMPLE_S / h).round() as usize;
    let mut samples = Samples::new();
    for step in 0..=every * (SAMPLES - 1) {
        let x = *motion.configuration();
        let d = motion.step()?;
        if step % every == 0 {
            let middle = std::array::from_fn(|i| x[i] + 0.5 * h * d[i]);
            samples.positions.push(x);
            samples.energies.push([PENDULUM.energy(&middle, &d)]);
            samples.momenta.push([PENDULUM.vertical_momentum(&x, &d)]);
        }
    }
    Ok(samples)
}

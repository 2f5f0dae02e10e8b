//! Table 2.1: the free rigid body of §2.4.1 under the discrete Euler–Lagrange equations.
//!
//! Reading: 301 samples, every 0.1 s from 0 to 30 s, with the error (2.53). The first pair is an Euler
//! step of 10⁻⁵ s, normalized; with it the method itself goes on at 10⁻⁵ s to the second point of each
//! larger step. Energy and momentum are compared with those of the first pair, orientations with the
//! run of 10⁻⁴ s.

use super::{Comparison, mean_distance};
use crate::integrators::{StepError, Variational};
use crate::mechanics::systems::FreeRigidBody;

const BODY: FreeRigidBody = FreeRigidBody::PRINTED;
const FINE: f64 = 1e-5;
const SAMPLES: usize = 301;
const SAMPLE_S: f64 = 0.1;

/// Step, and printed errors in quaternion, energy and momentum.
pub const PRINTED: [(f64, [f64; 3]); 4] = [
    (1e-4, [0.0, 6.256e-7, 1.671e-7]),
    (1e-3, [3.960e-6, 6.274e-5, 1.687e-5]),
    (1e-2, [3.997e-4, 6.274e-3, 1.687e-3]),
    (1e-1, [3.648e-2, 6.217e-1, 1.665e-1]),
];

/// One run's samples.
struct Samples {
    orientations: Vec<[f64; 4]>,
    energies: Vec<[f64; 1]>,
    momenta: Vec<[f64; 3]>,
}

/// All rows of the table.
///
/// # Errors
/// A step that could not be made.
pub fn table_2_1() -> Result<Vec<Comparison>, StepError> {
    let first = [1.0, 0.0, 0.0, 0.0];
    let second = euler_step(&first, &[0.0, 3.0, 4.0], FINE);
    let d = std::array::from_fn(|i| (second[i] - first[i]) / FINE);
    let energy = [BODY.energy(&FreeRigidBody::angular_velocity(&first, &d))];
    let momentum = BODY.discrete_momentum(&first, &d, FINE);
    let mut rows = Vec::new();
    let mut standard: Option<Vec<[f64; 4]>> = None;
    for (h, printed) in PRINTED {
        let run = run(&first, &second, h)?;
        let orientations = standard.get_or_insert_with(|| run.orientations.clone());
        let errors = [
            mean_distance(run.orientations.iter().zip(orientations.iter())),
            mean_distance(run.energies.iter().map(|e| (e, &energy))),
            mean_distance(run.momenta.iter().map(|m| (m, &momentum))),
        ];
        let names = [("quaternion error", "1"), ("energy error", "J"), ("momentum error", "N·m·s")];
        for (((what, unit), ours), printed) in names.into_iter().zip(errors).zip(printed) {
            rows.push(Comparison::new(format!("{what}, h = {h:e} s"), unit, ours, printed));
        }
    }
    Ok(rows)
}

/// `q + h q̇` with `q̇ = q ⋆ (0, ω/2)`, normalized.
fn euler_step(q: &[f64; 4], omega: &[f64; 3], h: f64) -> [f64; 4] {
    let quaternion = surefoot::spatial::Quaternion::from_array(*q);
    let rate = quaternion.rate((*omega).into()).to_array();
    let moved: [f64; 4] = std::array::from_fn(|i| q[i] + h * rate[i]);
    let norm = moved.iter().map(|x| x * x).sum::<f64>().sqrt();
    moved.map(|x| x / norm)
}

fn run(first: &[f64; 4], second: &[f64; 4], h: f64) -> Result<Samples, StepError> {
    let mut start = Variational::<_, 4, 1, 5>::from_two(BODY, FINE, *first, *second);
    for _ in 0..(h / FINE).round() as usize {
        start.step()?;
    }
    let second = *start.configuration();
    let mut motion = Variational::<_, 4, 1, 5>::from_two(BODY, h, *first, second);
    let every = (SAMPLE_S / h).round() as usize;
    let mut samples =
        Samples { orientations: Vec::new(), energies: Vec::new(), momenta: Vec::new() };
    for step in 0..=every * (SAMPLES - 1) {
        let x = *motion.configuration();
        let d = motion.step()?;
        if step % every == 0 {
            samples.orientations.push(x);
            samples.energies.push([BODY.energy(&FreeRigidBody::angular_velocity(&x, &d))]);
            samples.momenta.push(BODY.discrete_momentum(&x, &d, h));
        }
    }
    Ok(samples)
}

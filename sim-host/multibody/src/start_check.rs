//! Whether a start is on a system's manifold.

use super::body::BodyState;
use super::joint::Rows;
use super::system::{Link, System, WORLD};
use super::system_error::SystemError;

impl System {
    /// Checks a start on its manifold.
    pub(super) fn check_start(
        &self,
        states: &[BodyState],
        rates: &[BodyState],
    ) -> Result<(), SystemError> {
        const CLOSE: f64 = 1e-8;
        let links = self.links().len();
        for given in [states.len(), rates.len()] {
            if given != links {
                return Err(SystemError::Length { given, links });
            }
        }
        let still: BodyState = [0.0; 7];
        let sizes = Sizes::of(self, rates);
        for (link, (x, v)) in states.iter().zip(rates).enumerate() {
            if let Some(coordinate) = (0..7).find(|i| !(x[*i].is_finite() && v[*i].is_finite())) {
                return Err(SystemError::NotFinite { link, coordinate });
            }
            let norm: f64 = x[3..].iter().map(|q| q * q).sum::<f64>() - 1.0;
            let norm_rate: f64 = (3..7).map(|i| 2.0 * x[i] * v[i]).sum();
            let Link { inboard, joint, .. } = &self.links()[link];
            let (x_i, v_i) = inboard.map_or((&WORLD, &still), |k| (&states[k], &rates[k]));
            let rows = joint.rows(x, x_i);
            let worst = (0..joint.constraints())
                .map(|c| sizes.worst(&rows, c, [x, x_i], [v, v_i]))
                .fold(norm.abs().max(norm_rate.abs() * sizes.time), f64::max);
            if !(worst <= CLOSE) {
                return Err(SystemError::OffManifold { link, value: worst });
            }
        }
        for (number, closure) in self.closures().iter().enumerate() {
            let rows = closure.at(states);
            let (x, v) = (closure.ends(states, &WORLD), closure.ends(rates, &still));
            let worst = (0..closure.constraints()).fold(0.0_f64, |m, c| {
                let found = sizes.worst(&rows, c, [x.0, x.1], [v.0, v.1]);
                if found > m || found.is_nan() { found } else { m }
            });
            if !(worst <= CLOSE * 10.0) {
                return Err(SystemError::OpenLoop { closure: number, value: worst });
            }
        }
        Ok(())
    }
}

/// What a start is measured by: lengths by the system's arms and where it is, angles by one, and rates by the time in
/// which the system moves by as much.
struct Sizes {
    /// m
    length: f64,
    /// s
    time: f64,
}

impl Sizes {
    fn of(system: &System, rates: &[BodyState]) -> Self {
        let length = system.length();
        let fastest = rates.iter().fold(0.0_f64, |m, v| {
            let turning = v[3..].iter().fold(0.0_f64, |m, q| m.max(q.abs()));
            let moving = v[..3].iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            m.max(turning).max(moving / length)
        });
        // At rest any time does.
        let time = if fastest > 0.0 { 1.0 / fastest } else { 1.0 };
        Self { length, time }
    }

    /// Error of a constraint, and what its rate makes of it.
    fn worst(&self, rows: &Rows, c: usize, x: [&BodyState; 2], v: [&BodyState; 2]) -> f64 {
        let [outboard, inboard] = [&rows.outboard[c], &rows.inboard[c]];
        let rate: f64 = (0..7).map(|i| outboard[i] * v[0][i] + inboard[i] * v[1][i]).sum();
        let is_length = outboard[..3].iter().chain(&inboard[..3]).any(|g| *g != 0.0);
        let away = x.iter().flat_map(|x| &x[..3]).fold(self.length, |m, x| m.max(x.abs()));
        let of_error = if is_length { away } else { 1.0 };
        let of_rate = if is_length { self.length } else { 1.0 };
        // `max` would lose a NaN.
        let (error, rate) = (rows.error[c].abs() / of_error, rate.abs() * self.time / of_rate);
        if error > rate || error.is_nan() { error } else { rate }
    }
}

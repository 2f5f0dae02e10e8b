//! Whether a start is on a system's manifold.

use super::body::BodyState;
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
        for (link, (x, v)) in states.iter().zip(rates).enumerate() {
            if let Some(coordinate) = (0..7).find(|i| !(x[*i].is_finite() && v[*i].is_finite())) {
                return Err(SystemError::NotFinite { link, coordinate });
            }
            let speed = v.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
            let norm: f64 = x[3..].iter().map(|q| q * q).sum::<f64>() - 1.0;
            let norm_rate: f64 = (3..7).map(|i| 2.0 * x[i] * v[i]).sum();
            let Link { inboard, joint, .. } = &self.links()[link];
            let (x_i, v_i) = inboard.map_or((&WORLD, &still), |k| (&states[k], &rates[k]));
            let rows = joint.rows(x, x_i);
            let rate = |c: usize| -> f64 {
                (0..7).map(|i| rows.outboard[c][i] * v[i] + rows.inboard[c][i] * v_i[i]).sum()
            };
            let constraints = joint.constraints();
            let worst = (0..constraints)
                .map(|c| rows.error[c].abs().max(rate(c).abs() / speed))
                .fold(norm.abs().max(norm_rate.abs() / speed), f64::max);
            if !(worst <= CLOSE * x.iter().fold(1.0_f64, |m, x| m.max(x.abs()))) {
                return Err(SystemError::OffManifold { link, value: worst });
            }
        }
        for (number, closure) in self.closures().iter().enumerate() {
            let rows = closure.at(states);
            let (v_o, v_i) = closure.ends(rates, &still);
            let worst = (0..closure.constraints()).fold(0.0_f64, |m, c| {
                let rate: f64 = (0..7)
                    .map(|i| rows.outboard[c][i] * v_o[i] + rows.inboard[c][i] * v_i[i])
                    .sum();
                let found = rows.error[c].abs().max(rate.abs());
                if found > m || found.is_nan() { found } else { m }
            });
            if !(worst <= CLOSE * 10.0) {
                return Err(SystemError::OpenLoop { closure: number, value: worst });
            }
        }
        Ok(())
    }
}

//! A step's iterates: where Newton's method is, and where it came from.

use super::super::body::BodyState;
use super::tree_solver::Correction;

/// Room for a step's iterates.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub d: Vec<BodyState>,
    pub multipliers: Vec<Correction>,
    pub corrections: Vec<Correction>,
    /// What corrections are taken from.
    base_d: Vec<BodyState>,
    base_multipliers: Vec<Correction>,
    /// Momenta at the end of the step tried.
    pub ends: Vec<BodyState>,
}

impl Trial {
    pub fn new(rates: &[BodyState], momenta: &[BodyState]) -> Self {
        let none = vec![Correction::default(); rates.len()];
        Self {
            d: rates.to_vec(),
            multipliers: none.clone(),
            corrections: none.clone(),
            base_d: rates.to_vec(),
            base_multipliers: none,
            ends: momenta.to_vec(),
        }
    }

    /// Begins where the last step ended.
    pub fn begin(&mut self, d: &[BodyState], multipliers: &[Correction]) {
        self.d.copy_from_slice(d);
        self.multipliers.copy_from_slice(multipliers);
    }

    /// Keeps the iterate as what corrections are taken from.
    pub fn keep(&mut self) {
        self.base_d.copy_from_slice(&self.d);
        self.base_multipliers.copy_from_slice(&self.multipliers);
    }

    /// A share of the corrections from the base.
    pub fn take(&mut self, share: f64) {
        for k in 0..self.d.len() {
            let correction = &self.corrections[k];
            for i in 0..7 {
                self.d[k][i] = self.base_d[k][i] + share * correction.coordinates[i];
            }
            let (base, tried) = (&self.base_multipliers[k], &mut self.multipliers[k]);
            tried.norm_multiplier = base.norm_multiplier + share * correction.norm_multiplier;
            for (c, to) in tried.multipliers.iter_mut().enumerate() {
                *to = base.multipliers[c] + share * correction.multipliers[c];
            }
        }
    }
}

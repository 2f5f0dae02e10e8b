//! States of the explicit plants, whose robot has a size that the compiler knows.

use super::PlantState;

/// A state of `NQ` coordinates and `NV` velocities.
#[derive(Clone, Copy, Debug)]
pub(super) struct ExplicitState<const NQ: usize, const NV: usize> {
    pub positions: [f64; NQ],
    pub velocities: [f64; NV],
}

impl<const NQ: usize, const NV: usize> ExplicitState<NQ, NV> {
    /// The same numbers; a number that a state of another robot lacks is NaN, which the first step refuses.
    pub fn of(state: &PlantState) -> Self {
        let at = |all: &[f64], i: usize| all.get(i).copied().unwrap_or(f64::NAN);
        Self {
            positions: std::array::from_fn(|i| at(&state.positions, i)),
            velocities: std::array::from_fn(|i| at(&state.velocities, i)),
        }
    }

    /// Writes it.
    pub fn read(&self, state: &mut PlantState) {
        state.positions.clear();
        state.positions.extend(self.positions);
        state.velocities.clear();
        state.velocities.extend(self.velocities);
    }
}

/// Forces of the tree's velocities: torques on the joints, none on the central body.
pub(super) fn generalized<const NV: usize>(torques: &[f64]) -> [f64; NV] {
    let mut all = [0.0; NV];
    all[6..].iter_mut().zip(torques).for_each(|(to, torque)| *to = *torque);
    all
}

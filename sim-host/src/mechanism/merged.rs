//! Bodies of one's own without the joints that do not move.

use super::moving::Moving;
use crate::contact::ContactPoint;
use crate::integrators::{Progress, StepError};
use crate::multibody::{
    BodyState, Checkpoint, JointConstraint, Reduced, Simulation, SystemError, merged,
};

/// A motion of merged links, told as that of all.
struct Merged {
    reduced: Reduced,
    simulation: Simulation,
}

/// The motion with links on fixed joints merged; as it is, if there are none, or no others. So is one whose contact
/// points would change their order, by which events name them.
///
/// # Errors
/// A [`SystemError`].
pub(super) fn without_fixed_joints(
    mut whole: Simulation,
    torques: &[f64],
) -> Result<Box<dyn Moving>, SystemError> {
    let is_fixed = |joint: &JointConstraint| *joint == JointConstraint::Fixed;
    if !whole.system().links().iter().any(|l| is_fixed(&l.joint.constraint)) {
        return Ok(Box::new(whole));
    }
    let reduced = merged(whole.system())?;
    if reduced.system.links().is_empty() {
        return Ok(Box::new(whole));
    }
    let carrier = |link: usize| reduced.carrier(link).and_then(|(link, _)| link);
    let sites = whole.system().sites();
    if !sites.is_sorted_by_key(|site| carrier(site.link)) {
        return Ok(Box::new(whole));
    }
    let states = whole.states();
    // A singular inertia is the first step's to report.
    let Ok(rates) = whole.rates() else { return Ok(Box::new(whole)) };
    let (states, rates) = reduced.start(&states, &rates);
    let h = whole.progress().h;
    let mut simulation = Simulation::new(reduced.system.clone(), h, &states, &rates)?;
    for (link, torque) in torques.iter().enumerate() {
        // What drives a fixed joint does nothing.
        if !is_fixed(&whole.system().links()[link].joint.constraint)
            && let Some((Some(link), _)) = reduced.carrier(link)
        {
            simulation.set_torque(link, *torque);
        }
    }
    Ok(Box::new(Merged { reduced, simulation }))
}

impl Moving for Merged {
    fn step(&mut self) -> Result<(), StepError> {
        self.simulation.step()
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        let rates = self.simulation.rates()?;
        let all = self.reduced.expanded(&self.simulation.states(), &rates);
        // Merging loses no body.
        let (states, rates): (Vec<BodyState>, Vec<BodyState>) = all.into_iter().flatten().unzip();
        Ok((states.concat(), rates.concat()))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        let (energy, momentum, constraint) = self.simulation.conserved()?;
        Ok((energy + self.reduced.still_energy(), momentum, constraint))
    }

    fn progress(&self) -> &Progress {
        self.simulation.progress()
    }

    fn forecast_s(&mut self) -> Option<f64> {
        self.simulation.forecast_s()
    }

    fn unknowns(&self) -> usize {
        self.simulation.unknowns()
    }

    fn contacts(&self) -> &[ContactPoint] {
        self.simulation.contacts()
    }

    fn checkpoint(&self) -> Option<&Checkpoint> {
        Some(self.simulation.checkpoint())
    }

    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), SystemError> {
        self.simulation.restore(checkpoint)
    }
}

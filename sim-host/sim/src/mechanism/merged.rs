//! Bodies of one's own without the joints that do not move.

use super::moving::{Moving, kinetic};
use crate::record::SavedMotion;
use surefoot_mechanics::integrators::{Progress, StepError};
use surefoot_multibody::contact::ContactPoint;
use surefoot_multibody::{
    BodyState, JointConstraint, Reduced, Simulation, System, SystemError, merged,
};

/// Why links are not merged.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum NotMerged {
    /// There are none to merge.
    #[error("no link is fixed to another, or to the world")]
    NothingFixed,
    /// There would be none left.
    #[error("all links are fixed to the world")]
    NothingMoves,
    /// Events name contact points by their order.
    #[error("merged links would change the order of the contact points")]
    Order,
    /// A start without velocities: the first step reports it.
    #[error("the start has no velocities: {0}")]
    Singular(surefoot_mechanics::integrators::StepError),
}

/// A start of merged links.
pub(super) struct MergedStart {
    /// How the bodies carry those of the larger system, if any have been merged.
    pub reduced: Option<Reduced>,
    /// Of joints, held.
    pub torques: Vec<f64>,
    pub simulation: Simulation,
}

/// The motion with links on fixed joints merged, with one another or with the world.
///
/// # Errors
/// A [`SystemError`]; inside, why there is nothing to merge.
pub(super) fn without_fixed_joints(
    whole: &mut Simulation,
    torques: &[f64],
) -> Result<Result<MergedStart, NotMerged>, SystemError> {
    let is_fixed = |joint: &JointConstraint| *joint == JointConstraint::Fixed;
    if !whole.system().links().iter().any(|l| is_fixed(&l.joint.constraint)) {
        return Ok(Err(NotMerged::NothingFixed));
    }
    let reduced = merged(whole.system())?;
    if reduced.system.links().is_empty() {
        return Ok(Err(NotMerged::NothingMoves));
    }
    let carrier = |link: usize| reduced.carrier(link).and_then(|(link, _)| link);
    let sites = whole.system().sites();
    if !sites.is_sorted_by_key(|site| carrier(site.link)) {
        return Ok(Err(NotMerged::Order));
    }
    let states = whole.states();
    let rates = match whole.rates() {
        Ok(rates) => rates,
        Err(error) => return Ok(Err(NotMerged::Singular(error))),
    };
    let (states, rates) = reduced.start(&states, &rates);
    let h = whole.progress().h;
    let mut simulation = Simulation::new(reduced.system.clone(), h, &states, &rates)?;
    let mut carried = vec![0.0; reduced.system.links().len()];
    for (link, torque) in torques.iter().enumerate() {
        // What drives a fixed joint does nothing.
        if !is_fixed(&whole.system().links()[link].joint.constraint)
            && let Some((Some(link), _)) = reduced.carrier(link)
        {
            simulation.set_torque(link, *torque);
            carried[link] = *torque;
        }
    }
    Ok(Ok(MergedStart { reduced: Some(reduced), torques: carried, simulation }))
}

/// A motion of merged links, told as that of all.
pub(super) struct Merged {
    pub whole: System,
    pub reduced: Reduced,
    pub moving: Box<dyn Moving>,
}

impl Moving for Merged {
    fn step(&mut self) -> Result<(), StepError> {
        self.moving.step()
    }

    fn state(&mut self) -> Result<(Vec<f64>, Vec<f64>), StepError> {
        let (states, rates) = self.moving.state()?;
        let bodies = |all: &[f64]| all.as_chunks().0.to_vec();
        let all = self.reduced.expanded(&bodies(&states), &bodies(&rates));
        // Merging loses no body.
        let (states, rates): (Vec<BodyState>, Vec<BodyState>) = all.into_iter().flatten().unzip();
        Ok((states.concat(), rates.concat()))
    }

    fn conserved(&mut self) -> Result<(f64, Vec<f64>, f64), StepError> {
        let (energy, momentum, constraint) = self.moving.conserved()?;
        Ok((energy + self.reduced.still_energy(), momentum, constraint))
    }

    /// Of all bodies: those that are merged with the world do not move.
    fn kinetic(&self, configuration: &[f64], velocity: &[f64]) -> f64 {
        kinetic(&self.whole, configuration, velocity)
    }

    fn keeps_energy(&self) -> bool {
        self.moving.keeps_energy()
    }

    fn in_steps_of(&self, h: f64) -> Option<Box<dyn Moving>> {
        let moving = self.moving.in_steps_of(h)?;
        let (whole, reduced) = (self.whole.clone(), self.reduced.clone());
        Some(Box::new(Self { whole, reduced, moving }))
    }

    fn progress(&self) -> &Progress {
        self.moving.progress()
    }

    fn forecast_s(&mut self) -> Option<f64> {
        self.moving.forecast_s()
    }

    fn unknowns(&self) -> usize {
        self.moving.unknowns()
    }

    fn contacts(&self) -> &[ContactPoint] {
        self.moving.contacts()
    }

    fn contact_forces(&self) -> Vec<[f64; 3]> {
        self.moving.contact_forces()
    }

    fn checkpoint(&self) -> Option<SavedMotion> {
        self.moving.checkpoint()
    }

    fn restore(&mut self, from: &SavedMotion) -> Result<(), SystemError> {
        self.moving.restore(from)
    }
}

//! Stops of a robot's joints, one pair a joint.

use surefoot_multibody::{JointLaw, Stops, System, SystemError};

/// A robot's system with stops as laws of its joints: what they give back is what they took.
pub(super) fn with_stops(system: System, stops: Option<&[Stops]>) -> Result<System, SystemError> {
    let law = |stops| JointLaw { stops: Some(stops), ..JointLaw::default() };
    // Link 0 is the central body.
    let mut numbered = stops.into_iter().flatten().zip(1..);
    numbered.try_fold(system, |system, (s, link)| system.with_law(link, law(*s)))
}

/// Torques of motors and, for plants with explicit steps, of the stops where the joints are.
pub(super) fn motors_and_stops(
    torques: &[f64],
    stops: Option<&[Stops]>,
    positions: &[f64],
) -> Vec<f64> {
    let mut all = torques.to_vec();
    for ((torque, stops), angle) in
        all.iter_mut().zip(stops.into_iter().flatten()).zip(&positions[7..])
    {
        *torque -= stops.stiffness * stops.beyond(*angle);
    }
    all
}

/// Energy held by the stops, J.
pub(super) fn stop_energy(stops: Option<&[Stops]>, positions: &[f64]) -> f64 {
    let pressed = stops.into_iter().flatten().zip(&positions[7..]);
    pressed.map(|(stops, angle)| 0.5 * stops.stiffness * stops.beyond(*angle).powi(2)).sum()
}

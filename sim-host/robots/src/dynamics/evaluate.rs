//! A file of states, from reading to results.

use super::columns::Columns;
use super::states::{Base, Results, States};
use super::{Convention, Dynamics, DynamicsError, Precision};
use crate::description::DescribedBase;
use crate::reduce::reduce;
use crate::robot::{Robot, RobotMotion};
use crate::{BaseChoice, Imported, Options};
use std::path::Path;

/// Dynamics of the robot at `robot` for the states of the file at `states`.
///
/// Joints that follow others are free ones if the file lists them, and eliminated if it does not.
///
/// # Errors
/// The robot or the file of states is refused, or a state has no dynamics.
pub fn evaluate_file(
    robot: &Path,
    states: &Path,
    options: &Options,
    convention: Convention,
    precision: Precision,
) -> Result<Results, DynamicsError> {
    let file = states.display().to_string();
    let text = crate::xml::read_text(states)?;
    let states: States = serde_json::from_str(&text).map_err(|error| DynamicsError::States {
        file: file.clone(),
        message: error.to_string(),
    })?;
    let mut description = crate::read(robot)?;
    let mut options = options.clone();
    // A format that says itself what floats is not overruled.
    if options.base == BaseChoice::Auto && description.base == DescribedBase::Open {
        options.base = match states.base {
            Some(Base::Floating) => BaseChoice::Floating,
            Some(Base::Fixed) => BaseChoice::Fixed,
            None => BaseChoice::Auto,
        };
    }
    for joint in &mut description.joints {
        if states.joints.iter().any(|listed| listed.name == joint.name) {
            joint.mimic = None;
        }
    }
    // Constraints act by forces, which are no part of these algorithms.
    description.constraints.clear();
    let Imported { robot, .. } = reduce(description, &options)?;
    evaluate(&robot, &states, convention, precision).map_err(|error| match error {
        DynamicsError::States { message, .. } => DynamicsError::States { file, message },
        other => other,
    })
}

fn evaluate(
    robot: &Robot,
    states: &States,
    convention: Convention,
    precision: Precision,
) -> Result<Results, DynamicsError> {
    let mut robot = robot.clone();
    robot.gravity = states.gravity.unwrap_or(robot.gravity);
    let columns = Columns::find(&robot, states, convention)?;
    let dynamics = Dynamics::new(&robot, precision)?;
    let results = states
        .states
        .iter()
        .enumerate()
        .map(|(index, state)| columns.evaluate(&dynamics, &robot, convention, index, state))
        .collect::<Result<_, _>>()?;
    let floats = robot.links.iter().any(|link| link.joint.motion == RobotMotion::Floating);
    Ok(Results {
        robot: robot.name.clone(),
        base: if floats { "floating" } else { "fixed" },
        gravity: robot.gravity,
        nq: columns.nq,
        nv: columns.nv,
        mass: robot.mass() + robot.fixed_mass,
        joints: states.joints.clone(),
        states: results,
    })
}

//! What cannot be planned, and what cannot walk.

use super::{FEET, planner, standing};
use nalgebra::{Vector2, Vector3};
use surefoot::walk::{Side, Stature, StatureFault, WalkCommand, WalkFault, WalkInput, WalkMemory};

#[test]
fn a_plan_refuses_what_is_not_finite_and_keeps_its_memory() {
    let planner = planner::<f32>("soles");
    let (_, _, seen) = standing::<f32>("soles");
    let walk = WalkCommand::walk(Vector2::new(0.5, 0.0), 0.0);
    let mut memory = WalkMemory::standing(0.0);
    let before = memory;
    let forces = [200.0; FEET];
    let nan = f32::NAN;
    let mut bad = |change: &dyn Fn(&mut surefoot::balance::ObservedMotion<f32, FEET>), expected| {
        let mut seen = seen;
        change(&mut seen);
        let fault = planner.plan(&mut memory, &seen, &forces, &walk, 0.002).unwrap_err();
        assert_eq!(fault, WalkFault::NotFinite(expected));
    };
    bad(&|seen| seen.velocity.y = nan, WalkInput::CenterOfMass);
    bad(&|seen| seen.angular_momentum.x = f32::INFINITY, WalkInput::CenterOfMass);
    bad(&|seen| seen.central_rotation.m12 = nan, WalkInput::CentralBody);
    bad(&|seen| seen.feet[1].position.z = nan, WalkInput::Foot(1));
    bad(&|seen| seen.feet[0].rotation.m33 = nan, WalkInput::Foot(0));

    let fault = planner.plan(&mut memory, &seen, &[0.0, nan, 0.0, 0.0], &walk, 0.002);
    assert_eq!(fault, Err(WalkFault::NotFinite(WalkInput::Force(1))));
    let nowhere = WalkCommand::walk(Vector2::new(nan, 0.0), 0.0);
    let fault = planner.plan(&mut memory, &seen, &forces, &nowhere, 0.002);
    assert_eq!(fault, Err(WalkFault::NotFinite(WalkInput::Command)));
    for dt in [0.0, -0.002, nan, f32::INFINITY] {
        let fault = planner.plan(&mut memory, &seen, &forces, &walk, dt);
        assert_eq!(fault, Err(WalkFault::Period));
    }
    let mut huge = seen;
    huge.center_of_mass = Vector3::new(3e38, 0.0, 0.7);
    let fault = planner.plan(&mut memory, &huge, &forces, &walk, 0.002);
    assert_eq!(fault, Err(WalkFault::Overflow));
    assert_eq!(memory, before);

    // Of feet that the robot has not, nothing is read.
    let mut other = seen;
    other.feet[3].position.x = nan;
    assert!(planner.plan(&mut memory, &other, &[200.0, 200.0, nan, nan], &walk, 0.002).is_ok());
}

#[test]
fn what_cannot_stand_has_no_stature() {
    let (robot, sides, seen) = standing::<f64>("pairs");
    let without = sides.map(|side| side.filter(|side| *side == Side::Left));
    let fault = Stature::measured(&robot, &without, &seen).unwrap_err();
    assert_eq!(fault, StatureFault::NoFoot(Side::Right));
    let one_left = [Some(Side::Left), Some(Side::Left), Some(Side::Left), Some(Side::Right)];
    let fault = Stature::measured(&robot, &one_left, &seen).unwrap_err();
    assert_eq!(fault, StatureFault::TooManyPoints(Side::Left));
    let massless = surefoot::walk::StandingRobot { mass: 0.0, ..robot };
    let fault = Stature::measured(&massless, &sides, &seen).unwrap_err();
    assert_eq!(fault, StatureFault::NotPositive("mass"));
    let mut hanging = seen;
    hanging.feet.iter_mut().for_each(|foot| foot.leg.z = f64::NAN);
    assert!(Stature::measured(&robot, &sides, &hanging).is_err());
    let mut upside_down = seen;
    upside_down.center_of_mass.z = -0.3;
    let fault = Stature::measured(&robot, &sides, &upside_down).unwrap_err();
    let what = "height of the centre of mass above the feet";
    assert_eq!(fault, StatureFault::NotPositive(what));
    let soleless = surefoot::walk::StandingRobot { sole: Vector2::new(f64::NAN, 0.0), ..robot };
    assert_eq!(Stature::measured(&soleless, &sides, &seen).unwrap_err(), StatureFault::Sole);
}

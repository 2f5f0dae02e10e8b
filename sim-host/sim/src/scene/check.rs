//! What a scene must fulfil before it runs.

use super::check_hardware::check_hardware;
use super::check_robot::{of_file, reach};
use super::differences::check_plant;
use super::rung::check_model;
use super::terrain::check_terrain;
use super::walk::check_walk;
use super::{Distribution, Disturbance, Feet, Scene, SceneError, Workspace};
use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_mechanics::integrators::Method;

/// Most steps a run may have: a day of computing, and surely a slip of the pen beyond.
const MOST_STEPS: f64 = 1e9;
/// Most ticks a run may have: the record keeps 1 kB of each.
const MOST_TICKS: f64 = 1e6;

pub(super) fn check(scene: &Scene) -> Result<(), SceneError> {
    of_file(scene)?;
    numbers(scene)?;
    thrown_block(scene)?;
    timing(scene)?;
    check_hardware(scene)?;
    check_terrain(scene)?;
    check_plant(scene)?;
    check_model(scene)?;
    check_walk(scene)?;
    reach(scene)
}

pub(super) fn wrong(
    scene: &Scene,
    field: &str,
    value: impl std::fmt::Debug,
    expected: impl Into<String>,
) -> SceneError {
    SceneError::Value {
        name: scene.name.clone(),
        line: None,
        field: field.to_owned(),
        value: format!("{value:?}"),
        expected: expected.into(),
    }
}

fn numbers(scene: &Scene) -> Result<(), SceneError> {
    let (set, controller) = (&scene.set_point, &scene.controller);
    let mut finite: Vec<(&str, &[f64])> = vec![
        ("set_point.position_m", &set.position_m),
        ("set_point.orientation", &set.orientation),
    ];
    if let Some(initial) = scene.initial.legs() {
        finite.extend::<[(&str, &[f64]); 5]>([
            ("initial.position_m", &initial.position_m),
            ("initial.turn_axis", &initial.turn_axis),
            ("initial.turn_deg", std::slice::from_ref(&initial.turn_deg)),
            ("initial.left_leg_deg", &initial.left_leg_deg),
            ("initial.right_leg_deg", &initial.right_leg_deg),
        ]);
    }
    for (field, values) in finite {
        if !values.iter().all(|x| x.is_finite()) {
            return Err(wrong(scene, field, values, "finite numbers"));
        }
    }
    let gains: [(&str, &[f64]); 4] = [
        ("controller.position_gain", &controller.position_gain),
        ("controller.velocity_gain", &controller.velocity_gain),
        ("controller.orientation_gain", &controller.orientation_gain),
        ("controller.angular_velocity_gain", &controller.angular_velocity_gain),
    ];
    for (field, values) in gains {
        if !values.iter().all(|x| x.is_finite() && *x > 0.0) {
            return Err(wrong(scene, field, values, "finite gains above zero"));
        }
    }
    if let Some(initial) = scene.initial.legs()
        && Vector3::from(initial.turn_axis).norm() < 1e-9
    {
        return Err(wrong(scene, "initial.turn_axis", initial.turn_axis, "an axis with a length"));
    }
    let norm = Quaternion::from_array(set.orientation).norm_squared().sqrt();
    if (norm - 1.0).abs() > 1e-3 {
        let expected = format!("a unit quaternion, scalar first (its norm is {norm:.4})");
        return Err(wrong(scene, "set_point.orientation", set.orientation, expected));
    }
    for (number, push) in scene.pushes.iter().enumerate() {
        let field = |what: &str| format!("pushes[{number}].{what}");
        if !(push.at_s.is_finite() && push.at_s >= 0.0) {
            return Err(wrong(scene, &field("at_s"), push.at_s, "a time of zero or more"));
        }
        if !(push.duration_s.is_finite() && push.duration_s > 0.0) {
            let expected = "a time above zero";
            return Err(wrong(scene, &field("duration_s"), push.duration_s, expected));
        }
        if !push.force_n.iter().all(|x| x.is_finite()) {
            return Err(wrong(scene, &field("force_n"), push.force_n, "finite numbers"));
        }
    }
    if let Workspace::BigBase(factor) = controller.workspace
        && !(factor.is_finite() && factor >= 1.0)
    {
        let expected = "a finite factor of 1 or more (printed: 1e6)";
        return Err(wrong(scene, "controller.workspace.big-base", factor, expected));
    }
    if controller.disturbance == Disturbance::Observed
        && controller.distribution != Distribution::Limited
    {
        let expected = "\"ignored\", or `distribution = \"limited\"`";
        return Err(wrong(scene, "controller.disturbance", "observed", expected));
    }
    if !(0.0..=1.0).contains(&controller.friction_share) {
        let expected = "a share of 0 to 1";
        return Err(wrong(scene, "controller.friction_share", controller.friction_share, expected));
    }
    if let Some(friction) = controller.friction_nm {
        if !(friction > 0.0 && friction <= 1e5) {
            let expected = "a torque above zero, at most 1e5 N·m";
            return Err(wrong(scene, "controller.friction_nm", friction, expected));
        }
        if controller.friction_share == 0.0 {
            let expected = "none, as `friction_share` is not given";
            return Err(wrong(scene, "controller.friction_nm", friction, expected));
        }
    }
    if controller.friction_share > 0.0
        && controller.friction_nm.is_none()
        && scene.robot().passive.iter().all(|joint| joint.friction == 0.0)
    {
        let expected =
            "none, as neither the robot's file nor `friction_nm` states friction of its joints";
        return Err(wrong(scene, "controller.friction_share", controller.friction_share, expected));
    }
    if controller.distribution == Distribution::Limited && matches!(scene.feet, Feet::Welded {}) {
        let expected = "\"least-norm\" for feet that are held: nothing limits them";
        return Err(wrong(scene, "controller.distribution", "limited", expected));
    }
    if controller.distribution == Distribution::Limited
        && scene.robot().tree.is_six_jointed()
        && let Err(no_sole) = scene.robot().soles()
    {
        let expected = format!("\"least-norm\" for a robot without flat soles: {no_sole}");
        return Err(wrong(scene, "controller.distribution", "limited", expected));
    }
    if let Feet::Floor { floor, .. } = &scene.feet
        && let Some((name, value, expected)) = floor.invalid()
    {
        return Err(wrong(scene, &format!("feet.floor.{name}"), value, expected));
    }
    Ok(())
}

/// A block that can be thrown, and starts outside of what it strikes and above the floor.
fn thrown_block(scene: &Scene) -> Result<(), SceneError> {
    let Some(block) = &scene.block else { return Ok(()) };
    let positive: [(&str, &[f64]); 3] = [
        ("block.mass_kg", &[block.mass_kg]),
        ("block.size_m", &block.size_m),
        ("block.strikes.size_m", &block.strikes.size_m),
    ];
    for (field, values) in positive {
        if !values.iter().all(|x| x.is_finite() && *x > 0.0) {
            return Err(wrong(scene, field, values, "finite numbers above zero"));
        }
    }
    let finite: [(&str, &[f64]); 3] = [
        ("block.position_m", &block.position_m),
        ("block.velocity_mps", &block.velocity_mps),
        ("block.strikes.offset_m", &block.strikes.offset_m),
    ];
    for (field, values) in finite {
        if !values.iter().all(|x| x.is_finite()) {
            return Err(wrong(scene, field, values, "finite numbers"));
        }
    }
    if let Some((name, value, expected)) = block.strikes.surface.invalid() {
        return Err(wrong(scene, &format!("block.strikes.surface.{name}"), value, expected));
    }
    let start = scene.initial.state();
    let [s, x, y, z] = std::array::from_fn(|i| start.positions[3 + i]);
    let to_body = Quaternion::from_array([s, x, y, z]).conjugate();
    let thrown = block.thrown();
    let from_body =
        Vector3::from(block.position_m) - Vector3::from_row_slice(&start.positions[..3]);
    let is_inside = thrown
        .points()
        .iter()
        .any(|point| thrown.around.height(&to_body.rotate(from_body + *point)).0 <= 0.0);
    if is_inside {
        let expected = "a block that starts outside of the box that it strikes";
        return Err(wrong(scene, "block.position_m", block.position_m, expected));
    }
    if matches!(scene.feet, Feet::Floor { .. })
        && thrown.points().iter().any(|point| block.position_m[2] + point.z <= 0.0)
    {
        let expected = "a block that starts above the floor";
        return Err(wrong(scene, "block.position_m", block.position_m, expected));
    }
    Ok(())
}

/// A time, and a step in which it can be simulated.
pub(super) fn duration_and_step(scene: &str, duration: f64, step: f64) -> Result<(), SceneError> {
    let wrong = |field: &str, value: f64, expected: String| SceneError::Value {
        name: scene.to_owned(),
        line: None,
        field: field.to_owned(),
        value: format!("{value:?}"),
        expected,
    };
    if !(duration.is_finite() && duration > 0.0) {
        return Err(wrong("duration_s", duration, "a time above zero, in seconds".into()));
    }
    if !(step.is_finite() && step > 0.0) {
        return Err(wrong("integrator.step_s", step, "a step above zero, in seconds".into()));
    }
    if duration / step > MOST_STEPS {
        let expected = format!("at most {MOST_STEPS:e} steps in {duration} s");
        return Err(wrong("integrator.step_s", step, expected));
    }
    if duration / step < 0.5 {
        return Err(wrong("duration_s", duration, format!("a step of {step} s at least")));
    }
    Ok(())
}

fn timing(scene: &Scene) -> Result<(), SceneError> {
    let step = scene.integrator.step_s;
    duration_and_step(&scene.name, scene.duration_s, step)?;
    let method = scene.integrator.name;
    if !matches!(method, Method::Variational | Method::SemiImplicitEuler) {
        let expected =
            format!("{} or {} for a robot", Method::Variational, Method::SemiImplicitEuler);
        return Err(wrong(scene, "integrator.name", method, expected));
    }
    let rate = scene.controller.rate_hz;
    let steps = 1.0 / (rate * step);
    if !(rate.is_finite() && rate > 0.0) || steps < 1.0 - 1e-9 {
        let expected = format!("a rate above zero and at most one tick a step, {} Hz", 1.0 / step);
        return Err(wrong(scene, "controller.rate_hz", rate, expected));
    }
    let ticks = scene.duration_s * rate;
    if ticks < 0.5 {
        let expected = format!("a tick of {} s at least", 1.0 / rate);
        return Err(wrong(scene, "duration_s", scene.duration_s, expected));
    }
    if ticks > MOST_TICKS {
        let expected = format!("at most {MOST_TICKS:e} ticks in {} s", scene.duration_s);
        return Err(wrong(scene, "controller.rate_hz", rate, expected));
    }
    if (steps - steps.round()).abs() > 1e-6 * steps {
        let expected =
            format!("a whole number of steps of {step} s between ticks (it is {steps:.3})");
        return Err(wrong(scene, "controller.rate_hz", rate, expected));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::builtin::BUILT_IN;
    use super::super::parse;

    /// The same of a thrown block.
    #[test]
    fn every_bad_block_is_refused_with_its_place() {
        let text = BUILT_IN.iter().find(|scene| scene.name == "experiment-2").expect("there").text;
        for (from, to, words) in [
            ("mass_kg = 1.8", "mass_kg = 0.0", ["block.mass_kg", "above zero"]),
            ("size_m = [0.08, 0.08", "size_m = [nan, 0.08", ["block.size_m[0] = nan", "finite"]),
            ("[-4.5, 0.0, 0.2]", "[inf, 0.0, 0.2]", ["block.velocity_mps", "finite"]),
            ("[0.50, 0.10, 1.20]", "[0.10, 0.10, 1.20]", ["block.position_m", "outside"]),
            ("[0.50, 0.10, 1.20]", "[0.50, 0.10, 0.02]", ["block.position_m", "above the floor"]),
            ("[0.50, 0.10, 1.20]", "[0.50, 0.10]", ["position_m", "3"]),
            ("= 10000.0", "= -1.0", ["block.strikes.surface", "above zero"]),
            ("mass_kg = 1.8", "mass_kg = 1.8\nspin = 1", ["unknown field", "`spin`"]),
        ] {
            assert!(text.contains(from), "{from}");
            let error = parse("test", &text.replacen(from, to, 1)).expect_err(to).to_string();
            for word in words {
                assert!(error.contains(word), "{to}: {error}");
            }
        }
    }

    /// One changed line of a good scene, and words that the error must have.
    #[test]
    fn every_bad_value_is_refused_with_its_place() {
        let text = BUILT_IN[0].text;
        for (from, to, words) in [
            ("step_s = 2e-3", "step_s = -1e-3", ["integrator.step_s", "above zero"]),
            ("step_s = 2e-3", "step_s = nan", ["test:8: integrator.step_s = nan", "finite"]),
            ("step_s = 2e-3", "step_s = 1e-14", ["integrator.step_s", "at most"]),
            ("duration_s = 3.0", "duration_s = inf", ["duration_s", "finite"]),
            ("rate_hz = 500.0", "rate_hz = 0.0", ["controller.rate_hz", "above zero"]),
            ("rate_hz = 500.0", "rate_hz = 30000.0", ["controller.rate_hz", "one tick a step"]),
            ("rate_hz = 500.0", "rate_hz = 333.0", ["controller.rate_hz", "whole number"]),
            ("turn_deg = 5.0", "turn_deg = nan", ["initial.turn_deg", "finite"]),
            ("turn_axis = [0.0, -1.0, 0.0]", "turn_axis = [0, 0, 0]", ["turn_axis", "length"]),
            (
                "position_m = [-0.01, 0.0, 1.10]",
                "position_m = [-0.01, 0.0, 1.3]",
                ["set_point", "reaches"],
            ),
            (
                "[0.99144486, -0.13052619, 0.0, 0.0]",
                "[1.0, 1.0, 0.0, 0.0]",
                ["orientation", "unit"],
            ),
            ("position_gain = [50.0", "position_gain = [-50.0", ["position_gain", "above zero"]),
            (
                "dynamic_friction = 0.3",
                "dynamic_friction = -0.3",
                ["dynamic_friction", "zero or more"],
            ),
            ("workspace = \"fixed-foot\"", "workspace = { big-base = 0.0 }", ["big-base", "1e6"]),
            ("outline = \"A\"", "outline = \"B\"", ["expected one of", "`M`"]),
            ("rate_hz = 500.0", "rate_hz = 500.0\nspeed = 3", ["unknown field", "`speed`"]),
            ("duration_s = 3.0", "duration_s = \"long\"", ["test:4: duration_s", "f64"]),
        ] {
            assert!(text.contains(from), "{from}");
            let error = parse("test", &text.replacen(from, to, 1)).expect_err(to).to_string();
            for word in words {
                assert!(error.contains(word), "{to}: {error}");
            }
        }
    }
}

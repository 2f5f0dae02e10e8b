//! What is said of a run that fails: from trials, never from a guess.

use surefoot_mechanics::integrators::Method;
use surefoot_sim::mechanism::{Cause, MechanismRun, run};
use surefoot_sim::scene::{AnyScene, MechanismScene, parse};

fn scene(text: &str) -> MechanismScene {
    let AnyScene::Mechanism(scene) = parse("test", text).expect("a scene") else { unreachable!() };
    scene
}

fn played(scene: &MechanismScene) -> MechanismRun {
    run(scene, &mut |_| {}).expect("a start")
}

/// A body that spins at 2000 rad/s in steps of 1 ms: beyond the fold of (2.51). What is advised is shorter than what was
/// taken, and completes the run.
#[test]
fn a_step_that_is_advised_is_shorter_and_works() {
    let mut fast = scene(
        r#"
description = "fast"
duration_s = 0.2
[integrator]
name = "variational"
step_s = 1e-3
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
[[mechanism.bodies]]
name = "body"
mass_kg = 1.0
inertia_kg_m2 = [0.1, 0.12, 0.15]
center_m = [0.0, 0.0, 0.0]
joint = { kind = "floating", velocity_m_s = [0.1, 0.0, 0.0], angular_velocity_rad_s = [2000.0, 100.0, 30.0] }
"#,
    );
    let run = played(&fast);
    assert!(run.failure.is_some());
    let cause = run.cause.expect("trials");
    let Cause::StepTooLong { step_s } = cause else { panic!("{cause:?}") };
    assert!(step_s < fast.integrator.step_s);
    fast.integrator.step_s = step_s;
    assert_eq!(played(&fast).failure, None, "{step_s}");
}

/// A bob of 1 kg on a massless pole over a cart of a milligram: the pole swings round within a nanosecond where the bob
/// is right below the cart. A method is named only where it completes the run and keeps its energy.
#[test]
fn a_method_that_is_advised_completes_the_run() {
    let text = |method: Method| {
        format!(
            r#"
description = "a light cart"
duration_s = 0.6
[integrator]
name = "{method}"
step_s = 1e-4
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
[[mechanism.bodies]]
name = "cart"
mass_kg = 1e-6
inertia_kg_m2 = [1e-9, 1e-9, 1e-9]
center_m = [0.0, 0.0, 0.0]
joint = {{ kind = "prismatic", axis = [1.0, 0.0, 0.0] }}
[[mechanism.bodies]]
name = "bob"
inboard = "cart"
mass_kg = 1.0
inertia_kg_m2 = [1e-12, 1e-12, 1e-12]
center_m = [1.0, 0.0, 0.0]
joint = {{ kind = "revolute", point_m = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0] }}
"#
        )
    };
    let run = played(&scene(&text(Method::Yoshida4)));
    let failure = run.failure.expect("too fast a swing");
    assert!((failure.time_s - 0.4515).abs() < 1e-3, "{failure}");
    match run.cause.expect("trials") {
        Cause::NotTheStep { method: Some(method), .. } => {
            let other = played(&scene(&text(method)));
            assert_eq!(other.failure, None, "{method}");
            assert!(!other.has_lost_energy(), "{method}");
        }
        Cause::StepTooLong { step_s } | Cause::StepTooLongHere { step_s, .. } => {
            assert!(step_s < 1e-4, "{step_s}");
        }
        cause => panic!("{cause:?}"),
    }
}

/// Energy that nothing takes and that goes nevertheless is reported.
#[test]
fn lost_energy_is_seen() {
    let text = |step: f64| {
        format!(
            r#"
description = "a stiff spring under a method that damps it"
duration_s = 2.0
[integrator]
name = "runge-kutta-4"
step_s = {step}
[mechanism]
kind = "multibody"
gravity_m_s2 = 0.0
[[mechanism.bodies]]
name = "wheel"
mass_kg = 1.0
inertia_kg_m2 = [0.1, 0.1, 0.1]
center_m = [0.0, 0.0, 0.0]
joint = {{ kind = "revolute", point_m = [0.0, 0.0, 0.0], axis = [0.0, 1.0, 0.0], rate_rad_s = 10.0 }}
law = {{ stiffness = 1000.0 }}
"#
        )
    };
    let (coarse, fine) = (played(&scene(&text(2e-2))), played(&scene(&text(1e-4))));
    assert_eq!((coarse.failure, fine.failure), (None, None));
    assert!(coarse.has_lost_energy() && !fine.has_lost_energy());
}

//! Leaps: what is closed in them, and what a plan asks for on the way through them.

use super::{FEET, planner, standing};
use nalgebra::{Vector2, Vector3};
use surefoot::balance::{AngularTask, FootTask, LinearTask};
use surefoot::walk::{
    JumpOrder, JumpStage, Phase, RunPhase, Side, WalkCommand, WalkFault, WalkInput, WalkMemory,
    take_off_speed, time_aloft,
};

#[test]
fn flights_are_ballistic() {
    let g = 9.81_f64;
    for rise in [0.05_f64, 0.25, 0.45] {
        let v = take_off_speed(rise, g);
        // Up and down again, by the sum of both halves: 2 v/g.
        assert!((time_aloft(0.0, v, g) - 2.0 * (2.0 * rise / g).sqrt()).abs() < 1e-15);
        for above in [-0.02, 0.0, 0.1] {
            let t = time_aloft(above, v, g);
            let z = above + v * t - 0.5 * g * t * t;
            assert!(z.abs() < 1e-15, "{z:e}");
            assert!(v - g * t < 0.0);
        }
    }
    // What never comes as high as its landing lands at its apex.
    assert_eq!(time_aloft(-1.0, 1.0, g), 1.0 / g);
    assert_eq!(take_off_speed(-0.1, g), 0.0);
}

/// A point mass on legs without mass under the plan's own vertical accelerations, the ground felt as soon as it is reached:
/// apexes above take-off, m, and the stages in order.
fn jumped(order: JumpOrder<f64>) -> (Vec<f64>, Vec<&'static str>) {
    let planner = planner::<f64>("soles");
    let (_, _, mut seen) = standing::<f64>("soles");
    let mut memory = WalkMemory::standing(0.0);
    let command = WalkCommand { jump: Some(order), ..WalkCommand::stand() };
    let (dt, weight) = (1e-3, planner.stature.robot.mass * 9.81);
    let (mut apexes, mut names, mut from) = (Vec::new(), Vec::new(), 0.0);
    for _ in 0..12_000 {
        let flies = matches!(
            memory.phase,
            Phase::Jump(jump) if matches!(jump.stage, JumpStage::Flight { .. })
        );
        let lowest = planner.gait.height * 0.97;
        let touches = !flies || (seen.velocity.z < 0.0 && seen.center_of_mass.z < lowest);
        let force = if touches { weight / 2.0 } else { 0.0 };
        let forces = [force, force, 0.0, 0.0];
        let task = planner.plan(&mut memory, &seen, &forces, &command, dt).expect("a plan");
        let vertical = match task.motion.linear {
            LinearTask::CenterOfMass(a) => a.z,
            LinearTask::CenterOfPressure { vertical, .. } => vertical,
            LinearTask::Free => -9.81,
        };
        let name = match memory.phase {
            Phase::Standing => "stand",
            Phase::Jump(jump) => match jump.stage {
                JumpStage::Crouch => "crouch",
                JumpStage::Push => "push",
                JumpStage::Flight { .. } => "flight",
                JumpStage::Landing => "land",
            },
            _ => "step",
        };
        let z = seen.center_of_mass.z;
        if names.last() != Some(&name) {
            names.push(name);
            if name == "flight" {
                from = z;
                apexes.push(0.0);
                // It does not say what the ground is to press.
                assert_eq!(task.motion.linear, LinearTask::Free);
                assert!(task.motion.feet[..2].iter().all(|f| matches!(f, FootTask::Swing { .. })));
            }
            if name == "push" {
                assert!(matches!(task.motion.angular, AngularTask::Momentum { .. }));
            }
        }
        if name == "flight" {
            let apex = apexes.last_mut().expect("a flight");
            *apex = (z - from).max(*apex);
        }
        seen.velocity.z += vertical * dt;
        seen.center_of_mass.z += seen.velocity.z * dt;
        // Legs without mass stay on the ground, or hang below.
        let lifted = (seen.center_of_mass.z - planner.gait.height * 1.05).max(0.0);
        for foot in &mut seen.feet[..2] {
            foot.position.z = lifted;
            foot.velocity = Vector3::zeros();
        }
    }
    (apexes, names)
}

#[test]
fn a_point_mass_rises_as_high_as_it_is_told() {
    for rise in [0.1, 0.25, 0.4] {
        let (apexes, names) = jumped(JumpOrder { rise, hops: 1, number: 1 });
        assert_eq!(names, ["crouch", "push", "flight", "land", "stand"]);
        // By up to a tick of the push more or less. Measured: 5 mm at most.
        assert!((apexes[0] - rise).abs() < 0.015, "{apexes:?} for {rise}");
    }
    let (apexes, names) = jumped(JumpOrder { rise: 0.2, hops: 5, number: 9 });
    println!("{names:?}");
    assert_eq!(apexes.len(), 5, "{names:?}");
    assert_eq!(names.last(), Some(&"stand"));
}

#[test]
fn an_order_to_jump_is_followed_once() {
    let planner = planner::<f32>("soles");
    let (_, _, seen) = standing::<f32>("soles");
    let mut memory = WalkMemory::standing(0.0);
    memory.jumped = Some(4);
    let forces = [300.0; FEET];
    planner.plan(&mut memory, &seen, &forces, &WalkCommand::jump(0.2, 4), 0.002).expect("a plan");
    assert_eq!(memory.phase, Phase::Standing);
    planner.plan(&mut memory, &seen, &forces, &WalkCommand::jump(0.2, 5), 0.002).expect("a plan");
    assert!(matches!(memory.phase, Phase::Jump(_)));
    assert!(planner.leeway(&memory).sinks > 0.0 && !planner.leeway(&memory).leaps);
    let nan = planner.plan(&mut memory, &seen, &forces, &WalkCommand::jump(f32::NAN, 6), 0.002);
    assert_eq!(nan, Err(WalkFault::NotFinite(WalkInput::Command)));
}

#[test]
fn a_run_flies_lands_and_goes_on_or_walks() {
    let planner = planner::<f64>("soles");
    let (_, _, mut seen) = standing::<f64>("soles");
    let mut memory = WalkMemory::standing(0.0);
    let ran = RunPhase { side: Side::Left, flies: false, elapsed: 0.0, ground: 0.0 };
    memory.phase = Phase::Run(ran);
    let run = WalkCommand::run(Vector2::new(1.0, 0.0), 0.0);
    let none = [0.0; FEET];
    // A stance ends by time, whatever is felt.
    let mut ticks = 0;
    while !planner.leeway(&memory).leaps {
        planner.plan(&mut memory, &seen, &none, &run, 0.002).expect("a plan");
        ticks += 1;
        assert!(ticks < 500);
    }
    let stance = 0.9 / planner.gait.omega;
    assert!((f64::from(ticks) * 0.002 - stance).abs() < 0.003);
    assert!(matches!(memory.phase, Phase::Run(RunPhase { side: Side::Right, flies: true, .. })));
    seen.velocity.z = -0.5;
    let mut landed = none;
    landed[1] = 400.0;
    for _ in 0..15 {
        planner.plan(&mut memory, &seen, &none, &run, 0.002).expect("a plan");
    }
    let mut other = memory;
    planner.plan(&mut memory, &seen, &landed, &run, 0.002).expect("a plan");
    assert!(matches!(memory.phase, Phase::Run(RunPhase { side: Side::Right, flies: false, .. })));
    // Told to stand, it lands in a walk's step.
    planner.plan(&mut other, &seen, &landed, &WalkCommand::stand(), 0.002).expect("a plan");
    assert!(matches!(other.phase, Phase::Single { stance: Side::Right, .. }));
    // A flight that does not end is no leap any more.
    for _ in 0..300 {
        planner.plan(&mut memory, &seen, &none, &run, 0.002).expect("a plan");
        if let Phase::Run(RunPhase { flies: true, .. }) = memory.phase
            && !planner.leeway(&memory).leaps
        {
            return;
        }
    }
    panic!("it leaps for ever");
}

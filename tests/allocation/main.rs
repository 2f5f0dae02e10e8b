//! No step of the multibody simulator allocates: in flight, on both feet, welded, or closed. Nor do sensors and
//! motors.
//!
//! A binary of its own, as the allocator is the program's, and with one test, as threads share it.

use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use surefoot_multibody::Simulation;
use surefoot_sim::closed_loop::{Motors, Sensors};
use surefoot_sim::mechanism::{MechanismModel, start_model};
use surefoot_sim::plant::{Additions, Plant, Variational};
use surefoot_sim::scene::{Acting, AnyScene, Block, Feet, Mechanism, Sensing, open};

#[global_allocator]
static COUNTING: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

fn simulation(scene: &str, h: f64) -> Simulation {
    let AnyScene::Mechanism(scene) = open(scene).expect("built in") else { unreachable!() };
    match scene.mechanism {
        Mechanism::Multibody(bodies) => bodies.start(h).expect("a start"),
        Mechanism::Biped(flight) => flight.start(h).expect("a start"),
        _ => unreachable!("bodies"),
    }
}

fn count(name: &str, mut step: impl FnMut()) {
    let region = Region::new(COUNTING);
    for _ in 0..300 {
        step();
    }
    let change = region.change();
    let made = change.allocations + change.reallocations;
    assert_eq!(made, 0, "{name} allocates: {change:?}");
}

#[test]
fn no_step_allocates() {
    // The counter counts.
    let region = Region::new(COUNTING);
    std::hint::black_box(vec![0_u8; 100]);
    assert_eq!(region.change().allocations, 1);

    for scene in ["biped-flight", "box-drop", "four-bar"] {
        let mut simulation = simulation(scene, 1e-3);
        count(scene, || simulation.step().expect("a step"));
        count("rates", || {
            simulation.column_rates().expect("rates");
        });
    }
    for (scene, model) in
        [("hinged-chain", MechanismModel::Planar), ("box-drop", MechanismModel::SingleBody)]
    {
        let AnyScene::Mechanism(of) = open(scene).expect("built in") else { unreachable!() };
        let mut smaller = start_model(&of, Some(model)).expect("a start").moving;
        count(scene, || smaller.step().expect("a step"));
    }
    // Steps that have to be made in shorter ones.
    let mut large = simulation("box-drop", 2e-2);
    count("large steps", || {
        let _ = large.step();
    });
    for name in ["experiment-1", "experiment-1-welded", "experiment-2", "experiment-2-welded"] {
        let AnyScene::Robot(scene) = open(name).expect("built in") else { unreachable!() };
        let (robot, start) = (scene.robot(), scene.initial.state());
        let additions = Additions {
            model: scene.rung().model,
            block: scene.block.as_ref().map(Block::thrown),
            ..Additions::default()
        };
        let noisy = Sensing {
            encoder_counts: 4096,
            gyroscope_noise: 1e-4,
            backlash_deg: 0.1,
            imu_tilt_deg: [0.1, 0.0, 0.0],
            ..Sensing::default()
        };
        let mut sensors = Sensors::new(&noisy, 1e-3, &robot.columns);
        let weak = Acting {
            delay_s: 3.5e-3,
            torque_limits_nm: Some([50.0; 6]),
            lag_s: 1e-3,
            ..Acting::default()
        };
        let mut motors = Motors::new(&weak, 1e-3, 1, start.joints());
        count("sensors and motors", || {
            let seen = sensors.read(&start);
            let torques: [f64; 12] = std::array::from_fn(|i| 100.0 * seen.positions[7 + i]);
            motors.command(&torques, 0.0);
            std::hint::black_box(motors.over_step(0));
            motors.advance(0);
        });
        let mut plant = match &scene.feet {
            Feet::Floor { floor, .. } => {
                Variational::on_floor(&robot, &start, 1e-3, *floor, &additions)
            }
            Feet::Welded {} => Variational::welded(&robot, &start, 1e-3, &additions),
        }
        .expect("a plant");
        // Enough to hold the knees for a while.
        let mut torques = [0.0; 12];
        (torques[3], torques[9]) = (100.0, 100.0);
        let (mut state, mut contacts) = (start.clone(), plant.contacts().unwrap_or_default());
        plant.read_state(&mut state).expect("a state");
        count(name, || {
            plant.step(1e-3, &torques, None).expect("a step");
            plant.read_state(&mut state).expect("a state");
            plant.read_contacts(&mut contacts);
        });
    }
}

//! Models for other simulators: what is written, and what is refused. `chart work-precision --peers` runs them, and
//! shows that MuJoCo's error against our reference falls with its step.

use surefoot_host::precision::{NoModel, mujoco_model};
use surefoot_sim::mechanism::start_bodies;
use surefoot_sim::scene::{AnyScene, open};
use surefoot_tests::motions::{biped_in_flight, biped_on_feet};

/// A model has all bodies, each in the one it hangs from, and the whole mass; a start has all coordinates.
#[test]
fn a_tree_is_written_whole() {
    for start in [biped_in_flight(), biped_on_feet()] {
        let model = mujoco_model(&mut start.simulation(1e-3)).expect("hinges and a free body");
        assert_eq!((model.qpos.len(), model.qvel.len()), (19, 18));
        assert_eq!(model.xml.matches("<body ").count(), 13);
        assert_eq!(model.xml.matches("</body>").count(), 13);
        let springs = model.xml.matches("stiffness=").count();
        assert_eq!(springs, start.system.laws().len());
        let masses = model.xml.split("mass=\"").skip(1).map(|rest| {
            rest.split('"').next().and_then(|mass| mass.parse::<f64>().ok()).expect("a number")
        });
        let mass: f64 = masses.sum();
        assert!((mass - 74.548).abs() < 1e-3, "{mass}");
        // The angular velocity is in the body's own axes: of the same size as in the world's.
        let norm = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let rates = start.simulation(1e-3).column_rates().expect("regular").to_vec();
        assert!((norm(&model.qvel[3..6]) - norm(&rates[3..6])).abs() < 1e-12);
        assert_eq!(model.qvel[..3], rates[..3]);
    }
}

#[test]
fn what_is_not_written_is_refused() {
    let AnyScene::Mechanism(scene) = open("four-bar").expect("built in") else {
        panic!("it is a robot")
    };
    let mut simulation = start_bodies(&scene.mechanism, 1e-3).expect("a motion");
    assert_eq!(mujoco_model(&mut simulation), Err(NoModel::Unwritten));
    let spherical = surefoot_multibody::Chain {
        links: 2,
        mass: 1.0,
        length: 0.5,
        radius: 0.05,
        joint: surefoot_multibody::ChainJoint::Spherical,
        floats: false,
        gravity: 9.81,
    };
    let (states, rates) = (spherical.bent(0.1), [[0.0; 7]; 2]);
    let system = spherical.system().expect("a system");
    let mut simulation =
        surefoot_multibody::Simulation::new(system, 1e-3, &states, &rates).expect("a start");
    assert_eq!(mujoco_model(&mut simulation), Err(NoModel::Joint { link: 0 }));
}

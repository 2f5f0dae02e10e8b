//! Step against the floor's stiffness: the box on the variational plant, the standing biped on both.

use super::axis::Axis;
use super::column::{Map, Stack};
use crate::stability::{Problem, TreeProblemError, motion_of, standing};
use surefoot_mechanics::integrators::Method;
use surefoot_multibody::contact::Floor;
use surefoot_sim::scene::{AnyScene, Feet, Mechanism, load, open};

/// Range of the stiffness, N/m a point; rubber has 75 000.
const STIFFNESS: [f64; 2] = [3e3, 3e6];
/// Simulated time, s.
const BOX_S: f64 = 1.5;
/// Simulated time, s: Experiment 1 is at its set point within 1.5 s.
const BIPED_S: f64 = 2.0;

fn stiffness(cells: usize) -> Axis {
    Axis::logarithmic("stiffness of the floor, a contact point", "kN/m", STIFFNESS)
        .shown(1e-3)
        .cells(cells)
}

fn step(range_s: [f64; 2], cells: usize) -> Axis {
    Axis::logarithmic("step", "ms", range_s).shown(1e3).cells(cells)
}

/// Rubber of another stiffness. Damping goes with its root, so that the damping ratio stays.
fn floor_like(floor: &Floor, stiffness: f64) -> Floor {
    let scale = stiffness / floor.normal_stiffness;
    Floor {
        normal_stiffness: floor.normal_stiffness * scale,
        normal_damping: floor.normal_damping * scale.sqrt(),
        tangential_stiffness: floor.tangential_stiffness * scale,
        tangential_damping: floor.tangential_damping * scale.sqrt(),
        ..*floor
    }
}

/// A problem's steps under one method.
pub(super) fn steps_of(problem: Problem, method: Method) -> Stack {
    Stack {
        foretold: problem.forecast(method).unwrap_or_default().into(),
        attempt: Box::new(move |h| {
            // Maps are made of methods that go with their problems.
            let verdict = problem.attempt(method, h);
            verdict.map_or(super::Outcome::Works, Into::into)
        }),
    }
}

/// The maps of this module.
///
/// # Errors
/// Never for the scenes as shipped.
pub fn floor_maps(cells: usize) -> Result<Vec<Map>, TreeProblemError> {
    let dropped = match open("box-drop")? {
        AnyScene::Mechanism(scene) => scene,
        AnyScene::Robot(scene) => return Err(TreeProblemError::Robot { name: scene.name }),
    };
    // Whether it starts is asked here, once; another floor changes nothing about that.
    let motion = motion_of(&dropped, BOX_S)?;
    let floor = match &dropped.mechanism {
        Mechanism::Multibody(bodies) => bodies.floor.unwrap_or(Floor::RUBBER),
        _ => Floor::RUBBER,
    };
    let biped = load("experiment-1")?;
    let of_biped = |name, title: &str, method, range_s| {
        let biped = biped.clone();
        Map {
            name,
            title: title.to_owned(),
            note: "A cell works if Experiment 1 is at its set point after 2 s. Steps are shortened so that the \
                   control period of 2 ms has a whole number of them; longer ones are the period.",
            x: stiffness(cells),
            y: step(range_s, cells),
            stack: Box::new(move |stiffness| {
                let mut scene = biped.clone();
                scene.duration_s = BIPED_S;
                if let Feet::Floor { floor, .. } = &mut scene.feet {
                    *floor = floor_like(floor, stiffness);
                }
                steps_of(standing(scene, BIPED_S), method)
            }),
        }
    };
    Ok(vec![
        Map {
            name: "step-stiffness-box",
            title: "A thrown box on floors from soft to hard, variational method".to_owned(),
            note: "A cell works if the box of §5.3 is followed for 1.5 s without a failed step, and gains no \
                   energy.",
            x: stiffness(cells),
            y: step([1e-3, 0.3], cells),
            stack: Box::new(move |stiffness| {
                match motion.clone().on_floor(floor_like(&floor, stiffness)) {
                    Ok(motion) => steps_of(motion.problem("box", ""), Method::Variational),
                    Err(_) => Stack::not_finite(),
                }
            }),
        },
        of_biped(
            "step-stiffness-biped-baseline",
            "The standing biped, baseline plant (semi-implicit Euler)",
            Method::SemiImplicitEuler,
            [2.5e-5, 2.5e-3],
        ),
        of_biped(
            "step-stiffness-biped-variational",
            "The standing biped, variational plant",
            Method::Variational,
            [1e-3, 0.1],
        ),
    ])
}

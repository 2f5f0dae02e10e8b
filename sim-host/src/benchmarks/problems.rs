//! The problems: what is measured, and what is good enough.

use surefoot_sim::scene::{AnyScene, MechanismScene, SceneError, parse};

/// What an error is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Largest distance of a mass centre, m.
    Position,
    /// Largest distance of a mass centre, m, or angle of a body, rad.
    Pose,
    /// Largest angle of a body, rad.
    Attitude,
    /// Of energy, angular momentum and position the largest error at all times, over that of the best of four engines.
    OverEngines,
    /// Largest error of roll and steer (rad), roll rate (rad/s) and forward speed (m/s).
    Bicycle,
}

impl Measure {
    /// For people.
    pub fn words(self) -> &'static str {
        match self {
            Self::Position => "largest distance of a mass centre, m",
            Self::Pose => "largest distance of a mass centre (m) or angle (rad)",
            Self::Attitude => "largest angle, rad",
            Self::OverEngines => "energy, momentum and position, over the best of four engines",
            Self::Bicycle => "roll and steer (rad), roll rate (rad/s), forward speed (m/s)",
        }
    }
}

/// A problem.
#[derive(Clone, Copy, Debug)]
pub struct Benchmark {
    /// On the command line and in files.
    pub name: &'static str,
    /// Its reference.
    pub reference: &'static str,
    /// The scene's file; none where a scene cannot say it, and why.
    pub scene: Result<&'static str, &'static str>,
    /// What its error is.
    pub measure: Measure,
    /// What is good enough: the benchmark's own threshold (1e-3 for IFToMM's group A), or the digits that are known.
    pub bar: f64,
}

macro_rules! said {
    ($name:literal, $measure:ident, $bar:literal) => {
        said!($name, $name, $measure, $bar)
    };
    ($name:literal, $scene:literal, $measure:ident, $bar:literal) => {
        Benchmark {
            name: $name,
            reference: $scene,
            scene: Ok(include_str!(concat!("../../benchmarks/scenes/", $scene, ".toml"))),
            measure: Measure::$measure,
            bar: $bar,
        }
    };
}

const fn unsaid(name: &'static str, why: &'static str, bar: f64) -> Benchmark {
    Benchmark { name, reference: name, scene: Err(why), measure: Measure::Position, bar }
}

const ALL: [Benchmark; 21] = [
    said!("a01-pendulum", Position, 1e-3),
    said!("a02-windows-2", Position, 1e-3),
    said!("a02-windows-40", Position, 1e-3),
    said!("a03-andrews", Pose, 1e-9),
    said!("a03-iftomm", Position, 1e-3),
    said!("a04-bricard", Position, 1e-3),
    said!("a05-governor", Position, 1e-3),
    said!("bicycle-m1", Bicycle, 1e-6),
    said!("bicycle-m2", Bicycle, 1e-6),
    said!("bicycle-m3", Bicycle, 1e-6),
    said!("slider-crank", Position, 1e-6),
    said!("light-cart-pole", Position, 1e-6),
    said!("box-simple", Pose, 1e-6),
    said!("box-complex", OverEngines, 1e-2),
    said!("box-attitude", "box-complex", Attitude, 1e-3),
    said!("dzhanibekov", Pose, 1e-6),
    said!("heavy-top", Pose, 1e-5),
    said!("baby-boot", Pose, 1e-7),
    unsaid("simbenchmark-rolling", "boxes on balls: scenes have no contact between bodies", 1e-3),
    unsaid(
        "simbenchmark-bouncing",
        "balls that bounce: scenes have no restitution as a number",
        1e-3,
    ),
    unsaid("simbenchmark-666", "216 balls: scenes have no contact between bodies", 1e-3),
];

/// All of them, in the order of the table.
pub fn all() -> &'static [Benchmark] {
    &ALL
}

/// A problem's scene.
///
/// # Errors
/// Never for those that can be said: a test parses them all. `None` for the others.
pub fn scene(of: &Benchmark) -> Option<Result<MechanismScene, SceneError>> {
    let text = of.scene.ok()?;
    Some(parse(of.name, text).and_then(|scene| match scene {
        AnyScene::Mechanism(scene) => Ok(scene),
        AnyScene::Robot(scene) => Err(SceneError::Value {
            name: scene.name.clone(),
            line: None,
            field: "mechanism".to_owned(),
            value: String::new(),
            expected: "a mechanism".to_owned(),
        }),
    }))
}

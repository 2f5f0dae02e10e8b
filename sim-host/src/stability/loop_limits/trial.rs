//! One run of a scene with one quantity changed, judged.

use super::criterion::Criterion;
use super::manner::{Ending, Manner};
use super::quantity::Quantity;
use serde::{Deserialize, Serialize};
use surefoot::balance::{Fault, StopReason};
use surefoot_sim::closed_loop::{
    Commanded, ControlFailure, Controller, Run, Scalar, bare_controller, controller, run,
};
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::{Feet, Outline, Scene, SceneError};

/// What the feet are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Footing {
    /// Soles of this outline on the scene's floor.
    Sole(Outline),
    /// Held where they start.
    Welded,
}

impl Footing {
    /// Those that a scene is tried with: outlines A and M, or welds where it has no floor.
    pub fn of(scene: &Scene) -> &'static [Self] {
        match scene.feet {
            Feet::Floor { .. } => &[Self::Sole(Outline::A), Self::Sole(Outline::M)],
            Feet::Welded {} => &[Self::Welded],
        }
    }

    /// For people.
    pub fn words(self) -> String {
        match self {
            Self::Sole(outline) => format!("sole {outline:?}"),
            Self::Welded => "welded".to_owned(),
        }
    }

    fn set(self, scene: &mut Scene) {
        if let (Self::Sole(sole), Feet::Floor { outline, .. }) = (self, &mut scene.feet) {
            *outline = Some(sole);
        }
    }
}

/// Which loop is tried.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Loop {
    /// The controller under its supervisor, as on the target.
    #[default]
    Supervised,
    /// The controller alone.
    Bare,
}

impl Loop {
    /// In the order of the table.
    pub const BOTH: [Self; 2] = [Self::Supervised, Self::Bare];
}

/// A scene whose limits are sought, in one quantity and on one footing.
#[derive(Clone, Copy, Debug)]
pub struct Trial<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// What is changed.
    pub quantity: Quantity,
    /// On which feet.
    pub footing: Footing,
    /// In which loop.
    pub control: Loop,
    /// What works.
    pub criterion: Criterion,
}

impl Trial<'_> {
    /// The scene with its quantity at `value`, in steps of at most `longest_step_s` of which a control
    /// period has a whole number.
    pub fn scene_at(&self, value: f64, longest_step_s: f64) -> Scene {
        let mut scene = self.scene.clone();
        self.footing.set(&mut scene);
        self.quantity.set(&mut scene, value);
        scene.duration_s = scene.duration_s.max(self.criterion.least_duration_s);
        let period = 1.0 / scene.controller.rate_hz;
        // A ratio that is whole but for round-off is whole.
        scene.integrator.step_s = period / (period / longest_step_s - 1e-9).ceil().max(1.0);
        scene
    }

    /// How the loop fails at `value`; `None` if it works.
    ///
    /// # Errors
    /// A [`SceneError`] that has nothing to do with the legs' reach.
    pub fn attempt(&self, value: f64, longest_step_s: f64) -> Result<Option<Manner>, SceneError> {
        let scene = self.scene_at(value, longest_step_s);
        match scene.check() {
            Ok(()) => {}
            Err(SceneError::Value { field, .. }) if field == "set_point" => {
                return Ok(Some(Manner::NotReachable));
            }
            Err(error) => return Err(error),
        }
        let (run, fault) = play(&scene, self.control);
        let ending = Ending { scene: &scene, run: &run, fault };
        Ok(ending.manner(&self.criterion))
    }
}

/// Runs a scene under the host's controller in double precision; with the fault that ended it.
pub fn play(scene: &Scene, control: Loop) -> (Run, Option<Fault>) {
    let inner = match control {
        Loop::Supervised => controller(scene, Scalar::F64),
        Loop::Bare => bare_controller(scene, Scalar::F64),
    };
    let mut watched = Watched { inner, fault: None };
    let run = run(scene, &mut watched, &mut |_| {});
    (run, watched.fault)
}

/// A controller whose fault is kept: runs tell it in words only.
struct Watched {
    inner: Box<dyn Controller>,
    fault: Option<Fault>,
}

impl Controller for Watched {
    fn tick(&mut self, state: &PlantState) -> Result<Commanded, ControlFailure> {
        let result = self.inner.tick(state);
        if let Err(ControlFailure::Fault(fault)) = &result {
            self.fault = Some(*fault);
        }
        result
    }

    fn stopped(&self) -> Option<StopReason> {
        self.inner.stopped()
    }
}

//! Which method and step a run takes, and why: those of the command line, else the recommended ones.

use super::run::Options;
use crate::precision::{Advice, Among, Effort, Problem, STEP_MARGIN, advise};
use indicatif::ProgressBar;
use std::time::Duration;
use surefoot_sim::mechanism::start;
use surefoot_sim::scene::{AnyScene, Integrator, MechanismScene, Scene};

/// The accuracy of a scene that says nothing about it.
pub(super) const ACCURACY: f64 = 1e-4;

/// The mechanism's method and step in its scene, and why these.
///
/// # Errors
/// Where no method is known to be accurate enough.
pub(super) fn of_mechanism(
    scene: &mut MechanismScene,
    options: &Options,
) -> Result<String, String> {
    let asked =
        options.accuracy.or(scene.is_unadvised.then(|| scene.matters.accuracy.unwrap_or(ACCURACY)));
    let own = match scene.matters.accuracy {
        Some(accuracy) => format!("recommended for an error of {accuracy:.0e}"),
        None if options.links.is_some() => {
            "the simulator's own, as nothing is recommended for this many links; --accuracy asks"
                .to_owned()
        }
        None => "named by the scene".to_owned(),
    };
    let whole = AnyScene::Mechanism(scene.clone());
    let of_scene = scene.integrator;
    let reason = chosen(&whole, &mut scene.integrator, asked, options, own)?;
    let other_method = scene.integrator.name != of_scene.name;
    if !(other_method && options.step.is_none() && asked.is_none()) {
        return Ok(reason);
    }
    Ok(shortened(scene).unwrap_or(reason))
}

/// Shortens the scene's step, which is that of another method, to what this one can make, if it is known to be longer.
/// Gives the reason. What cannot be started is refused later, by its name.
fn shortened(scene: &mut MechanismScene) -> Option<String> {
    let longest = start(scene).ok()?.forecast_s()?;
    let most = STEP_MARGIN * longest;
    if !(scene.integrator.step_s > most) {
        return None;
    }
    // A whole number of them.
    scene.integrator.step_s = scene.duration_s / (scene.duration_s / most).ceil();
    Some(format!(
        "method named on the command line; the scene's step is another method's: this is {STEP_MARGIN} of the longest \
         one predicted for this one, {longest:.2e} s"
    ))
}

/// The same of a robot.
///
/// # Errors
/// As for [`of_mechanism`].
pub(super) fn of_robot(scene: &mut Scene, options: &Options) -> Result<String, String> {
    let whole = AnyScene::Robot(Box::new(scene.clone()));
    let own = "named by the scene".to_owned();
    chosen(&whole, &mut scene.integrator, options.accuracy, options, own)
}

fn chosen(
    scene: &AnyScene,
    integrator: &mut Integrator,
    accuracy: Option<f64>,
    options: &Options,
    own: String,
) -> Result<String, String> {
    let (method, step) = (options.integrator, options.step);
    let mut reason = own;
    if let Some(accuracy) = accuracy.filter(|_| method.is_none() || step.is_none()) {
        let among = method.map_or(Among::Run, Among::Only);
        let advice = advised(scene, accuracy, among)?;
        *integrator = advice.integrator().ok_or("no method of `run` is advised")?;
        reason = why(&advice);
    }
    integrator.name = method.unwrap_or(integrator.name);
    integrator.step_s = step.unwrap_or(integrator.step_s);
    Ok(match (method, step) {
        (None, None) => reason,
        (Some(_), Some(_)) => "named on the command line".to_owned(),
        (Some(_), None) if accuracy.is_none() => {
            "method named on the command line, step by the scene".to_owned()
        }
        (Some(_), None) => format!("method named on the command line; {reason}"),
        (None, Some(_)) => format!("step named on the command line; method {reason}"),
    })
}

fn advised(scene: &AnyScene, accuracy: f64, among: Among) -> Result<Advice, String> {
    if !(accuracy > 0.0 && accuracy < 1.0) {
        return Err(format!("--accuracy {accuracy}: expected a number between 0 and 1"));
    }
    let problem = Problem::of_scene(scene).map_err(|error| error.to_string())?;
    let bar = ProgressBar::new_spinner();
    bar.set_message("looking for the quickest method that is accurate enough");
    bar.enable_steady_tick(Duration::from_millis(500));
    let advice = advise(&problem, accuracy, among, &Effort::ADVICE);
    bar.finish_and_clear();
    advice.map_err(|error| format!("no advice: {error}; --integrator and --step name others"))
}

fn why(advice: &Advice) -> String {
    let limit = match advice.choice.limit_s() {
        Some(limit) => format!("{:.2} of the step's limit", advice.choice.step_s / limit),
        None => "no limit of the step is known".to_owned(),
    };
    format!(
        "advised for an error of {:.0e}: {:.1e} when tried, {limit}",
        advice.accuracy,
        advice.tried.error.unwrap_or(f64::NAN)
    )
}

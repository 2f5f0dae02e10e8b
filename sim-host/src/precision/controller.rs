//! The controller's precision: errors of torques in f32 and f64, with feet held exactly or by a big base, or with
//! something left out, and of the motion at lower rates.

use super::controller_form::ControllerForm;
use super::measure::Timing;
use super::tick_count::{StatesFile, pass};
use cpu_time::ThreadTime;
use serde::Serialize;
use surefoot::spatial::Quaternion;
use surefoot_sim::closed_loop::{Controller, Scalar, controller, run};
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::{Scene, SceneError, load};

/// A form of the controller on all states of Experiment 1.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TorqueError {
    /// Which one.
    #[serde(flatten)]
    pub form: ControllerForm,
    /// Largest error of a torque over the largest torque; none where some tick gave none.
    pub largest: Option<f64>,
    /// Half of the ticks' largest errors are below this.
    pub median: Option<f64>,
    /// Ticks that gave no torques.
    pub faults: usize,
    /// A tick's instructions, the mean over all states, where they have been counted.
    pub instructions: Option<u64>,
    /// A tick's computing time on this machine, s.
    pub tick: Option<Timing>,
}

/// What a lower rate does to the motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TrackingError {
    /// Ticks a second.
    pub rate_hz: f64,
    /// Root mean square distance of the central body from where [`FASTEST_HZ`] has it, m; none where the robot
    /// does not stand to the end.
    pub position_m: Option<f64>,
    /// The same of its orientation, rad.
    pub orientation_rad: Option<f64>,
}

/// All of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ControllerPrecision {
    /// Of torques; the reference is the exact foot in f64, whose own round-off is some 1e-15.
    pub torques: Vec<TorqueError>,
    /// Of the motion.
    pub tracking: Vec<TrackingError>,
    /// Why instructions have not been counted, where they have not.
    pub uncounted: Option<String>,
}

/// The rate that stands for a controller without delay.
pub const FASTEST_HZ: f64 = 8000.0;
/// Rates are this divided by whole numbers, so that all have the same steps.
const DIVISORS: [u32; 10] = [2, 4, 8, 16, 32, 64, 80, 100, 125, 160];
/// Passes through all states that are timed.
const PASSES: usize = 15;

/// Measures it on Experiment 1, and counts instructions where that `is_counted`: by running this program, which must
/// then be `surefoot`.
///
/// # Errors
/// [`SceneError`] where the built-in scene is none.
pub fn controller_precision(is_counted: bool) -> Result<ControllerPrecision, SceneError> {
    let scene = load("experiment-1")?;
    let exact = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
    let states: Vec<PlantState> = exact
        .samples
        .iter()
        .map(|sample| PlantState {
            positions: sample.positions.clone(),
            velocities: sample.velocities.clone(),
        })
        .collect();
    let wanted = torques(ControllerForm::EXACT.controller(&scene).as_mut(), &states);
    let forms = ControllerForm::all();
    let counts = match is_counted {
        true => counted(&forms, &states),
        false => Err("not asked for".to_owned()),
    };
    let (counts, uncounted) = match counts {
        Ok(counts) => (counts.into_iter().map(Some).collect(), None),
        Err(reason) => (vec![None; forms.len()], Some(reason)),
    };
    let each = forms.into_iter().zip(counts);
    let torques = each.map(|(form, instructions)| TorqueError {
        instructions,
        ..torque_error(form, &scene, &states, &wanted)
    });
    Ok(ControllerPrecision { torques: torques.collect(), tracking: tracking(&scene), uncounted })
}

fn counted(forms: &[ControllerForm], states: &[PlantState]) -> Result<Vec<u64>, String> {
    let file = StatesFile::write(states).map_err(|error| error.to_string())?;
    file.count(forms).map_err(|error| error.to_string())
}

fn torques(controller: &mut dyn Controller, states: &[PlantState]) -> Vec<Option<Vec<f64>>> {
    states.iter().map(|state| Some(controller.tick(state).ok()?.torques)).collect()
}

fn torque_error(
    form: ControllerForm,
    scene: &Scene,
    states: &[PlantState],
    wanted: &[Option<Vec<f64>>],
) -> TorqueError {
    let mut controller = form.controller(scene);
    let given = torques(controller.as_mut(), states);
    let scale = wanted.iter().flatten().flatten().fold(0.0_f64, |m, torque| m.max(torque.abs()));
    let pairs = given.iter().zip(wanted).filter_map(|(a, b)| a.as_ref().zip(b.as_ref()));
    let mut errors: Vec<f64> = pairs
        .map(|(a, b)| a.iter().zip(b).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs())) / scale)
        .collect();
    errors.sort_by(f64::total_cmp);
    let faults = given.iter().filter(|torques| torques.is_none()).count();
    let times = (0..PASSES).map(|_| {
        let begun = ThreadTime::now();
        pass(controller.as_mut(), states, 1);
        begun.elapsed().as_secs_f64() / states.len() as f64
    });
    TorqueError {
        form,
        instructions: None,
        largest: errors.last().copied().filter(|_| faults == 0),
        median: errors.get(errors.len() / 2).copied(),
        faults,
        tick: Timing::of(times.collect()),
    }
}

fn tracking(scene: &Scene) -> Vec<TrackingError> {
    // Compared at 50 Hz, which divides all rates.
    const COMPARED_HZ: f64 = 50.0;
    let places = |rate_hz: f64| -> Option<Vec<Vec<f64>>> {
        let mut scene = scene.clone();
        scene.controller.rate_hz = rate_hz;
        scene.integrator.step_s = 1.0 / FASTEST_HZ;
        let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
        let every = (rate_hz / COMPARED_HZ).round() as usize;
        let compared = run.samples.iter().step_by(every).map(|sample| sample.positions.clone());
        run.failure.is_none().then(|| compared.collect())
    };
    let fastest = places(FASTEST_HZ);
    let compared = DIVISORS.map(|divisor| {
        let rate_hz = FASTEST_HZ / f64::from(divisor);
        let both = places(rate_hz).zip(fastest.as_ref());
        let root_mean_square = |apart: fn(&[f64], &[f64]) -> f64| {
            let (own, fast) = both.as_ref()?;
            let sum: f64 = own.iter().zip(fast.iter()).map(|(a, b)| apart(a, b).powi(2)).sum();
            Some((sum / own.len() as f64).sqrt())
        };
        TrackingError {
            rate_hz,
            position_m: root_mean_square(|a, b| {
                (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
            }),
            orientation_rad: root_mean_square(|a, b| {
                let q = |p: &[f64]| Quaternion::from_array([p[3], p[4], p[5], p[6]]);
                2.0 * q(a).conjugate().product(q(b)).v.norm().min(1.0).asin()
            }),
        }
    });
    compared.into()
}

//! With welded feet the closed loop obeys its error dynamics: (4.14), which has a closed form, and
//! (4.26), integrated here by itself. Controller at every plant step, exactly fixed feet.

use nalgebra::Vector3;
use surefoot_mechanics::integrators::Method;
use surefoot_sim::closed_loop::{Run, Scalar, controller, run};
use surefoot_sim::scene::{Integrator, Scene, load};

const KP: [f64; 3] = [50.0, 50.0, 200.0];
const KV: [f64; 3] = [7.07, 7.07, 14.142];
const KRP: f64 = 50.0;
const KRV: f64 = 7.07;

fn welded(method: Method, step: f64) -> (Scene, Run) {
    let mut scene = load("experiment-1-welded").expect("a built-in scene");
    scene.integrator = Integrator { name: method, step_s: step };
    scene.controller.rate_hz = 1.0 / step;
    scene.duration_s = 1.5;
    scene.check().expect("a valid scene");
    let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
    assert!(run.failure.is_none(), "{:?}", run.failure);
    (scene, run)
}

/// Solution of `e'' + Kv e' + Kp e = 0`, underdamped, from rest.
fn position_error(axis: usize, e0: f64, t: f64) -> f64 {
    let a = 0.5 * KV[axis];
    let b = (KP[axis] - a * a).sqrt();
    e0 * (-a * t).exp() * ((b * t).cos() + a / b * (b * t).sin())
}

/// Largest deviation from (4.14), relative to the initial error's length.
fn position_deviation(run: &Run) -> f64 {
    let first = Vector3::from(run.samples[0].position_error);
    run.samples
        .iter()
        .map(|sample| {
            let expected = Vector3::from_fn(|i, _| position_error(i, first[i], sample.time_s));
            (Vector3::from(sample.position_error) - expected).norm() / first.norm()
        })
        .fold(0.0, f64::max)
}

/// Right-hand side of (4.26): `q̇ = ½(√(1 − q·q) ω − q × ω)`, `ω̇ = −K_R^p q − K_R^v ω`, as the text
/// derives it from `q̇_e = (0, ω_e/2) ⋆ q_e`, whose vector part is `½(q^s ω + ω × q^v)`.
fn orientation_rates(q: Vector3<f64>, w: Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let s = (1.0 - q.norm_squared()).sqrt();
    ((w * s + w.cross(&q)) * 0.5, -q * KRP - w * KRV)
}

/// Largest deviation from (4.26), integrated by RK4 at the sample times (error ~ 1e-12).
fn orientation_deviation(run: &Run) -> f64 {
    let vector = |e: [f64; 4]| Vector3::new(e[1], e[2], e[3]);
    let mut q = vector(run.samples[0].orientation_error);
    let mut w = Vector3::zeros();
    let scale = q.norm();
    let mut worst = 0.0_f64;
    for pair in run.samples.windows(2) {
        let h = pair[1].time_s - pair[0].time_s;
        let (k1, l1) = orientation_rates(q, w);
        let (k2, l2) = orientation_rates(q + k1 * (h / 2.0), w + l1 * (h / 2.0));
        let (k3, l3) = orientation_rates(q + k2 * (h / 2.0), w + l2 * (h / 2.0));
        let (k4, l4) = orientation_rates(q + k3 * h, w + l3 * h);
        q += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
        w += (l1 + l2 * 2.0 + l3 * 2.0 + l4) * (h / 6.0);
        worst = worst.max((vector(pair[1].orientation_error) - q).norm() / scale);
    }
    worst
}

#[test]
fn errors_follow_their_dynamics_and_converge_with_the_step() {
    let steps = [4e-4, 2e-4, 1e-4];
    let deviations: Vec<(f64, f64)> = steps
        .iter()
        .map(|h| {
            let (_, run) = welded(Method::SemiImplicitEuler, *h);
            (position_deviation(&run), orientation_deviation(&run))
        })
        .collect();
    println!("{deviations:?}");
    let (position, orientation) = deviations[2];
    assert!(position < 5e-3, "{position}");
    assert!(orientation < 5e-3, "{orientation}");
    // First order: halving the step halves the deviation.
    for pair in deviations.windows(2) {
        for ratio in [pair[0].0 / pair[1].0, pair[0].1 / pair[1].1] {
            assert!((1.9..2.1).contains(&ratio), "{ratio}");
        }
    }
}

/// Largest deviation from (4.14) as a sampled controller makes it, relative to the initial error's length:
/// `ë = −K_v ė − K_p e` of the last tick, held.
fn sampled_position_deviation(run: &Run, h: f64) -> f64 {
    let mut e = run.samples[0].position_error;
    let mut rate = [0.0; 3];
    let size = Vector3::from(e).norm();
    let mut worst = 0.0_f64;
    for sample in &run.samples {
        worst = worst.max((Vector3::from(sample.position_error) - Vector3::from(e)).norm() / size);
        for i in 0..3 {
            let u = -KV[i] * rate[i] - KP[i] * e[i];
            e[i] += h * rate[i] + 0.5 * h * h * u;
            rate[i] += h * u;
        }
    }
    worst
}

/// On the variational plant, in steps of a whole control period of 2 ms, the loop that its feet close holds to
/// round-off, and errors obey what the sampled controller asks for. (What is left is the controller's: it
/// holds torques, which are not quite accelerations.) The baseline is some seven times further off, and its
/// feet drift.
#[test]
fn the_variational_plant_obeys_at_large_steps() {
    let deviation = |method, h| {
        let (_, run) = welded(method, h);
        (sampled_position_deviation(&run, h), run.constraint_max)
    };
    let (ours, drift) = deviation(Method::Variational, 2e-3);
    let (baseline, _) = deviation(Method::SemiImplicitEuler, 2e-3);
    let (fine, _) = deviation(Method::SemiImplicitEuler, 1e-4);
    println!("2 ms: {ours:.1e}, feet {drift:.1e}; baseline {baseline:.1e}, at 0.1 ms {fine:.1e}");
    assert!(ours < 2e-3 && 4.0 * ours < baseline, "{ours} {baseline}");
    assert!(drift < 1e-10, "{drift}");
    let (half, _) = deviation(Method::Variational, 1e-3);
    println!("1 ms: {half:.1e}");
}

/// The welds hold: feet drift in proportion to the step, and little.
#[test]
fn welded_feet_stay() {
    let (_, coarse) = welded(Method::SemiImplicitEuler, 2e-4);
    let (_, fine) = welded(Method::SemiImplicitEuler, 1e-4);
    println!("{} {}", coarse.constraint_max, fine.constraint_max);
    assert!(fine.constraint_max < 2e-5);
    assert!((1.8..2.2).contains(&(coarse.constraint_max / fine.constraint_max)));
}

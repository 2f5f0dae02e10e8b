//! No state makes a tick long: random ones, nearly singular ones, and faulty ones.

use crate::bench::{JOINTS, Sensors, Target, ToTarget, Torques, arm, target};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::balance::Mode;
use surefoot::spatial::Quaternion;
use surefoot_sim::closed_loop::firmware::{set_point, settings, wrench_settings};
use surefoot_sim::scene::{Scene, load};

/// A state near standing, such as no supervisor stops; the knees' angles are given.
fn random(random: &mut Pcg64Mcg, knees: [f32; 2]) -> Sensors {
    let mut within = |size: f32| random.random_range(-size..size);
    let tilt = [within(0.1), within(0.1), within(0.1)];
    let scalar = (1.0 - tilt.iter().map(|x| x * x).sum::<f32>()).sqrt();
    Sensors {
        position: [within(0.3), within(0.3), 1.0 + within(0.2)],
        orientation: [scalar, tilt[0], tilt[1], tilt[2]],
        velocity: std::array::from_fn(|_| within(1.0)),
        joint_angles: surefoot_link::by_joint(
            &knees.map(|knee| {
                [within(0.5), within(0.8), within(0.5), knee, within(0.5), within(0.8)]
            }),
            0.0,
        ),
        joint_rates: std::array::from_fn(|_| within(5.0)).into(),
        contacts: 3,
        forces: surefoot_link::Joints::new([0.0; surefoot_link::MOST_FEET], 0),
    }
}

/// The same robot one period later, at the same rates.
fn later(mut sensors: Sensors, period: f32) -> Sensors {
    let q = Quaternion::from_array(sensors.orientation);
    let [vx, vy, vz, wx, wy, wz] = sensors.velocity.map(|x| x * period);
    let moved = q.rotate(Vector3::new(vx, vy, vz));
    sensors.position = std::array::from_fn(|i| sensors.position[i] + moved[i]);
    let turned = q.product(Quaternion::from_array([1.0, wx / 2.0, wy / 2.0, wz / 2.0])).to_array();
    let norm = turned.iter().map(|x| x * x).sum::<f32>().sqrt();
    sensors.orientation = turned.map(|x| x / norm);
    for (angle, rate) in sensors.joint_angles.iter_mut().zip(&sensors.joint_rates) {
        *angle += period * rate;
    }
    sensors
}

/// The second tick after arming, which has all of a tick's work.
fn second_tick(target: &mut Target, scene: &Scene, first: &Sensors, second: &Sensors) -> Torques {
    arm(target, scene);
    target.tick(first).expect("an answer");
    target.tick(second).expect("an answer")
}

#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn no_state_makes_a_tick_long() {
    let scene = load("experiment-1").expect("built in");
    let period = (1.0 / scene.controller.rate_hz) as f32;
    let mut target = target();
    let mut rng = Pcg64Mcg::seed_from_u64(4);
    let mut full = Vec::new();
    let mut check = |rng: &mut Pcg64Mcg, knees: [f32; 2]| {
        let state = random(rng, knees);
        let torques = second_tick(&mut target, &scene, &state, &later(state, period));
        if torques.mode == Mode::Active {
            full.push(torques.cost);
        }
        torques
    };
    for _ in 0..500 {
        let knees = [rng.random_range(-1.6..-0.3), rng.random_range(-1.6..-0.3)];
        check(&mut rng, knees);
    }
    let of_random = full_count(&mut check, &mut rng);
    assert!(of_random, "nearly straight knees still balance, with torques cut to their limits");
    let mean = full.iter().map(|c| f64::from(*c)).sum::<f64>() / full.len() as f64;
    let (least, most) = (full.iter().min().expect("ticks"), full.iter().max().expect("ticks"));
    println!("{} full ticks: {least} to {most} instructions, {mean:.1} on average", full.len());
    assert!(full.len() > 400, "most random states are regular");
    assert!(f64::from(*most) <= 1.02 * mean);

    // Faulty measurements: shorter or as long, never longer.
    let good = random(&mut rng, [-1.0, -1.1]);
    let good_later = later(good, period);
    let spoils: [fn(&mut Sensors); 7] = [
        |s| s.joint_angles[0] = f32::NAN,
        |s| s.joint_angles[11] = 1e30,
        |s| s.joint_rates[11] = f32::INFINITY,
        |s| s.position[0] = f32::NAN,
        |s| s.velocity[5] = f32::NEG_INFINITY,
        |s| s.orientation = [0.0; 4],
        |s| s.orientation = [0.0, 1.0, 0.0, 0.0],
    ];
    for (number, spoil) in spoils.into_iter().enumerate() {
        let mut bad = good_later;
        spoil(&mut bad);
        let torques = second_tick(&mut target, &scene, &good, &bad);
        assert_ne!(torques.mode, Mode::Active, "fault {number}");
        println!("fault {number}: {} instructions ({:?})", torques.cost, torques.reason);
        assert!(torques.cost <= *most, "fault {number}: {} and {most}", torques.cost);
    }
    // Finite, and absurd: torques at their limits.
    let mut far = good_later;
    far.position = [1e6, -1e6, 1e6];
    let torques = second_tick(&mut target, &scene, &good, &far);
    println!("far away: {} instructions, {:?}", torques.cost, torques.mode);
    assert!(torques.cost <= *most);
    // A straight knee, found as late as can be: in the second leg.
    let straight = random(&mut rng, [-1.0, 0.0]);
    let mut still = straight;
    still.joint_rates = [0.0; JOINTS].into();
    let torques = second_tick(&mut target, &scene, &still, &still);
    assert_ne!(torques.mode, Mode::Active);
    assert!(torques.cost <= *most);
}

/// The same within limits of ground and motors, each state as if out of nothing and once more from the limits that
/// bound then.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn no_state_makes_a_limited_tick_long() {
    let scene = load("stand").expect("built in");
    let limits = wrench_settings::<JOINTS>(&scene).expect("a limited distribution");
    let period = (1.0 / scene.controller.rate_hz) as f32;
    let (mut target, mut rng) = (target(), Pcg64Mcg::seed_from_u64(5));
    let (mut most, mut unfinished) = (0, 0);
    for number in 0..1000_u32 {
        for (name, order) in [
            ("disarm", ToTarget::Disarm),
            ("configure", ToTarget::Configure(settings(&scene))),
            ("limits", ToTarget::Limit(limits.clone())),
            ("set point", ToTarget::SetPoint(set_point(&scene))),
            ("arm", ToTarget::Arm(scene.robot().id().expect("legs of six joints"))),
        ] {
            target.order(name, &order).expect("obeyed");
        }
        let knees = [rng.random_range(-1.6..-0.3), rng.random_range(-1.6..-0.3)];
        let mut state = random(&mut rng, knees);
        state.contacts = [3, 3, 3, 1, 2, 0][number as usize % 6];
        for _ in 0..3 {
            let torques = target.tick(&state).expect("an answer");
            most = most.max(torques.cost);
            unfinished += u32::from(torques.limits.is_some_and(|limits| limits.is_unfinished));
            state = later(state, period);
        }
    }
    println!("within limits: {most} instructions at most, {unfinished} ticks unfinished");
    assert!(unfinished > 0, "no tick has spent all of its work");
    assert!(most <= 75_000, "{most}");
}

/// Knees from bent to nearly straight. Whether some of these ticks were full ones.
fn full_count(
    check: &mut impl FnMut(&mut Pcg64Mcg, [f32; 2]) -> Torques,
    rng: &mut Pcg64Mcg,
) -> bool {
    let mut any = false;
    for step in 1..60 {
        let knee = -0.005 * step as f32;
        any |= check(rng, [knee, -1.0]).mode == Mode::Active;
        any |= check(rng, [-1.0, knee]).mode == Mode::Active;
    }
    any
}

//! The observer of a robot that stands at rest under a load: all that it is told is known in closed form.

use super::in_axes;
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use surefoot::Real;
use surefoot::balance::{WholeBody, WholeBodyFoot, WholeBodyState};
use surefoot::dynamics::{body_poses, inverse_dynamics, joint_poses};
use surefoot::disturbance::{
    BalancePoint, BalancePointSettings, Disturbance, DisturbanceObserver, DisturbanceSettings, ExternalWrench, ExternalWrenchSettings,
    ForceContact, ForceThresholds, ObserverFault,
};
use surefoot::model::Tree;
use surefoot::spatial::{Quaternion, Wrench};
use surefoot_tests::legged_trees::{Legged, feet_f32, five, near_stance, quadruped, seven};

/// s
const PERIOD: f64 = 2e-3;
/// kg; and from the central body's centre of mass in world axes, m.
const LOAD: f64 = 2.0;
const AT: Vector3<f64> = Vector3::new(0.04, -0.02, 0.1);
/// Where the centre of mass is to stand from the feet, m.
const NOMINAL: [f64; 2] = [0.01, -0.02];

/// A robot at rest under a load, the ground and a hand.
struct Rest<const NQ: usize, const NV: usize> {
    state: WholeBodyState<f64, NQ, NV>,
    torques: [f64; NV],
    /// World axes, as all that follows, N.
    on_feet: [Vector3<f64>; 4],
    /// Load and hand, about the central body's centre of mass.
    outside: Wrench<f64>,
    /// The model's centre of mass and the middle of its feet, from there, m; and its mass, kg.
    center: Vector3<f64>,
    middle: Vector3<f64>,
    mass: f64,
}

/// Torques that hold the joints against gravity, load and ground, at any forces of the ground whose sum is the
/// weight. The wrench that makes the central body rest too is what is left, and acts from outside.
fn rest<const N: usize, const NQ: usize, const NV: usize>(
    rng: &mut Pcg64,
    robot: &Legged<N, NQ, NV>,
) -> Rest<NQ, NV> {
    let mut state = near_stance(rng, robot, 0.3);
    state.velocities = [0.0; NV];
    let poses = joint_poses(&robot.tree, &state.positions).expect("finite");
    let bodies = body_poses(&robot.tree, &poses);
    let weight = |mass: f64| Vector3::new(0.0, 0.0, -9.81 * mass);
    let load = Wrench { force: weight(LOAD), torque: AT.cross(&weight(LOAD)) };
    let feet = robot.feet.iter().flatten().count() as f64;
    let total = robot.tree.mass() + LOAD;
    let mut external = [Wrench::zero(); N];
    let mut on_feet = [Vector3::zeros(); 4];
    let mut middle = Vector3::zeros();
    for (number, foot) in robot.feet.iter().enumerate() {
        let Some(foot) = foot else { continue };
        let (x, y) = ([3.0, -1.0, 2.0, -4.0][number], [1.0, 2.0, -3.0, 0.0][number]);
        let force = Vector3::new(x, y, 9.81 * total / feet);
        let body = &bodies[foot.body];
        let arm = body.rotation * foot.reference;
        let force_on_body = Wrench { force, torque: Vector3::zeros() };
        external[foot.body] += in_axes(body, force_on_body.shifted(arm));
        on_feet[number] = force;
        middle += (body.position + arm - bodies[0].position) / feet;
    }
    let still = [0.0; NV];
    external[0] += in_axes(&bodies[0], load);
    let mut torques = inverse_dynamics(&robot.tree, &poses, &still, &still, Some(&external));
    // What a hand would have to give for the central body to rest.
    let hand = Wrench::from_array(*torques.first_chunk::<6>().expect("six"));
    let rotation = bodies[0].rotation;
    let hand = Wrench { force: rotation * hand.force, torque: rotation * hand.torque };
    torques[..6].fill(0.0);
    let masses = bodies.iter().enumerate();
    let moment: Vector3<f64> = masses
        .map(|(k, body)| {
            (body.position - bodies[0].position) * robot.tree.body_mass(k).unwrap_or(0.0)
        })
        .sum();
    let mass = robot.tree.mass();
    Rest { state, torques, on_feet, outside: load + hand, center: moment / mass, middle, mass }
}

fn observed<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    tree: &Tree<T, N, NQ, NV>,
    feet: &[Option<WholeBodyFoot<T>>; 4],
    rest: &Rest<NQ, NV>,
) -> (Disturbance<T, 4>, DisturbanceObserver<T, N, NQ, NV>) {
    let robot = WholeBody::new(tree, feet).expect("a legged robot");
    let mut settings = DisturbanceSettings::scaled(
        robot.mass(),
        T::of(9.81),
        T::of(-rest.middle.z),
        T::of(PERIOD),
        NOMINAL.map(T::of),
    )
    .expect("a robot");
    // Whatever it is.
    settings.wrench.bound = [T::of(1e4); 6];
    settings.wrench.innovation = [T::of(1e4); 6];
    settings.wrench.dead_zone = [T::zero(); 6];
    settings.balance.bound = T::of(1e3);
    settings.wrench.rate = T::of(20.0);
    settings.balance.rate = T::of(20.0);
    let mut observer = DisturbanceObserver::new(settings).expect("numbers that can be");
    let state = WholeBodyState {
        positions: rest.state.positions.map(T::of),
        velocities: [T::zero(); NV],
    };
    let torques = rest.torques.map(T::of);
    let mut last = None;
    for _ in 0..(1.7 / PERIOD) as usize {
        let seen = observer.update(tree, &robot, &state, &torques, &[true; 4]).expect("finite");
        last = seen.or(last);
    }
    (last.expect("ticks"), observer)
}

/// Largest errors at rest: forces of the ground and wrench from outside (N, N·m), and the set point (m).
fn errors<const N: usize, const NQ: usize, const NV: usize>(
    make: fn(&mut Pcg64) -> Legged<N, NQ, NV>,
) -> [[f64; 3]; 2] {
    let mut rng = Pcg64::seed_from_u64(7);
    let mut worst = [[0.0_f64; 3]; 2];
    for _ in 0..5 {
        let robot = make(&mut rng);
        let rest = rest(&mut rng, &robot);
        let double = observed(&robot.tree, &robot.feet, &rest);
        let single = observed(&robot.tree.to_f32(), &feet_f32(&robot.feet), &rest);
        for (worst, found) in worst.iter_mut().zip([of(&double, &rest), of(&single, &rest)]) {
            worst.iter_mut().zip(found).for_each(|(worst, x)| *worst = worst.max(x));
        }
    }
    worst
}

fn of<T: Real, const N: usize, const NQ: usize, const NV: usize>(
    (seen, observer): &(Disturbance<T, 4>, DisturbanceObserver<T, N, NQ, NV>),
    rest: &Rest<NQ, NV>,
) -> [f64; 3] {
    let mut forces = 0.0_f64;
    for (foot, wanted) in seen.feet.iter().zip(&rest.on_feet) {
        let Some(foot) = foot else { continue };
        forces = forces.max((foot.wrench.force.map(Real::to_f64) - wanted).amax());
    }
    let w = seen.wrench.to_array().map(Real::to_f64);
    let wrench = w.into_iter().zip(rest.outside.to_array()).map(|(a, b)| (a - b).abs());
    // The body's place over the feet, and from it the point about which weight and wrench have no moment.
    let Wrench { force, torque } = rest.outside;
    let (height, weight) = (-rest.middle.z, rest.mass * 9.81);
    let point = [
        (weight * rest.center.x + height * force.x + torque.y) / (weight - force.z),
        (weight * rest.center.y + height * force.y - torque.x) / (weight - force.z),
    ];
    let place = observer.balance.from_feet.expect("it stands").map(Real::to_f64);
    let off = [place[0] + point[0] - NOMINAL[0], place[1] + point[1] - NOMINAL[1]];
    [forces, wrench.fold(0.0, f64::max), off[0].abs().max(off[1].abs())]
}

/// Measured in f64: forces to 2.0e-13 N, wrenches to 6.0e-11 (what is left of their pole), the set point to
/// 5.0e-12 m; in f32 1.4e-4 N, 5.3e-4 N or N·m and 3.5 µm.
#[test]
fn observer_at_rest_reads_ground_load_and_set_point() {
    for [double, single] in [errors(quadruped), errors(five), errors(seven)] {
        let [forces, wrench, place] = double;
        assert!(forces < 1e-12 && wrench < 2e-10 && place < 2e-11, "{double:?}");
        let [forces, wrench, place] = single;
        assert!(forces < 5e-4 && wrench < 2e-3 && place < 1e-5, "{single:?}");
    }
}

/// A load is read as its weight and that weight's moment, and moves the set point so that the common centre of
/// mass is where the model's was to be. The feet's forces, in the body's axes, point up.
#[test]
fn observer_reads_a_load_as_its_weight() {
    let mut rng = Pcg64::seed_from_u64(9);
    let robot = quadruped(&mut rng);
    let mut rest = rest(&mut rng, &robot);
    let weight = Vector3::new(0.0, 0.0, -9.81 * LOAD);
    let load = Wrench { force: weight, torque: AT.cross(&weight) };
    let (with_hand, _) = observed(&robot.tree, &robot.feet, &rest);
    let hand = rest.outside - load;
    assert!((with_hand.wrench - hand - load).to_array().iter().all(|x| x.abs() < 2e-10));
    let sum: Vector3<f64> = rest.on_feet.iter().sum();
    let q = rest.state.positions[3..7].try_into().map(Quaternion::from_array).expect("four");
    assert!((q.rotate(with_hand.support) - sum).amax() < 1e-11);
    // Without the hand: (1) of the balance point, from a wrench that is the load's.
    rest.outside = load;
    let common = (rest.center * rest.mass + AT * LOAD) / (rest.mass + LOAD);
    let mut point = BalancePoint::new();
    let settings = BalancePointSettings::scaled(rest.mass, 9.81, -rest.middle.z, NOMINAL);
    let feet = with_hand.feet;
    let settings = settings.expect("a robot");
    point.update(&settings, rest.center, &load, (&feet, &[true; 4]), PERIOD);
    let [x, y] = point.from_feet.expect("it stands");
    let off = [x + common.x - NOMINAL[0], y + common.y - NOMINAL[1]];
    assert!(off.iter().all(|x| x.abs() < 1e-15), "{off:?}");
    // A foot in the air leaves it alone; so does a robot that is lifted.
    let before = point;
    point.update(&settings, rest.center, &force(9.0), (&feet, &[true, true, false, true]), PERIOD);
    let lifted = Wrench { force: Vector3::new(0.0, 0.0, 1e3), torque: Vector3::zeros() };
    point.update(&settings, rest.center, &lifted, (&feet, &[true; 4]), PERIOD);
    assert_eq!(point.from_feet, before.from_feet);
}

fn settings() -> ExternalWrenchSettings<f64> {
    ExternalWrenchSettings::scaled(75.0, 9.81, 1.0).expect("a robot")
}

fn force(x: f64) -> Wrench<f64> {
    Wrench { force: Vector3::new(x, 0.0, 0.0), torque: Vector3::zeros() }
}

/// A push of 1 kN for 0.1 s moves W by 2 · 0.1 · 29.4 N and no more, and no wrench goes beyond its bound.
#[test]
fn wrench_is_clipped_and_bounded() {
    let settings = settings();
    let mut wrench = ExternalWrench::new();
    for _ in 0..50 {
        wrench.update(&settings, force(1000.0), PERIOD);
    }
    assert!((wrench.wrench.force.x - 0.2 * settings.innovation[0]).abs() < 1e-9);
    for _ in 0..5000 {
        wrench.update(&settings, force(1000.0), PERIOD);
        // It would come to rest before.
        wrench.at_rest = None;
        wrench.awake = 0.0;
    }
    assert_eq!(wrench.wrench.force.x, settings.bound[0]);
}

/// Come to rest, W stays while what is seen changes by less than the dead zone.
#[test]
fn wrench_at_rest_stays_within_its_dead_zone() {
    let settings = settings();
    let mut wrench = ExternalWrench::new();
    for _ in 0..2000 {
        wrench.update(&settings, force(20.0), PERIOD);
    }
    let rested = wrench.wrench.force.x;
    assert!(wrench.at_rest.is_some() && (rested - 20.0).abs() < 0.1, "{rested}");
    for k in 0..1000 {
        let off = 0.9 * settings.dead_zone[0] * f64::from(k).sin();
        wrench.update(&settings, force(20.0 + off), PERIOD);
    }
    assert_eq!(wrench.wrench.force.x, rested);
    wrench.update(&settings, force(20.0 + 1.2 * settings.dead_zone[0]), PERIOD);
    assert!(wrench.wrench.force.x > rested);
}

/// What never comes to rest is left alone in the end: a wrench that runs away from W.
#[test]
fn wrench_loses_patience() {
    let settings = settings();
    let mut wrench = ExternalWrench::new();
    for _ in 0..3000 {
        wrench.update(&settings, force(wrench.wrench.force.x + 2.0), PERIOD);
    }
    let left = wrench.wrench.force.x;
    assert!((left - 2.0 * settings.rate * settings.patience).abs() < 0.1, "{left}");
}

#[test]
fn force_contact_has_two_thresholds() {
    let thresholds = ForceThresholds::scaled(735.0_f64);
    let mut contact = ForceContact::<2>::new();
    let foot = |z: f64| {
        let wrench = Wrench { force: Vector3::new(0.0, 0.0, z), torque: Vector3::zeros() };
        Some(surefoot::disturbance::FootForce { wrench, position: Vector3::zeros() })
    };
    for (z, touches) in [(50.0, true), (20.0, false), (50.0, false), (90.0, true), (40.0, true)] {
        contact.update(&thresholds, &[foot(z), None]);
        assert_eq!(contact.touches, [touches, true], "{z} N");
    }
}

#[test]
fn observer_refuses_what_cannot_be() {
    let scaled = |mass, height| {
        DisturbanceSettings::<f64>::scaled(mass, 9.81, height, PERIOD, [0.0; 2]).expect_err("none")
    };
    assert_eq!(scaled(0.0, 1.0), ObserverFault::Robot);
    assert_eq!(scaled(75.0, f64::NAN), ObserverFault::Robot);
    let good = DisturbanceSettings::scaled(75.0, 9.81, 1.0, PERIOD, [0.0; 2]).expect("a robot");
    let made = |settings| DisturbanceObserver::<f64, 13, 19, 18>::new(settings).map(|_| ());
    assert_eq!(made(good), Ok(()));
    let mut bad = good;
    bad.wrench.rate = 501.0;
    assert_eq!(made(bad), Err(ObserverFault::Rate));
    bad = good;
    bad.wrench.dead_zone[3] = -1.0;
    assert_eq!(made(bad), Err(ObserverFault::Bound));
    bad = good;
    bad.period = 0.0;
    assert_eq!(made(bad), Err(ObserverFault::Period));
    bad = good;
    bad.balance.rate = f64::NAN;
    assert_eq!(made(bad), Err(ObserverFault::Rate));
    bad = good;
    bad.settle = -1.0;
    assert_eq!(made(bad), Err(ObserverFault::Bound));
}

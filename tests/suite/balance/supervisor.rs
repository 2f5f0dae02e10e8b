//! The supervisor: torques within limits whatever happens, doubt, and a stop that brakes and ends in zero.

mod measurements;

use measurements::moving;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::Real;
use surefoot::balance::{
    Controller, Fault, Input, LeggedRobot, LimitError, LimitFault, LimitField, Mode, Reference,
    RobotState, SafetyLimits, StopReason, Supervised, Supervisor,
};
use surefoot::dynamics::{joint_poses, mass_matrix};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};

static ROBOT: LeggedRobot<f64, 2> = LeggedRobot::new(&biped::TREE);
static ROBOT_F32: LeggedRobot<f32, 2> = ROBOT.to_f32();

const PERIOD: f64 = 0.002;

/// Crouching, at rest.
fn crouch<T: Real>() -> RobotState<T, 2> {
    let leg = [0.0, 40.0, 0.0, -77.46, 0.0, 37.46].map(|d: f64| T::of(d.to_radians()));
    RobotState {
        position: [0.0, 0.0, 1.035].map(T::of).into(),
        orientation: Quaternion::identity(),
        velocity: Twist::zero(),
        joint_angles: [leg; 2],
        joint_rates: [[T::zero(); 6]; 2],
    }
}

fn reference<T: Real>() -> Reference<T> {
    Reference::at_rest([0.0, 0.0, 1.05].map(T::of).into(), Quaternion::identity())
}

struct Loop<T: 'static> {
    controller: Controller<'static, T, 2>,
    reference: Reference<T>,
    supervisor: Supervisor<T, 2>,
    limits: SafetyLimits<T, 2>,
}

/// A robot in a precision, with its limits in that.
trait Biped: Real {
    const ROBOT: &'static LeggedRobot<Self, 2>;
    const LIMITS: SafetyLimits<Self, 2>;
}

impl Biped for f64 {
    const ROBOT: &'static LeggedRobot<f64, 2> = &ROBOT;
    const LIMITS: SafetyLimits<f64, 2> = biped::LIMITS;
}

impl Biped for f32 {
    const ROBOT: &'static LeggedRobot<f32, 2> = &ROBOT_F32;
    const LIMITS: SafetyLimits<f32, 2> = biped::LIMITS.to_f32();
}

impl<T: Biped> Loop<T> {
    fn new() -> Self {
        Self {
            controller: Controller::new(T::ROBOT),
            reference: reference(),
            supervisor: Supervisor::new(T::LIMITS, T::of(PERIOD)).expect("limits"),
            limits: T::LIMITS,
        }
    }

    /// Armed, after a first tick at rest.
    fn armed() -> Self {
        let mut it = Self::new();
        it.supervisor.arm();
        it.step(Some(&crouch()), false);
        it
    }

    /// One step, whose torques are numbers within limits.
    fn step(&mut self, measured: Option<&RobotState<T, 2>>, overran: bool) -> Supervised<T, 2> {
        let out = self.supervisor.step(&self.controller, measured, &self.reference, overran);
        let joints = self.limits.joints.iter().flatten();
        for (torque, joint) in out.joint_torques.iter().flatten().zip(joints) {
            assert!(torque.abs() <= joint.torque, "{} N·m", torque.to_f64());
        }
        out
    }
}

/// Ten thousand ticks of good, bad, missing and late measurements, with orders in between.
fn whatever_happens<T: Biped>() {
    let mut rng = Pcg64Mcg::seed_from_u64(11);
    let mut it = Loop::<T>::new();
    let mut stops = 0;
    for _ in 0..10_000 {
        let mut state = crouch::<T>();
        let bad = [f64::NAN, f64::INFINITY, -1e300, 1e30, 1e4, 3.0];
        match rng.random_range(0..40) {
            0 => it.supervisor.arm(),
            1 => it.supervisor.disarm(),
            2 => state.joint_angles[1][rng.random_range(0..6)] = T::of(bad[rng.random_range(0..6)]),
            3 => state.joint_rates[0][rng.random_range(0..6)] = T::of(bad[rng.random_range(0..6)]),
            4 => state.position[rng.random_range(0..3)] = T::of(bad[rng.random_range(0..6)]),
            5 => state.orientation.s = T::of(bad[rng.random_range(0..6)]),
            6 => state.velocity.angular[2] = T::of(bad[rng.random_range(0..6)]),
            _ => {}
        }
        let before = it.supervisor.mode();
        let is_missing = rng.random_range(0..20) == 0;
        let overran = rng.random_range(0..200) == 0;
        let out = it.step((!is_missing).then_some(&state), overran);
        let after = it.supervisor.mode();
        if before == Mode::Active && after != Mode::Active {
            assert!(it.supervisor.reason().is_some() && out.command.is_none());
            stops += 1;
        }
        assert!(matches!(after, Mode::Active | Mode::Stopping { .. }) || is_zero(&out));
        // A stop lasts for 500 ticks, longer than most of what happens here.
        if rng.random_range(0..20) == 0 {
            it.supervisor.disarm();
            it.supervisor.arm();
        }
    }
    assert!(stops > 30, "{stops} stops are no test");
}

fn is_zero<T: Real>(out: &Supervised<T, 2>) -> bool {
    out.joint_torques.iter().flatten().all(|torque| *torque == T::zero())
}

#[test]
fn torques_stay_within_limits_whatever_happens() {
    whatever_happens::<f64>();
    whatever_happens::<f32>();
}

/// The way round: standby, active, stopping, stopped, active.
#[test]
fn modes_follow_each_other() {
    let mut it = Loop::<f64>::new();
    let state = crouch();
    assert!(is_zero(&it.step(Some(&state), false)), "nothing moves before it is armed");
    it.supervisor.arm();
    let sent = it.step(Some(&state), false);
    assert_eq!(it.supervisor.mode(), Mode::Active);
    let command = sent.command.expect("a tick's answer");
    assert_eq!(sent.joint_torques, command.joint_torques);

    // One measurement missing is bridged, the second is not.
    assert_eq!(it.step(None, false).joint_torques, sent.joint_torques);
    assert!(is_zero(&it.step(None, false)), "of a robot of which nothing is known");
    assert_eq!(it.supervisor.reason(), Some(StopReason::Stale));
    let ticks = (it.limits.stop_s / PERIOD).round() as u16;
    for left in (0..ticks - 1).rev() {
        // Orders to begin anew wait until the stop is over.
        it.supervisor.arm();
        assert!(is_zero(&it.step(Some(&state), false)), "a robot at rest is not moved");
        let expected = if left == 0 { Mode::Stopped } else { Mode::Stopping { left } };
        assert_eq!(it.supervisor.mode(), expected);
    }
    assert!(is_zero(&it.step(Some(&state), false)));
    assert_eq!(it.supervisor.reason(), Some(StopReason::Stale), "until it is armed again");
    it.supervisor.arm();
    assert_eq!(it.supervisor.reason(), None);
    assert_eq!(it.step(Some(&state), false).joint_torques, sent.joint_torques);
    it.supervisor.disarm();
    assert!(is_zero(&it.step(Some(&state), false)));
}

/// Each fault by its name, at its first tick.
#[test]
fn reasons_say_what_was_wrong() {
    type Spoil = fn(&mut RobotState<f64, 2>);
    let cases: [(Spoil, StopReason); 9] = [
        (|s| s.joint_angles[1][2] = f64::NAN, StopReason::Encoder { leg: 1, joint: 2 }),
        (|s| s.joint_angles[1][2] = 3.3, StopReason::Encoder { leg: 1, joint: 2 }),
        (|s| s.joint_rates[0][4] = 150.0, StopReason::Encoder { leg: 0, joint: 4 }),
        (|s| s.joint_angles[0][3] += 0.05, StopReason::Jump { leg: 0, joint: 3 }),
        (|s| s.position.y += 0.3, StopReason::BodyJump(Input::Position)),
        (|s| s.velocity.linear.x = 3.0, StopReason::BodyJump(Input::Position)),
        (|s| s.orientation.s = 0.5, StopReason::Tick(Fault::NotUnit(Input::Orientation))),
        (
            |s| s.orientation = Quaternion::from_array([0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0, 0.0]),
            StopReason::Tilt,
        ),
        (|s| s.position.x = f64::INFINITY, StopReason::Tick(Fault::NotFinite(Input::Position))),
    ];
    for (spoil, expected) in cases {
        let mut it = Loop::<f64>::armed();
        let mut bad = crouch();
        spoil(&mut bad);
        it.step(Some(&bad), false);
        assert_eq!(it.supervisor.reason(), Some(expected));
        assert!(!expected.to_string().is_empty());
    }
    let mut it = Loop::<f64>::new();
    it.supervisor.arm();
    it.step(Some(&crouch()), true);
    assert_eq!(it.supervisor.reason(), Some(StopReason::Overrun));
}

/// Motors brake, and never drive; the joint that is blamed is limp.
#[test]
fn a_stop_brakes() {
    let mut it = Loop::<f64>::armed();
    it.step(Some(&crouch()), true);
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let mut state = crouch();
    let mut braked = 0;
    for _ in 0..300 {
        for leg in 0..2 {
            for joint in 0..6 {
                let rate = rng.random_range(-3.0..3.0);
                state.joint_rates[leg][joint] = rate;
                state.joint_angles[leg][joint] += PERIOD * rate;
            }
        }
        // Of a joint whose two readings contradict each other nothing is believed.
        state.joint_rates[1][4] *= -1.0;
        let torques = it.step(Some(&state), false).joint_torques;
        for (torque, rate) in torques.iter().flatten().zip(state.joint_rates.iter().flatten()) {
            assert!(torque * rate <= 0.0);
            braked += u32::from(*torque != 0.0);
        }
        assert_eq!(torques[1][4], 0.0);
    }
    assert_eq!(braked, 300 * 11);

    let mut it = Loop::<f64>::armed();
    let mut bad = crouch();
    bad.joint_angles[0][1] = f64::NAN;
    it.step(Some(&bad), false);
    assert_eq!(it.supervisor.reason(), Some(StopReason::Encoder { leg: 0, joint: 1 }));
    for tick in 0..10 {
        let mut state = moving(tick);
        state.joint_rates[0][1] = 1.0;
        state.joint_angles[0][1] += PERIOD * f64::from(tick);
        let torques = it.step(Some(&state), false).joint_torques;
        assert_eq!(torques[0][1], 0.0);
        assert!(tick == 0 || torques[0][3] < 0.0);
    }
}

/// The least inertias of the biped are that, over postures at random, and damping that is held over a tick takes
/// no more than all of a motion: no eigenvalue of `h M⁻¹ D` is above one.
#[test]
fn the_stop_of_the_biped_is_stable() {
    let mut rng = Pcg64Mcg::seed_from_u64(1);
    let damping = biped::LIMITS.damping[0];
    let (mut least, mut largest) = ([f64::INFINITY; 6], 0.0_f64);
    for _ in 0..2000 {
        let mut q = [0.0; 19];
        q[3] = 1.0;
        for leg in q[7..].chunks_mut(6) {
            let ranges = [0.6, 1.8, 0.7, 2.4, 0.5, 1.2];
            for (angle, range) in leg.iter_mut().zip(ranges) {
                *angle = rng.random_range(-range..range);
            }
        }
        let rows = mass_matrix(&biped::TREE, &joint_poses(&biped::TREE, &q).expect("poses"));
        let inverse =
            DMatrix::from_fn(18, 18, |i, j| rows[i][j]).try_inverse().expect("positive definite");
        for joint in 0..12 {
            let inertia = 1.0 / inverse[(6 + joint, 6 + joint)];
            least[joint % 6] = least[joint % 6].min(inertia);
        }
        // d h, as the supervisor takes it for a period so long that all are at their bound.
        let held = |joint: usize| 0.5 * damping[joint % 6].inertia;
        let symmetric =
            DMatrix::from_fn(12, 12, |i, j| (held(i) * held(j)).sqrt() * inverse[(6 + i, 6 + j)]);
        largest = largest.max(symmetric.symmetric_eigenvalues().max());
    }
    println!("least inertias {least:?} kg·m²; largest eigenvalue {largest:.3}");
    for (least, damping) in least.iter().zip(damping) {
        let ratio = damping.inertia / least;
        assert!((0.9..1.03).contains(&ratio), "{} against {least}", damping.inertia);
    }
    assert!(largest <= 1.0, "{largest}");
}

/// What cannot be a limit is refused by leg, joint and field; a message's limits only tighten.
#[test]
fn limits_are_checked() {
    let refused = |change: fn(&mut SafetyLimits<f64, 2>)| {
        let mut limits = biped::LIMITS;
        change(&mut limits);
        Supervisor::new(limits, PERIOD).expect_err("no limits")
    };
    let (out, nan) = (LimitFault::OutOfRange, LimitFault::NotFinite);
    for (change, joint, field, fault) in [
        (
            (|l| l.joints[1][3].torque = f64::NAN) as fn(&mut SafetyLimits<f64, 2>),
            Some((1, 3)),
            LimitField::Torque,
            nan,
        ),
        (|l| l.joints[0][0].torque = -1.0, Some((0, 0)), LimitField::Torque, out),
        (|l| l.joints[1][5].angle = [1.0, 1.0], Some((1, 5)), LimitField::Angle, out),
        (|l| l.joints[1][5].angle[1] = f64::INFINITY, Some((1, 5)), LimitField::Angle, nan),
        (|l| l.joints[0][2].rate = 0.0, Some((0, 2)), LimitField::Rate, out),
        (|l| l.damping[0][2].damping = -1.0, Some((0, 2)), LimitField::Damping, out),
        (|l| l.damping[1][2].inertia = f64::NAN, Some((1, 2)), LimitField::Inertia, nan),
        (|l| l.stop_s = 0.0, None, LimitField::Stop, out),
        (|l| l.thresholds.least_upright = 1.0, None, LimitField::Upright, out),
        (|l| l.thresholds.gross = 0.5, None, LimitField::Gross, out),
        (|l| l.thresholds.drop = f64::NAN, None, LimitField::Drop, nan),
        (|l| l.thresholds.recovery_ticks = 0, None, LimitField::Recovery, out),
    ] {
        let error = refused(change);
        assert_eq!(error, LimitError { joint, field, fault });
        assert!(error.to_string().contains(&field.to_string()));
    }
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Supervisor::new(biped::LIMITS, period).is_err());
    }

    let own = biped::LIMITS;
    assert_eq!(own.allows(&own.joints, &own.thresholds), Ok(()));
    let (mut joints, mut thresholds) = (own.joints, own.thresholds);
    joints[1][3].torque = 100.0;
    joints[0][1].angle = [-1.0, 1.0];
    thresholds.drop = 0.05;
    thresholds.least_upright = 0.9;
    let mut supervisor = Supervisor::new(own, PERIOD).expect("limits");
    supervisor.tighten(&own, &joints, &thresholds, 2.0 * PERIOD).expect("tighter");
    let tight = *supervisor.limits();
    assert_eq!((tight.joints, tight.thresholds, tight.damping), (joints, thresholds, own.damping));
    assert!(supervisor.tighten(&own, &joints, &thresholds, f64::NAN).is_err());
    // From what was tightened the robot's own limits lead back.
    supervisor.tighten(&own, &own.joints, &own.thresholds, PERIOD).expect("its own");
    assert_eq!(*supervisor.limits(), own);
    let widens = |joint, field| Err(LimitError { joint, field, fault: LimitFault::Widens });
    joints[1][3].torque = 400.1;
    assert_eq!(own.allows(&joints, &thresholds), widens(Some((1, 3)), LimitField::Torque));
    joints[1][3].torque = 400.0;
    joints[0][1].angle = [-1.0, 3.3];
    assert_eq!(own.allows(&joints, &thresholds), widens(Some((0, 1)), LimitField::Angle));
    joints[0][1].angle = [-1.0, 1.0];
    thresholds.least_upright = 0.8;
    assert_eq!(own.allows(&joints, &thresholds), widens(None, LimitField::Upright));
    thresholds = own.thresholds;
    thresholds.bridged_ticks = 2;
    assert_eq!(own.allows(&joints, &thresholds), widens(None, LimitField::Bridged));
    thresholds = own.thresholds;
    thresholds.recovery_ticks = 9;
    assert_eq!(own.allows(&joints, &thresholds), widens(None, LimitField::Recovery));
}

/// Torques beyond the motors' are cut, and counted, and the sign is kept.
#[test]
fn large_torques_are_cut() {
    let mut it = Loop::<f64>::new();
    it.reference.position.z = 30.0;
    it.supervisor.arm();
    let out = it.step(Some(&crouch()), false);
    let asked = out.command.expect("a tick's answer").joint_torques;
    let mut cut = 0;
    for ((sent, asked), limit) in
        out.joint_torques[0].iter().zip(asked[0]).zip(it.limits.joints[0].map(|joint| joint.torque))
    {
        if asked.abs() > limit {
            assert_eq!(*sent, limit.copysign(asked));
            cut += 1;
        } else {
            assert_eq!(*sent, asked);
        }
    }
    assert!(cut > 0 && it.supervisor.cut_torques() >= cut);
    // For three ticks a motor may be at its limit.
    it.step(Some(&crouch()), false);
    assert_eq!(it.supervisor.mode(), Mode::Active);
    it.step(Some(&crouch()), false);
    assert!(matches!(it.supervisor.reason(), Some(StopReason::Saturated { .. })));
}

/// What one supervisor remembers lets another go on to the same bits, wherever it stops.
#[test]
fn memory_is_all_there_is() {
    let mut one = Loop::<f64>::armed();
    for tick in 0..150 {
        let mut other = Loop::<f64>::new();
        other.supervisor.remember(*one.supervisor.memory());
        let mut state = moving(tick);
        match tick {
            20 | 60 => state.velocity.linear.z = 0.4,
            100.. => state.joint_angles[0][3] = 1.0,
            _ => {}
        }
        let measured = (tick % 25 != 9).then_some(&state);
        let (a, b) = (one.step(measured, false), other.step(measured, false));
        assert_eq!(a.joint_torques, b.joint_torques);
        assert_eq!(one.supervisor.memory(), other.supervisor.memory());
    }
    assert!(one.supervisor.reason().is_some());
}

//! The supervisor: torques within limits whatever happens, and a stop that ends in zero.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot::Real;
use surefoot::balance::{
    Controller, Fault, LeggedRobot, Mode, Reference, RobotState, SafetyLimits, StopReason,
    Supervised, Supervisor,
};
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
    limits: SafetyLimits<T>,
}

impl<T: Real> Loop<T> {
    fn new(robot: &'static LeggedRobot<T, 2>) -> Self {
        let limits = SafetyLimits::biped();
        Self {
            controller: Controller::new(robot),
            reference: reference(),
            supervisor: Supervisor::new(limits, T::of(PERIOD)),
            limits,
        }
    }

    /// One step, whose torques are numbers within limits.
    fn step(&mut self, measured: Option<&RobotState<T, 2>>, overran: bool) -> Supervised<T, 2> {
        let out = self.supervisor.step(&self.controller, measured, &self.reference, overran);
        for leg in out.joint_torques {
            for (torque, limit) in leg.iter().zip(self.limits.joint_torque) {
                assert!(torque.abs() <= limit, "{} N·m", torque.to_f64());
            }
        }
        out
    }
}

/// Ten thousand ticks of good, bad, missing and late measurements, with orders in between.
fn whatever_happens<T: Real>(robot: &'static LeggedRobot<T, 2>) {
    let mut rng = Pcg64Mcg::seed_from_u64(11);
    let mut it = Loop::new(robot);
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
    }
    assert!(stops > 30, "{stops} stops are no test");
}

fn is_zero<T: Real>(out: &Supervised<T, 2>) -> bool {
    out.joint_torques.iter().flatten().all(|torque| *torque == T::zero())
}

#[test]
fn torques_stay_within_limits_whatever_happens() {
    whatever_happens(&ROBOT);
    whatever_happens(&ROBOT_F32);
}

/// The way round: standby, active, stopping, stopped, active.
#[test]
fn modes_follow_each_other() {
    let mut it = Loop::new(&ROBOT);
    let state = crouch();
    assert!(is_zero(&it.step(Some(&state), false)), "nothing moves before it is armed");
    it.supervisor.arm();
    let sent = it.step(Some(&state), false);
    assert_eq!(it.supervisor.mode(), Mode::Active);
    let command = sent.command.expect("a tick's answer");
    assert_eq!(sent.joint_torques, command.joint_torques);

    // One measurement missing is bridged, the second is not.
    assert_eq!(it.step(None, false).joint_torques, sent.joint_torques);
    let first = it.step(None, false);
    assert_eq!(it.supervisor.reason(), Some(StopReason::Stale));
    let mut before = first.joint_torques;
    for left in (0..it.limits.stop_ticks - 1).rev() {
        // Orders to begin anew wait until the torques are gone.
        it.supervisor.arm();
        let out = it.step(Some(&state), false);
        for (now, before) in out.joint_torques.iter().flatten().zip(before.iter().flatten()) {
            assert!(now.abs() <= before.abs(), "torques only fade");
        }
        before = out.joint_torques;
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

/// Each fault by its name.
#[test]
fn reasons_say_what_was_wrong() {
    type Spoil = fn(&mut RobotState<f64, 2>);
    let cases: [(Spoil, StopReason); 6] = [
        (|s| s.joint_angles[1][2] = f64::NAN, StopReason::Encoder { leg: 1, joint: 2 }),
        (|s| s.joint_rates[0][4] = 1e3, StopReason::Encoder { leg: 0, joint: 4 }),
        (|s| s.joint_angles[0][3] += 0.01, StopReason::Frozen { leg: 0, joint: 3 }),
        (
            |s| s.orientation.s = 0.5,
            StopReason::Tick(Fault::NotUnit(surefoot::balance::Input::Orientation)),
        ),
        (
            |s| s.orientation = Quaternion::from_array([0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0, 0.0]),
            StopReason::Tilt,
        ),
        (
            |s| s.position.x = f64::INFINITY,
            StopReason::Tick(Fault::NotFinite(surefoot::balance::Input::Position)),
        ),
    ];
    for (spoil, expected) in cases {
        let mut it = Loop::new(&ROBOT);
        it.supervisor.arm();
        it.step(Some(&crouch()), false);
        let mut bad = crouch();
        spoil(&mut bad);
        it.step(Some(&bad), false);
        assert_eq!(it.supervisor.reason(), Some(expected));
        assert!(!expected.to_string().is_empty());
    }
    let mut it = Loop::new(&ROBOT);
    it.supervisor.arm();
    it.step(Some(&crouch()), true);
    assert_eq!(it.supervisor.reason(), Some(StopReason::Overrun));
}

/// Torques beyond the motors' are cut, and counted, and the sign is kept.
#[test]
fn large_torques_are_cut() {
    let mut it = Loop::new(&ROBOT);
    it.reference.position.z = 30.0;
    it.supervisor.arm();
    let out = it.step(Some(&crouch()), false);
    let asked = out.command.expect("a tick's answer").joint_torques;
    let mut cut = 0;
    for ((sent, asked), limit) in
        out.joint_torques[0].iter().zip(asked[0]).zip(it.limits.joint_torque)
    {
        if asked.abs() > limit {
            assert_eq!(*sent, limit.copysign(asked));
            cut += 1;
        } else {
            assert_eq!(*sent, asked);
        }
    }
    assert!(cut > 0 && it.supervisor.cut_torques() >= cut);
}

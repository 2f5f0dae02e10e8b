//! What a program that balances the robot of the text must say: three ticks by the core itself.

use surefoot::balance::{
    Controller, Gains, Ground, LimitMemory, Reference, RobotState, SafetyLimits, Sole, Supervisor,
    WrenchLimits, limited_tick,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, Twist};
use surefoot_c::{SUREFOOT_JOINTS, SUREFOOT_LEGS};

/// On bent legs, as it stands in the scene of that name.
pub const POSITION: [f32; 3] = [-0.01, 0.0, 1.1];
const LEG_DEG: [f32; 6] = [0.0, 25.1202, 0.0, -61.6617, 0.0, 36.5415];

pub fn angles() -> [f32; SUREFOOT_JOINTS] {
    std::array::from_fn(|joint| LEG_DEG[joint % 6].to_radians())
}

/// Three ticks, by the core itself.
pub fn expected() -> Vec<f32> {
    const ROBOT: surefoot::balance::LeggedRobot<f32, 2> =
        surefoot::balance::LeggedRobot::<f64, 2>::new(&biped::TREE).to_f32();
    const LIMITS: SafetyLimits<f32, 2> = biped::LIMITS.to_f32();
    let share = 0.92_f32;
    let ends = |[low, high]: [f32; 2]| {
        let (middle, half) = (0.5 * (low + high), 0.5 * share * (high - low));
        [middle - half, middle + half]
    };
    let sole = Sole { x: ends([-0.2015, 0.0503]), y: ends([-0.05, 0.05]), z: -0.06 };
    let ground = Ground { least_force: 5.0, greatest_force: 1e4, friction: 0.3 };
    let torques = LIMITS.joints.map(|leg| leg.map(|joint| joint.torque));
    let limits = WrenchLimits::new(&ROBOT, &[sole; 2], ground, &torques).expect("limits");
    let mut controller = Controller::new(&ROBOT);
    controller.gains =
        Gains::diagonal([[50.0, 50.0, 200.0], [7.07, 7.07, 14.142], [50.0; 3], [7.07; 3]]);
    let reference = Reference::at_rest([0.0, 0.0, 1.1].into(), Quaternion::identity());
    let mut supervisor = Supervisor::new(LIMITS, 1e-3).expect("limits");
    let mut memory = LimitMemory::new();
    let angles = angles();
    let state = RobotState {
        position: POSITION.into(),
        orientation: Quaternion::identity(),
        velocity: Twist::from_array([0.0; 6]),
        joint_angles: std::array::from_fn(|leg| std::array::from_fn(|k| angles[6 * leg + k])),
        joint_rates: [[0.0; 6]; SUREFOOT_LEGS],
    };
    supervisor.arm();
    let tick = |_| {
        let supervised = supervisor.step_with(Some(&state), &reference, false, |now| {
            let feet = &[true; SUREFOOT_LEGS];
            Ok(limited_tick(&controller, &limits, now, &reference, feet, &mut memory)?.command)
        });
        supervised.joint_torques.as_flattened().to_vec()
    };
    (0..3).flat_map(tick).collect()
}

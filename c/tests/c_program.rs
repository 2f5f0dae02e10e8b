//! A program of C has the torques of the core, to the bit.

use std::path::{Path, PathBuf};
use std::process::Command;
use surefoot::balance::{
    Controller, Ground, LimitMemory, Reference, RobotState, SafetyLimits, Sole, Supervisor,
    WrenchLimits, limited_tick,
};
use surefoot::model::robots::biped;
use surefoot::spatial::{Quaternion, SymmetricMatrix3, Twist};
use surefoot_c::{SUREFOOT_JOINTS, SUREFOOT_LEGS};

/// Where `cargo xtask c` has put the library of the robot of the text.
fn library() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/c/biped/host")
}

/// On bent legs, as it stands in the scene of that name.
const POSITION: [f32; 3] = [-0.01, 0.0, 1.1];
const LEG_DEG: [f32; 6] = [0.0, 25.1202, 0.0, -61.6617, 0.0, 36.5415];

fn angles() -> [f32; SUREFOOT_JOINTS] {
    std::array::from_fn(|joint| LEG_DEG[joint % 6].to_radians())
}

/// Three ticks, by the core itself.
fn expected() -> Vec<f32> {
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
    let diagonal = |[x, y, z]: [f32; 3]| SymmetricMatrix3::diagonal(x, y, z);
    controller.gains.position = diagonal([50.0, 50.0, 200.0]);
    controller.gains.velocity = diagonal([7.07, 7.07, 14.142]);
    controller.gains.orientation = diagonal([50.0; 3]);
    controller.gains.angular_velocity = diagonal([7.07; 3]);
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

/// `0x1.8p+1` as C writes it.
fn hexadecimal(word: &str) -> f32 {
    let (sign, rest) = word.strip_prefix('-').map_or((1.0, word), |rest| (-1.0, rest));
    let digits = rest.strip_prefix("0x").expect("a hexadecimal number");
    let (mantissa, power) = digits.split_once('p').expect("a power of two");
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let number = u64::from_str_radix(&format!("{whole}{fraction}"), 16).expect("digits");
    let power: i32 = power.parse().expect("an exponent");
    let scaled = number as f64 * 2.0_f64.powi(power - 4 * fraction.len() as i32);
    sign * scaled as f32
}

#[test]
#[ignore = "needs the library that `cargo xtask c` builds"]
fn a_program_of_c_has_the_bits_of_the_core() {
    let (library, folder) = (library(), Path::new(env!("CARGO_TARGET_TMPDIR")));
    let program = folder.join("balance");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/balance.c");
    let compiled = Command::new("cc")
        .args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-I"])
        .args([&library, &source, &library.join("libsurefoot_c.a")])
        .args(["-lm", "-lpthread", "-ldl", "-o"])
        .arg(&program)
        .status()
        .expect("a compiler for C");
    assert!(compiled.success());
    let words = POSITION.iter().chain(&angles()).map(f32::to_string).collect::<Vec<_>>();
    let output = Command::new(&program).args(&words).output().expect("runs");
    let said = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let given: Vec<f32> = said.split_whitespace().map(hexadecimal).collect();
    let wanted = expected();
    assert_eq!(given.len(), 3 * SUREFOOT_JOINTS);
    for (number, (given, wanted)) in given.iter().zip(&wanted).enumerate() {
        assert_eq!(given.to_bits(), wanted.to_bits(), "torque {number}: {given} {wanted}");
    }
    assert!(wanted.iter().any(|torque| torque.abs() > 10.0));
    // What is no robot is refused.
    assert_eq!(Command::new(&program).status().expect("runs").code(), Some(2));
}

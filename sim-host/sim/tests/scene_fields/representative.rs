//! Scenes that have, among them, every field of every kind of scene in use: every joint, law, loop, contact, push, sensor
//! and motor, moving so that each matters.

/// A scene's name and its text.
pub type Named = (String, String);

/// How many steps of it show every field's effect.
pub const STEPS: u64 = 60;

/// All of them.
pub fn scenes() -> Vec<Named> {
    let read = |name: &str| {
        let path = format!("{}/../scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        std::fs::read_to_string(path).expect("a built-in scene")
    };
    let built_in =
        ["rigid-body", "n-pendulum", "biped-flight", "chain", "four-bar", "experiment-2"];
    let mut all: Vec<Named> =
        built_in.iter().map(|name| ((*name).to_owned(), read(name))).collect();
    all.push(("box-on-its-corners".into(), falling_box()));
    all.push(("every-joint".into(), EVERY_JOINT.into()));
    all.extend(loops());
    all.push(("welded-and-pushed".into(), read("experiment-1-welded") + PUSHES));
    let limited = "distribution = \"limited\"\ntorques_from";
    all.push(("limited".into(), read("experiment-2").replace("torques_from", limited)));
    all.push((
        "hardware".into(),
        read("experiment-1").replace("step_s = 2e-3", "step_s = 1e-3") + HARDWARE,
    ));
    all.push((
        "estimating".into(),
        read("experiment-1").replace("step_s = 2e-3", "step_s = 1e-3") + ESTIMATING,
    ));
    all.push((
        "differing".into(),
        read("experiment-1").replace("step_s = 2e-3", "step_s = 1e-3") + DIFFERING,
    ));
    all
}

/// A box that lands on four corners, sliding.
fn falling_box() -> String {
    let points = "[[0.1, 0.1, -0.1], [0.1, -0.1, -0.1], [-0.1, 0.1, -0.1], [-0.1, -0.12, -0.11]]";
    format!(
        r#"description = "a box that lands on its lower corners, sliding"
duration_s = 1.0
[integrator]
name = "variational"
step_s = 1e-3
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
switching = "within-the-step"
[mechanism.floor]
normal_stiffness = 75000.0
normal_damping = 200.0
tangential_stiffness = 70000.0
tangential_damping = 210.0
static_friction = 0.6
dynamic_friction = 0.4
zero_velocity_threshold = 1e-3
[[mechanism.bodies]]
name = "box"
mass_kg = 7.0
inertia_kg_m2 = [0.1, 0.12, 0.15]
center_m = [0.0, 0.0, 0.12]
orientation = [0.99995, 0.006, 0.008, 0.0]
joint = {{ kind = "floating", velocity_m_s = [0.4, -0.3, -1.0], angular_velocity_rad_s = [0.2, 0.3, 0.5] }}
contact_points_m = {points}
"#
    )
}

/// A tree afloat with a joint of each kind.
const EVERY_JOINT: &str = r#"description = "a tree afloat with a joint of each kind, laws and torques"
duration_s = 1.0
[integrator]
name = "variational"
step_s = 1e-3
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
[[mechanism.bodies]]
name = "base"
mass_kg = 5.0
inertia_kg_m2 = [0.1, 0.12, 0.15]
center_m = [0.0, 0.0, 1.0]
orientation = [1.0, 0.0, 0.0, 0.0]
joint = { kind = "floating", velocity_m_s = [0.1, 0.2, 0.3], angular_velocity_rad_s = [0.3, -0.2, 0.5] }
[[mechanism.bodies]]
name = "arm"
inboard = "base"
mass_kg = 1.0
inertia_kg_m2 = [0.01, 0.012, 0.003]
center_m = [0.2, 0.1, 1.3]
orientation = [0.96, 0.28, 0.0, 0.0]
joint = { kind = "revolute", point_m = [0.1, 0.0, 1.1], axis = [0.1, 1.0, 0.2], rate_rad_s = 2.0 }
torque = 1.5
law = { stiffness = 20.0, rest = 0.3, damping = 0.1, stops = { low = -0.01, high = 0.02, stiffness = 50.0 } }
[[mechanism.bodies]]
name = "slider"
inboard = "arm"
mass_kg = 0.5
inertia_kg_m2 = [0.004, 0.005, 0.006]
center_m = [0.3, 0.2, 1.4]
joint = { kind = "prismatic", axis = [1.0, 0.3, 0.2], rate_m_s = 0.4 }
torque = 2.0
law = { stiffness = 100.0, rest = -0.02, damping = 0.5, friction = 0.3, rotor_inertia = 0.01 }
[[mechanism.bodies]]
name = "cross"
inboard = "base"
mass_kg = 0.8
inertia_kg_m2 = [0.004, 0.005, 0.006]
center_m = [-0.2, 0.1, 0.8]
joint = { kind = "universal", point_m = [-0.1, 0.0, 0.9], axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], rates_rad_s = [1.0, -2.0] }
[[mechanism.bodies]]
name = "ball"
inboard = "base"
mass_kg = 0.7
inertia_kg_m2 = [0.004, 0.005, 0.007]
center_m = [0.0, -0.3, 0.9]
joint = { kind = "spherical", point_m = [0.0, -0.1, 1.0], angular_velocity_rad_s = [0.5, 0.7, -0.9] }
[[mechanism.bodies]]
name = "lid"
inboard = "ball"
mass_kg = 0.3
inertia_kg_m2 = [0.002, 0.003, 0.004]
center_m = [0.0, -0.35, 1.0]
joint = { kind = "fixed" }
"#;

/// A swing and a free body beside it, tied by a loop of each kind.
fn loops() -> Vec<Named> {
    [
        ("fixed", ""),
        ("revolute", ", point_m = [0.4, 0.1, 0.7], axis = [0.1, 1.0, 0.3]"),
        ("prismatic", ", axis = [0.8, 0.3, 1.0]"),
        ("universal", ", point_m = [0.4, 0.1, 0.7], axes = [[1.0, 0.0, 0.0], [0.0, 0.6, 0.8]]"),
        ("spherical", ", point_m = [0.4, 0.1, 0.7]"),
    ]
    .map(|(kind, fields)| {
        let text = format!(
            r#"description = "a swing and a free body, tied by a loop"
duration_s = 1.0
[integrator]
name = "variational"
step_s = 1e-3
[mechanism]
kind = "multibody"
gravity_m_s2 = 9.81
[[mechanism.bodies]]
name = "swing"
mass_kg = 1.0
inertia_kg_m2 = [0.01, 0.012, 0.015]
center_m = [0.3, 0.0, 0.9]
joint = {{ kind = "spherical", point_m = [0.0, 0.0, 1.0] }}
[[mechanism.bodies]]
name = "other"
mass_kg = 2.0
inertia_kg_m2 = [0.02, 0.022, 0.025]
center_m = [0.5, 0.2, 0.5]
joint = {{ kind = "floating" }}
[[mechanism.loops]]
between = ["other", "swing"]
joint = {{ kind = "{kind}"{fields} }}
"#
        );
        (format!("loop-{kind}"), text)
    })
    .into()
}

const PUSHES: &str = "
[[pushes]]
at_s = 0.0201
duration_s = 0.0007
force_n = [30.0, -20.0, 10.0]

[[pushes]]
at_s = 0.05
duration_s = 0.03
force_n = [10.0, 20.0, -15.0]
";

const HARDWARE: &str = "
[sensing]
state = \"noise\"
encoder_counts = 16384
gyroscope_noise = 1e-3
accelerometer_noise = 1e-2
correction_s = 0.5
seed = 3
backlash_deg = 0.1
imu_tilt_deg = [0.3, -0.2, 0.1]
gyroscope_bias = [0.001, 0.002, -0.001]
encoder_bias_deg = { left_knee = 0.2, right_hip_x = -0.1 }

[acting]
delay_s = 1.3e-3
lag_s = 1e-3
dead_zone_nm = 0.2
torque_limits_nm = [200, 300, 100, 150, 200, 200]

[acting.joint_stops]
left_deg = [[-1, 1], [30, 45], [-1, 1], [-140, -77], [-1, 1], [-45, 60]]
right_deg = [[-1, 1], [30, 45], [-1, 1], [-140, -77], [-1, 1], [-45, 60]]
stiffness = 2e3
";

const ESTIMATING: &str = "
[sensing]
state = \"estimate\"
encoder_counts = 65536
gyroscope_noise = 1e-4
accelerometer_noise = 1e-3
seed = 3
imu_tilt_deg = [0.3, -0.2, 0.1]
gyroscope_bias = [0.01, -0.01, 0.01]
accelerometer_bias = [0.1, -0.1, 0.1]
";

const DIFFERING: &str = "
[acting]
range_stiffness = 2e3

[terrain]
slope_deg = 3.0
uphill_deg = 20.0

[terrain.under.\"left foot\"]
height_m = 0.004
slope_deg = 2.0
uphill_deg = 70.0

[plant.bodies.\"central body\"]
mass_factor = 1.05
inertia_factor = 0.9
center_shift_m = [0.01, -0.004, 0.003]
added_mass_kg = 2.0
added_at_m = [0.05, 0.1, 0.2]

[plant.joints.left_knee]
shift_m = [0.002, 0.001, -0.003]
rotor_inertia_kg_m2 = 0.02
damping = 0.5
friction_nm = 1.5

[plant.every_joint]
shift_m = [0.001, 0.001, -0.001]
rotor_inertia_kg_m2 = 0.01
damping = 0.2
friction_nm = 0.5
";

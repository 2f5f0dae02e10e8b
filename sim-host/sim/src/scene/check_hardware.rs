//! What a scene's sensors, motors and joints must fulfil.

use super::check::wrong;
use super::{JointStops, Scene, SceneError, Sensing, StateSource};
use crate::robot::Contacts;

/// Longest delay, s. A robot falls over within it.
const LONGEST_DELAY: f64 = 1.0;
/// Most ticks that a delay may span: their torques are kept.
const MOST_DELAYED_TICKS: f64 = 1e5;
/// Fewest counts of an encoder a turn.
const FEWEST_COUNTS: u32 = 16;
/// Most that a sensor is turned or off, degrees; and a gyroscope, rad/s.
const MOST_ASKEW_DEG: f64 = 45.0;
const MOST_BIAS: f64 = 10.0;
/// Most that an accelerometer is off, m/s²: half of gravity.
const MOST_ACCELEROMETER_BIAS: f64 = 5.0;
/// Ticks a second that an estimator is made for.
const LEAST_ESTIMATOR_HZ: f64 = 20.0;
const MOST_ESTIMATOR_HZ: f64 = 1e5;
/// Longest lag of a motor, s.
const LONGEST_LAG: f64 = 10.0;

pub(super) fn check_hardware(scene: &Scene) -> Result<(), SceneError> {
    sensing(scene)?;
    acting(scene)?;
    scene.acting.joint_stops.map_or(Ok(()), |stops| joint_stops(scene, &stops))
}

fn sensing(scene: &Scene) -> Result<(), SceneError> {
    let sensing = &scene.sensing;
    if (1..FEWEST_COUNTS).contains(&sensing.encoder_counts) {
        let expected = format!("{FEWEST_COUNTS} counts or more, or 0 for exact encoders");
        return Err(wrong(scene, "sensing.encoder_counts", sensing.encoder_counts, expected));
    }
    for (field, noise) in [
        ("sensing.gyroscope_noise", sensing.gyroscope_noise),
        ("sensing.accelerometer_noise", sensing.accelerometer_noise),
    ] {
        if !(noise.is_finite() && noise >= 0.0) {
            return Err(wrong(scene, field, noise, "a finite density, zero or more"));
        }
    }
    let robot = scene.robot();
    for (name, bias) in &sensing.encoder_bias_deg {
        if !robot.columns.contains(name) {
            let expected = format!("a joint of the robot: {}", robot.columns.join(", "));
            return Err(wrong(scene, "sensing.encoder_bias_deg", name, expected));
        }
        if !(bias.abs() <= MOST_ASKEW_DEG) {
            let expected = format!("an angle of at most {MOST_ASKEW_DEG}° either way");
            let field = format!("sensing.encoder_bias_deg.{name}");
            return Err(wrong(scene, &field, bias, expected));
        }
    }
    if !(0.0..=MOST_ASKEW_DEG).contains(&sensing.backlash_deg) {
        let expected = format!("an angle of 0 to {MOST_ASKEW_DEG}°");
        return Err(wrong(scene, "sensing.backlash_deg", sensing.backlash_deg, expected));
    }
    if !sensing.imu_tilt_deg.iter().all(|angle| angle.abs() <= MOST_ASKEW_DEG) {
        let expected = format!("angles of at most {MOST_ASKEW_DEG}° either way");
        return Err(wrong(scene, "sensing.imu_tilt_deg", sensing.imu_tilt_deg, expected));
    }
    if !sensing.gyroscope_bias.iter().all(|rate| rate.abs() <= MOST_BIAS) {
        let expected = format!("rates of at most {MOST_BIAS} rad/s either way");
        return Err(wrong(scene, "sensing.gyroscope_bias", sensing.gyroscope_bias, expected));
    }
    if !sensing.accelerometer_bias.iter().all(|bias| bias.abs() <= MOST_ACCELEROMETER_BIAS) {
        let expected = format!("at most {MOST_ACCELEROMETER_BIAS} m/s² either way");
        let field = "sensing.accelerometer_bias";
        return Err(wrong(scene, field, sensing.accelerometer_bias, expected));
    }
    estimated(scene)?;
    let correction = sensing.correction_s;
    if !(correction.is_finite() && correction > 0.0) {
        let expected = "a finite time above zero, in seconds";
        return Err(wrong(scene, "sensing.correction_s", correction, expected));
    }
    Ok(())
}

/// What goes with an estimated state, and what does not.
fn estimated(scene: &Scene) -> Result<(), SceneError> {
    let sensing = &scene.sensing;
    if sensing.state != StateSource::Estimate {
        if sensing.accelerometer_bias != [0.0; 3] {
            let expected = "\"estimate\", as `accelerometer_bias` is given";
            return Err(wrong(scene, "sensing.state", sensing.state.name(), expected));
        }
        return Ok(());
    }
    if sensing.correction_s != Sensing::default().correction_s {
        let expected = "none, as the state is estimated";
        return Err(wrong(scene, "sensing.correction_s", sensing.correction_s, expected));
    }
    let rate = scene.controller.rate_hz;
    if !(LEAST_ESTIMATOR_HZ..=MOST_ESTIMATOR_HZ).contains(&rate) {
        let expected = format!(
            "{LEAST_ESTIMATOR_HZ} to {MOST_ESTIMATOR_HZ} ticks a second, as the state is estimated"
        );
        return Err(wrong(scene, "controller.rate_hz", rate, expected));
    }
    Contacts::of(&scene.robot()).map(|_| ()).map_err(|error| {
        let expected = format!("\"truth\" or \"noise\": {error}");
        wrong(scene, "sensing.state", sensing.state.name(), expected)
    })
}

fn acting(scene: &Scene) -> Result<(), SceneError> {
    let delay = scene.acting.delay_s;
    if !(0.0..=LONGEST_DELAY).contains(&delay) {
        let expected = format!("a delay of 0 to {LONGEST_DELAY} s");
        return Err(wrong(scene, "acting.delay_s", delay, expected));
    }
    if delay * scene.controller.rate_hz > MOST_DELAYED_TICKS {
        let expected = format!("a delay of at most {MOST_DELAYED_TICKS} ticks");
        return Err(wrong(scene, "acting.delay_s", delay, expected));
    }
    let lag = scene.acting.lag_s;
    if !(lag == 0.0 || (1e-6..=LONGEST_LAG).contains(&lag)) {
        let expected = format!("a time of 1e-6 to {LONGEST_LAG} s, or 0 for none");
        return Err(wrong(scene, "acting.lag_s", lag, expected));
    }
    let dead = scene.acting.dead_zone_nm;
    if !(dead.is_finite() && dead >= 0.0) {
        return Err(wrong(scene, "acting.dead_zone_nm", dead, "a finite torque, zero or more"));
    }
    if let Some(stiffness) = scene.acting.range_stiffness {
        if !(stiffness > 0.0 && stiffness <= 1e9) {
            let expected = "a stiffness above zero, at most 1e9 N·m/rad";
            return Err(wrong(scene, "acting.range_stiffness", stiffness, expected));
        }
        if scene.acting.joint_stops.is_some() {
            let expected = "none, as `joint_stops` are given";
            return Err(wrong(scene, "acting.range_stiffness", stiffness, expected));
        }
    }
    if let Some(limits) = scene.acting.torque_limits_nm
        && !limits.iter().all(|limit| limit.is_finite() && *limit > 0.0)
    {
        let expected = "six finite torques above zero, in N·m";
        return Err(wrong(scene, "acting.torque_limits_nm", limits, expected));
    }
    Ok(())
}

fn joint_stops(scene: &Scene, stops: &JointStops) -> Result<(), SceneError> {
    if !(stops.stiffness.is_finite() && stops.stiffness > 0.0) {
        let expected = "a finite stiffness above zero, in N·m/rad";
        return Err(wrong(scene, "acting.joint_stops.stiffness", stops.stiffness, expected));
    }
    // A robot from a file has none.
    let Some(initial) = scene.initial.legs() else { return Ok(()) };
    for (side, ends, angles) in [
        ("left", &stops.left_deg, &initial.left_leg_deg),
        ("right", &stops.right_deg, &initial.right_leg_deg),
    ] {
        for (joint, ([low, high], angle)) in ends.iter().zip(angles).enumerate() {
            let field = format!("acting.joint_stops.{side}_deg[{joint}]");
            if !(low.is_finite() && high.is_finite() && low < high) {
                let expected = "two finite angles, the lower first";
                return Err(wrong(scene, &field, [low, high], expected));
            }
            if !(low..=high).contains(&angle) {
                let expected = format!("stops around the angle at the start, {angle}°");
                return Err(wrong(scene, &field, [low, high], expected));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::builtin::BUILT_IN;
    use super::super::parse;

    /// Two tables at the end of a good scene, and words that the error must have.
    #[test]
    fn every_bad_value_is_refused_with_its_place() {
        let stops = |knee: &str, stiffness: &str| {
            format!(
                "[acting.joint_stops]\nstiffness = {stiffness}\n\
                 left_deg = [[-30, 30], [-30, 90], [-30, 30], [-140, -1], [-30, 30], [-45, 45]]\n\
                 right_deg = [[-30, 30], [-30, 90], [-30, 30], {knee}, [-30, 30], [-45, 45]]\n"
            )
        };
        let text = |table: &str| format!("{}\n{table}\n", BUILT_IN[0].text);
        for good in [
            stops("[-140, -1]", "2e3").as_str(),
            "[sensing]\nencoder_counts = 16\ngyroscope_noise = 0.0\nseed = 7",
            "[acting]\ndelay_s = 1.0",
            "[sensing]\nstate = \"truth\"\nencoder_counts = 64",
            "[sensing]\nstate = \"estimate\"\naccelerometer_bias = [0.1, 0.0, 0.0]",
        ] {
            parse("test", &text(good)).expect(good);
        }
        for (table, words) in [
            ("[sensing]\nencoder_counts = 15", ["sensing.encoder_counts", "15", "16 counts"]),
            ("[sensing]\nencoder_counts = -1", ["sensing.encoder_counts", "-1", "u32"]),
            ("[sensing]\ngyroscope_noise = -1e-4", ["sensing.gyroscope_noise", "-1e-4", "zero"]),
            ("[sensing]\naccelerometer_noise = inf", ["accelerometer_noise", "inf", "finite"]),
            ("[sensing]\ncorrection_s = 0.0", ["sensing.correction_s", "0.0", "above zero"]),
            ("[sensing]\ncorrection_s = nan", ["sensing.correction_s", "nan", "finite"]),
            ("[sensing]\nstate = \"guess\"", ["sensing.state", "guess", "estimate"]),
            (
                "[sensing]\naccelerometer_bias = [0.1, 0.0, 0.0]",
                ["sensing.state", "noise", "`accelerometer_bias` is given"],
            ),
            (
                "[sensing]\nstate = \"estimate\"\naccelerometer_bias = [0.1, 6.0, 0.0]",
                ["sensing.accelerometer_bias", "[0.1, 6.0, 0.0]", "5 m/s²"],
            ),
            (
                "[sensing]\nstate = \"estimate\"\ncorrection_s = 0.5",
                ["sensing.correction_s", "0.5", "the state is estimated"],
            ),
            ("[sensing]\nbits = 14", ["sensing.bits", "bits", "encoder_counts"]),
            ("[acting]\ndelay_s = -1e-3", ["acting.delay_s", "-1e-3", "0 to 1 s"]),
            ("[acting]\ndelay_s = 1.5", ["acting.delay_s", "1.5", "0 to 1 s"]),
            ("[acting]\ndelay_s = nan", ["acting.delay_s", "nan", "finite"]),
            (
                "[acting]\ntorque_limits_nm = [1, 1, 1, 0, 1, 1]",
                ["acting.torque_limits_nm", "[1, 1, 1, 0, 1, 1]", "above zero"],
            ),
            ("[acting]\ntorque_limits_nm = [1, 1]", ["acting", "torque_limits_nm", "length"]),
            (
                &stops("[-1, -140]", "2e3"),
                ["joint_stops.right_deg[3]", "[-1, -140]", "lower first"],
            ),
            (&stops("[-140, inf]", "2e3"), ["joint_stops.right_deg[3]", "inf", "finite"]),
            (&stops("[-70, -1]", "2e3"), ["joint_stops.right_deg[3]", "[-70, -1]", "-77.4595°"]),
            (&stops("[-140, -1]", "0.0"), ["joint_stops.stiffness", "0.0", "above zero"]),
        ] {
            let error = parse("test", &text(table)).expect_err(table).to_string();
            for word in words {
                assert!(error.contains(word), "{table}: {error}");
            }
        }
    }
}

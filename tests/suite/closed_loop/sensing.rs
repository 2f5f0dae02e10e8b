//! Sensors by themselves.

use nalgebra::Vector3;
use surefoot::spatial::Quaternion;
use surefoot_sim::closed_loop::Sensors;
use surefoot_sim::plant::PlantState;
use surefoot_sim::scene::Sensing;

const PERIOD: f64 = 2e-3;
fn noisy() -> Sensing {
    Sensing {
        gyroscope_noise: 1e-6,
        accelerometer_noise: 1e-5,
        correction_s: 0.5,
        seed: 3,
        ..Sensing::default()
    }
}

/// Names of twelve joints.
fn joints() -> Vec<String> {
    (0..12).map(|joint| format!("joint {joint}")).collect()
}

/// A state in motion, turned about no axis of the world.
fn state() -> PlantState {
    let axis = Vector3::new(0.3, -0.8, 0.5).normalize();
    let q = Quaternion::from_axis_angle(axis, 0.9);
    let mut positions: Vec<f64> = (0..19).map(|i| 0.2 * f64::from(i).sin()).collect();
    positions[3..7].copy_from_slice(&q.to_array());
    PlantState { positions, velocities: (0..18).map(|i| f64::from(i).cos()).collect() }
}

/// Joints that swing: angles are read to half a count, rates are mean rates to one count a tick, and nothing
/// else is touched.
#[test]
fn encoders_read_whole_counts_and_their_differences() {
    let sensing = Sensing { encoder_counts: 4096, ..Sensing::default() };
    let count = std::f64::consts::TAU / 4096.0;
    let mut sensors = Sensors::new(&sensing, PERIOD, &joints());
    let angle = |joint: usize, time: f64| 0.8 * (3.0 * time + joint as f64).sin();
    let rate = |joint: usize, time: f64| 2.4 * (3.0 * time + joint as f64).cos();
    let (mut largest, mut largest_of_rates) = (0.0_f64, 0.0_f64);
    for tick in 0..1000 {
        let time = f64::from(tick) * PERIOD;
        let mut truth = state();
        for joint in 0..12 {
            truth.positions[7 + joint] = angle(joint, time);
            truth.velocities[6 + joint] = rate(joint, time);
        }
        let seen = sensors.read(&truth);
        assert_eq!(seen.positions[..7], truth.positions[..7]);
        assert_eq!(seen.velocities[..6], truth.velocities[..6]);
        for joint in 0..12 {
            let read = seen.positions[7 + joint];
            assert!((read / count - (read / count).round()).abs() < 1e-9, "no whole count: {read}");
            largest = largest.max((read - angle(joint, time)).abs());
            // Before the first tick the joint is taken to have moved evenly.
            let mean = match tick {
                0 => rate(joint, 0.0),
                _ => (angle(joint, time) - angle(joint, time - PERIOD)) / PERIOD,
            };
            let error = (seen.velocities[6 + joint] - mean).abs();
            largest_of_rates = largest_of_rates.max(error);
        }
    }
    println!("{} and {} counts", largest / count, largest_of_rates * PERIOD / count);
    assert!((0.49..0.5 + 1e-9).contains(&(largest / count)));
    assert!((0.9..1.0 + 1e-9).contains(&(largest_of_rates * PERIOD / count)));
}

/// Errors of one reading: of orientation, velocity, position and angular velocity, world axes.
fn errors(seen: &PlantState, truth: &PlantState) -> [Vector3<f64>; 4] {
    let orientation = |state: &PlantState| {
        Quaternion::from_array(std::array::from_fn(|i| state.positions[3 + i]))
    };
    let part = |all: &[f64]| Vector3::from_row_slice(all);
    let (q, q_seen) = (orientation(truth), orientation(seen));
    assert!((q_seen.norm_squared() - 1.0).abs() < 1e-15);
    [
        q_seen.product(q.conjugate()).v * 2.0,
        q_seen.rotate(part(&seen.velocities[..3])) - q.rotate(part(&truth.velocities[..3])),
        part(&seen.positions[..3]) - part(&truth.positions[..3]),
        q.rotate(part(&seen.velocities[3..6]) - part(&truth.velocities[3..6])),
    ]
}

/// Over 4000 seeds, at the first tick and a time constant later, deviations are those of white noise through a
/// complementary filter; over one time constant errors keep the share of themselves that it leaves.
#[test]
fn errors_have_the_deviations_and_the_memory_of_their_equations() {
    let (n_g, n_a, t) =
        (noisy().gyroscope_noise, noisy().accelerometer_noise, noisy().correction_s);
    let stationary = (0.5 * t).sqrt();
    let expected =
        [n_g * stationary, n_a * stationary, 0.5 * n_a * t.powf(1.5), n_g / PERIOD.sqrt()];
    // ⟨x(0) x(T)⟩/⟨x²⟩: e⁻¹, for p of (s + 1/T)⁻² it is 2 e⁻¹; a reading's noise has no memory.
    let memory = [1.0, 1.0, 2.0, 0.0].map(|share: f64| share * (-1.0_f64).exp());
    let truth = state();
    const SEEDS: u64 = 4000;
    let ticks = (t / PERIOD).round() as usize;
    let mut squares = [[0.0; 4]; 2];
    let (mut products, mut sums) = ([0.0; 4], [0.0; 4]);
    for seed in 0..SEEDS {
        let mut sensors = Sensors::new(&Sensing { seed, ..noisy() }, PERIOD, &joints());
        let first = errors(sensors.read(&truth), &truth);
        for _ in 1..ticks {
            sensors.read(&truth);
        }
        let last = errors(sensors.read(&truth), &truth);
        for i in 0..4 {
            squares[0][i] += first[i].norm_squared();
            squares[1][i] += last[i].norm_squared();
            products[i] += first[i].dot(&last[i]);
            sums[i] += last[i].sum();
        }
    }
    let samples = 3.0 * SEEDS as f64;
    for i in 0..4 {
        let share = products[i] / samples / expected[i].powi(2);
        let ratios = squares.map(|sum| (sum[i] / samples).sqrt() / expected[i]);
        let mean = sums[i] / samples / expected[i];
        println!(
            "error {i}: deviations {ratios:.4?} of expected, memory {share:.4}, mean {mean:.4}"
        );
        // Standard deviations of these are 0.0065, 0.01 and 0.009.
        assert!(ratios.iter().all(|ratio| (ratio - 1.0).abs() < 0.026), "{i}: {ratios:?}");
        assert!((share - memory[i]).abs() < 0.04, "{i}: {share}");
        assert!(mean.abs() < 0.036, "{i}: {mean}");
    }
}

/// With noise that is constant over a tick, errors move as `θ' = ξ_g − θ/T`, `v' = ξ_a − v/T`, `p' = v − p/T`,
/// here integrated in small steps of second order: the gyroscope's noise is what it tells wrongly, the
/// accelerometer's what changes the velocity. A tick is a fifth of the time constant, so that each term counts.
#[test]
fn the_same_noise_is_told_and_integrated() {
    let truth = state();
    let t = 5.0 * PERIOD;
    let sensing = Sensing { correction_s: t, accelerometer_noise: 1e-3, ..noisy() };
    let mut sensors = Sensors::new(&sensing, PERIOD, &joints());
    let mut before = errors(sensors.read(&truth), &truth);
    let decay = (-PERIOD / t).exp();
    for _ in 0..100 {
        let now = errors(sensors.read(&truth), &truth);
        let pushing = (now[1] - before[1] * decay) / (t * (1.0 - decay));
        let rates =
            |[angle, v, p]: [Vector3<f64>; 3]| [now[3] - angle / t, pushing - v / t, v - p / t];
        let mut e = [before[0], before[1], before[2]];
        let h = PERIOD / 1000.0;
        for _ in 0..1000 {
            let first = rates(e);
            let half = std::array::from_fn(|i| e[i] + first[i] * (0.5 * h));
            let middle = rates(half);
            e = std::array::from_fn(|i| e[i] + middle[i] * h);
        }
        for (i, scale) in
            [now[3] * PERIOD, pushing * PERIOD, pushing * PERIOD * PERIOD].iter().enumerate()
        {
            let apart = (e[i] - now[i]).norm();
            assert!(apart < 1e-6 * scale.norm().max(1e-9), "{i}: {apart:e} {:e}", scale.norm());
        }
        before = now;
    }
}

#[test]
fn a_seed_is_a_noise() {
    let readings = |seed| {
        let sensing = Sensing { seed, encoder_counts: 1 << 14, ..noisy() };
        let mut sensors = Sensors::new(&sensing, PERIOD, &joints());
        let bits = |state: &PlantState| {
            let numbers = state.positions.iter().chain(&state.velocities);
            numbers.map(|x| x.to_bits()).collect::<Vec<_>>()
        };
        (0..50).map(|_| bits(sensors.read(&state()))).collect::<Vec<_>>()
    };
    assert_eq!(readings(1), readings(1));
    let (one, other) = (readings(1), readings(2));
    assert!(one.iter().zip(&other).all(|(a, b)| a != b));
}

#[test]
fn ideal_sensors_read_the_state() {
    let still = PlantState { positions: vec![0.1; 19], velocities: vec![-0.0; 18] };
    let mut sensors = Sensors::new(&Sensing::default(), PERIOD, &joints());
    for truth in [state(), still] {
        let seen = sensors.read(&truth);
        let bits = |all: &[f64]| -> Vec<u64> { all.iter().map(|x| x.to_bits()).collect() };
        assert_eq!(bits(&seen.positions), bits(&truth.positions));
        assert_eq!(bits(&seen.velocities), bits(&truth.velocities));
    }
}

/// A joint that swings to and fro: its encoder rests while the play is taken up, and reads the joint with half the
/// play, and its bias, else.
#[test]
fn encoders_rest_within_their_play() {
    let names = joints();
    let (play, bias) = (1.0_f64, 0.25_f64);
    let mut sensing = Sensing { backlash_deg: play, ..Sensing::default() };
    sensing.encoder_bias_deg.insert(names[2].clone(), bias);
    let mut sensors = Sensors::new(&sensing, PERIOD, &names);
    let (half, mut rested) = (0.5 * play.to_radians(), 0);
    let mut truth = state();
    for tick in 0..1000 {
        let time = 3.0 * f64::from(tick) * PERIOD;
        (truth.positions[9], truth.velocities[8]) = (0.3 * time.sin(), 0.9 * time.cos());
        let seen = sensors.read(&truth);
        let off = seen.positions[9] - bias.to_radians() - truth.positions[9];
        assert!(off.abs() <= half + 1e-15, "{off}");
        // After the first way ahead it is off by half the play, whenever it moves.
        if tick > 200 && seen.velocities[8] != 0.0 {
            assert!((off.abs() - half).abs() < 1e-15, "{off}");
        }
        rested += usize::from(seen.velocities[8] == 0.0);
    }
    // Of each turn of the motion: twice the play, near its ends.
    println!("rested at {rested} ticks of 1000");
    assert!((50..400).contains(&rested));
}

/// A sensor that is turned tells the pose and twist of the body as if it were the sensor.
#[test]
fn a_tilted_sensor_tilts_the_body() {
    let tilt = Vector3::new(1.5_f64, -0.4, 2.0);
    let sensing = Sensing {
        imu_tilt_deg: tilt.into(),
        gyroscope_bias: [0.01, 0.0, -0.02],
        correction_s: 0.5,
        ..Sensing::default()
    };
    let (truth, names) = (state(), joints());
    let mut sensors = Sensors::new(&sensing, PERIOD, &names);
    let seen = sensors.read(&truth);
    let turn = |state: &PlantState| {
        let q: [f64; 4] = std::array::from_fn(|i| state.positions[3 + i]);
        Quaternion::from_array(q).to_matrix()
    };
    let r = nalgebra::Rotation3::new(tilt.map(f64::to_radians)).into_inner();
    let bias = Vector3::new(0.01, 0.0, -0.02);
    let drift = nalgebra::Rotation3::new(bias * 0.5).into_inner();
    assert!((turn(seen) - turn(&truth) * r * drift).abs().max() < 1e-15);
    let part = |all: &[f64]| Vector3::from_row_slice(all);
    let omega = r.transpose() * part(&truth.velocities[3..6]) + bias;
    assert!((part(&seen.velocities[3..6]) - omega).norm() < 1e-15);
    let in_world =
        [turn(seen) * part(&seen.velocities[..3]), turn(&truth) * part(&truth.velocities[..3])];
    assert!((in_world[0] - in_world[1]).norm() < 1e-14);
    assert_eq!(
        (&seen.positions[..3], &seen.positions[7..]),
        (&truth.positions[..3], &truth.positions[7..])
    );
}

//! Readings that cannot be, a start that is wrong, switches that lie.

use super::motion::{GRAVITY, PERIOD, readings, soles, started, truth};
use nalgebra::Vector3;
use surefoot::estimate::{
    Concern, EstimateFault, EstimateInput, EstimateWatch, Estimator, EstimatorState, Floor, Health,
    OutOfBounds, Readings, StartPose,
};
use surefoot::spatial::Quaternion;

type Change = fn(&mut Readings<f64, 2>);

#[test]
fn unusable_readings_are_refused_and_change_nothing() {
    use EstimateFault::{NotUnit, NotUsable};
    use EstimateInput::{Accelerometer, FeetForce, FootOrientation, FootPosition, Gyroscope};
    let cases: [(Change, EstimateFault); 9] = [
        (|r| r.imu.accelerometer.x = f64::NAN, NotUsable(Accelerometer)),
        (|r| r.imu.accelerometer.y = 2e3, NotUsable(Accelerometer)),
        (|r| r.imu.gyroscope.z = f64::NEG_INFINITY, NotUsable(Gyroscope)),
        (|r| r.imu.gyroscope.z = 101.0, NotUsable(Gyroscope)),
        (|r| r.feet[1].position.y = f64::INFINITY, NotUsable(FootPosition(1))),
        (|r| r.feet[0].orientation = Quaternion::from_array([0.0; 4]), NotUnit(FootOrientation(0))),
        (|r| r.feet[1].orientation.s = f64::NAN, NotUnit(FootOrientation(1))),
        (|r| r.feet[1].orientation.s += 0.1, NotUnit(FootOrientation(1))),
        (|r| r.feet_force = Some(Vector3::new(0.0, f64::NAN, 1.0)), NotUsable(FeetForce)),
    ];
    let settings = soles();
    let mut state = started(&settings);
    for tick in 0..700 {
        settings.step(&mut state, &readings(tick)).expect("good readings");
        if tick != 0 && tick != 699 {
            continue;
        }
        for (number, (spoil, fault)) in cases.iter().enumerate() {
            let mut now = readings(tick + 1);
            spoil(&mut now);
            let before = state;
            assert_eq!(settings.step(&mut state, &now), Err(*fault), "case {number}");
            assert_eq!(state, before, "case {number}");
            let start = EstimatorState::start(&settings, &now, &StartPose::origin());
            assert_eq!(start, Err(*fault), "case {number}");
        }
    }
}

#[test]
fn a_start_in_motion_or_with_bad_settings_is_refused() {
    let settings = soles::<f64>();
    let start = |settings: &Estimator<f64, 2>, force: f64, pose: StartPose<f64>| {
        let mut now = readings(0);
        now.imu.accelerometer = Vector3::z() * force;
        EstimatorState::start(settings, &now, &pose).map(|_| ())
    };
    let origin = StartPose::origin();
    for force in [0.0, 0.4 * GRAVITY, 2.1 * GRAVITY] {
        assert_eq!(start(&settings, force, origin), Err(EstimateFault::NotAtRest), "{force}");
    }
    // Upside down is a start like any other.
    assert_eq!(start(&settings, -GRAVITY, origin), Ok(()));
    for pose in [
        StartPose { feet: Vector3::new(f64::NAN, 0.0, 0.0), ..origin },
        StartPose { heading: f64::INFINITY, ..origin },
    ] {
        let fault = EstimateFault::NotUsable(EstimateInput::StartPose);
        assert_eq!(start(&settings, GRAVITY, pose), Err(fault));
    }
    type Change = fn(&mut Estimator<f64, 2>);
    let bad: [(Change, &str); 8] = [
        (|s| s.period_s = 0.0, "period_s"),
        (|s| s.gravity = f64::NAN, "gravity"),
        (|s| s.noise.leg_position = 0.0, "noise"),
        (|s| s.noise.start[2] = f64::INFINITY, "noise"),
        (|s| s.gate = -1.0, "gate"),
        (|s| s.imu.rotation *= 2.0, "imu"),
        (|s| s.floor = Floor::LevelAt(f64::NAN), "floor"),
        (|s| s.feet = [None; 2], "feet"),
    ];
    for (spoil, name) in bad {
        let mut settings = settings;
        spoil(&mut settings);
        let fault = settings.check().expect_err(name);
        assert!(fault.to_string().contains(name), "{fault}");
        assert_eq!(start(&settings, GRAVITY, origin), Err(fault));
    }
}

/// Heading and the middle of the feet are what they are said to be.
#[test]
fn the_start_is_where_it_is_said_to_be() {
    let settings = soles::<f64>();
    let pose = StartPose { feet: Vector3::new(3.0, -2.0, 0.5), heading: 1.0 };
    let now = readings(0);
    let state = EstimatorState::start(&settings, &now, &pose).expect("at rest");
    let middle = (now.feet[0].position + now.feet[1].position) * 0.5;
    let at = state.position + state.orientation.rotate(middle);
    assert!((at - pose.feet).norm() < 1e-12, "{at}");
    // The biases tilt it by 0.8°, the heading about that axis less.
    let ahead = state.orientation.rotate(Vector3::x());
    assert!((ahead.y.atan2(ahead.x) - 1.0).abs() < 1e-3, "{ahead}");
    let up = state.orientation.rotate(now.imu.accelerometer.normalize());
    assert!((up - Vector3::z()).norm() < 1e-12, "{up}");
}

/// A robot that stands still, its accelerometer turned so much about x against gravity, then told the truth.
fn wrong_start(degrees: f64) -> (f64, Option<Concern>, Option<Concern>) {
    let settings = soles::<f64>();
    let wrong = Quaternion::from_axis_angle(Vector3::x(), degrees.to_radians());
    let mut first = readings(0);
    first.imu.accelerometer = wrong.rotate(Vector3::new(0.0, 0.0, GRAVITY));
    let mut state =
        EstimatorState::start(&settings, &first, &StartPose::origin()).expect("at rest");
    let (mut concern, mut stop, mut watch) = (None, None, EstimateWatch::new());
    for tick in 0..3000 {
        let now = readings(tick);
        let report = settings.step(&mut state, &now).expect("good readings");
        let q = report.estimate.orientation;
        assert!(q.norm_squared().is_finite());
        stop = stop.or(watch.after(&report.health, PERIOD));
        if let Some(worst) = report.health.worst {
            concern.get_or_insert(worst.concern);
        }
    }
    let q = state.orientation.product(truth(2999.0 * PERIOD).orientation.conjugate());
    let tilt = q.rotate(Vector3::z()).z.acos().to_degrees();
    (tilt, concern, stop)
}

/// 10° are never recovered, and said; 1° is neither.
#[test]
fn a_wrong_start_is_found_by_the_bias_that_it_takes() {
    let (tilt, concern, stop) = wrong_start(1.0);
    assert!(tilt < 1.0 && concern.is_none() && stop.is_none(), "{tilt}° {concern:?}");
    for degrees in [10.0, 20.0, 45.0] {
        let (tilt, concern, stop) = wrong_start(degrees);
        println!("{degrees}: {tilt} {concern:?}");
        assert!(tilt > 1.0, "{tilt}°");
        assert_eq!(concern, Some(Concern::AccelerometerBias));
        println!("stopped for {stop:?}");
        assert!(stop.is_some(), "{degrees}°");
    }
}

/// One tick in doubt is forgotten; more than 0.1 s of it are not, nor every second tick, nor a bound that is a time.
#[test]
fn doubts_that_stay_stop_the_robot() {
    let health = |concern: Option<Concern>| Health {
        worst: concern.map(|concern| OutOfBounds { concern, size: 2.0, limit: 1.0 }),
        count: u8::from(concern.is_some()),
    };
    let slip = Some(Concern::FootPosition(1));
    let after = |pattern: &[Option<Concern>]| {
        let mut watch = EstimateWatch::new();
        let ticks = pattern.iter().cycle().take(1000);
        ticks
            .enumerate()
            .find_map(|(n, concern)| Some((n, watch.after(&health(*concern), PERIOD)?)))
    };
    assert_eq!(after(&[None]), None);
    // Half as fast forgotten as learnt.
    assert_eq!(after(&[slip, None, None]), None);
    // 0.1 s are 50 ticks, of doubles that are a little more or less.
    let (ticks, concern) = after(&[slip]).expect("a stop");
    assert!((49..=51).contains(&ticks) && Some(concern) == slip, "{ticks}");
    let (ticks, _) = after(&[slip, None]).expect("a stop");
    assert!((190..=200).contains(&ticks), "{ticks}");
    for concern in [Concern::Switch(0), Concern::Airborne, Concern::Covariance] {
        assert_eq!(after(&[Some(concern)]), Some((0, concern)));
    }
}

/// What `concerns` of a log that is spoilt from 1.2 s on says, in the order in which it is said first.
fn concerns(spoil: impl Fn(u32, &mut Readings<f64, 2>)) -> Vec<Concern> {
    let settings = soles::<f64>();
    let mut state = started(&settings);
    let mut found = Vec::new();
    for tick in 0..2000 {
        let mut now = readings(tick);
        spoil(tick, &mut now);
        let report = settings.step(&mut state, &now).expect("good readings");
        assert_eq!(report.health.worst.is_none(), report.health.is_good());
        if let Some(worst) = report.health.worst {
            assert!(worst.size > worst.limit, "{worst}");
            if !found.contains(&worst.concern) {
                found.push(worst.concern);
            }
        }
        let estimate = report.estimate;
        assert!(estimate.position.iter().all(|x| x.is_finite()) && estimate.velocity.is_finite());
    }
    found
}

#[test]
fn switches_that_lie_and_feet_that_slip_are_said() {
    assert_eq!(concerns(|_, _| {}), []);
    // Foot 0 swings from tick 500 to 700; its switch says otherwise while it is lifted by 10 cm.
    let lies = concerns(|tick, now| {
        if (500..700).contains(&tick) {
            now.feet[0].is_pressed = true;
            now.feet[0].is_planned = true;
            now.feet[0].position.z += 0.1 * (f64::from(tick - 500) * 0.0157).sin();
        }
    });
    // It creeps within what feet may, and shows as a bias that no accelerometer has.
    assert_eq!(lies.first(), Some(&Concern::AccelerometerBias), "{lies:?}");
    // The same under a planner that knows better: no harm, and said after 0.2 s.
    let planned = concerns(|tick, now| {
        if (500..700).contains(&tick) {
            now.feet[0].is_pressed = true;
            now.feet[0].is_planned = false;
            now.feet[0].position.z += 0.1;
        }
    });
    assert_eq!(planned, [Concern::Switch(0)]);
    // A switch that is dead.
    let dead = concerns(|_, now| now.feet[1].is_pressed = false);
    assert_eq!(dead.first(), Some(&Concern::Switch(1)), "{dead:?}");
    // A slip by 4 cm within 20 ms.
    let slip = concerns(|tick, now| {
        if tick >= 400 {
            now.feet[1].position.x += 0.04 * (f64::from(tick - 400) / 10.0).min(1.0);
        }
    });
    assert_eq!(slip.first(), Some(&Concern::FootPosition(1)), "{slip:?}");
    // Nobody stands.
    let none = concerns(|tick, now| {
        for foot in &mut now.feet {
            foot.is_pressed &= tick < 600;
            foot.is_planned = foot.is_pressed;
        }
    });
    assert!(none.contains(&Concern::Airborne), "{none:?}");
}

//! Motors by themselves.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use surefoot_sim::closed_loop::Motors;
use surefoot_sim::scene::Acting;

/// Seconds that two intervals share.
fn shared(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[1].min(b[1]) - a[0].max(b[0])).max(0.0)
}

/// For delays of no and any number of steps and ticks, each step has the mean of a signal that is held from
/// tick to tick and comes late, by its definition; and the impulse of a joint is that of its command.
#[test]
fn steps_have_the_mean_of_the_delayed_signal() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    for steps_per_tick in [1, 2, 5] {
        let step = 1e-3;
        let tick = step * steps_per_tick as f64;
        for delay_s in [0.0, 0.2e-3, 1e-3, 1.5e-3, 2e-3, 3.7e-3, 5e-3, 10.01e-3] {
            let acting = Acting { delay_s, ..Acting::default() };
            let mut motors = Motors::new(&acting, step, steps_per_tick, 12);
            let mut commands: Vec<[f64; 12]> =
                (0..30).map(|_| std::array::from_fn(|_| random.random_range(-1.0..1.0))).collect();
            // What is on its way at the end arrives as well.
            commands.extend([[0.0; 12]; 12]);
            let mut impulse = [0.0; 12];
            for (number, command) in commands.iter().enumerate() {
                motors.command(command, number as f64 * tick);
                for within in 0..steps_per_tick {
                    let given = motors.over_step(within);
                    let begin = number as f64 * tick + within as f64 * step - delay_s;
                    for joint in 0..12 {
                        let mean: f64 = commands
                            .iter()
                            .enumerate()
                            .map(|(k, u)| {
                                let held = [k as f64 * tick, (k + 1) as f64 * tick];
                                u[joint] * shared(held, [begin, begin + step]) / step
                            })
                            .sum();
                        let (m, d) = (steps_per_tick, delay_s);
                        assert!((given[joint] - mean).abs() < 1e-10, "{m} {d} {number} {within}");
                        impulse[joint] += given[joint] * step;
                    }
                }
            }
            for (joint, impulse) in impulse.iter().enumerate() {
                let asked: f64 = commands.iter().map(|u| u[joint] * tick).sum();
                assert!((impulse - asked).abs() < 1e-12);
            }
        }
    }
}

/// What the motors give varies evenly with the delay, across whole steps and ticks.
#[test]
fn torques_are_continuous_in_the_delay() {
    let given = |delay_s: f64| {
        let mut motors = Motors::new(&Acting { delay_s, ..Acting::default() }, 1e-3, 2, 12);
        for number in 0..8 {
            motors.command(&[f64::from(number * number); 12], 2e-3 * f64::from(number));
        }
        [motors.over_step(0)[0], motors.over_step(1)[0]]
    };
    for number in 0..1000 {
        let delay = f64::from(number) * 1e-5;
        let (a, b) = (given(delay), given(delay + 1e-5));
        for step in 0..2 {
            // A hundredth of a step of at most 49 − 36 N·m.
            assert!((a[step] - b[step]).abs() < 0.13 + 1e-9, "{delay} {a:?} {b:?}");
        }
    }
}

/// Cut before they are late: a mean of cut torques, not a cut mean.
#[test]
fn limits_are_of_the_signal() {
    let acting = Acting {
        delay_s: 0.5e-3,
        torque_limits_nm: Some([1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
        ..Acting::default()
    };
    let mut motors = Motors::new(&acting, 1e-3, 1, 12);
    motors.command(&[-10.0; 12], 0.0);
    motors.command(&[3.5; 12], 1e-3);
    let given = motors.over_step(0);
    for joint in 0..12 {
        let limit = (joint % 6 + 1) as f64;
        assert_eq!(given[joint], 0.5 * (3.5_f64.min(limit) - limit));
    }
    // 12 at first, then the three weakest of each leg.
    assert_eq!((motors.cut().joint_ticks, motors.cut().first_s), (18, Some(0.0)));
}

/// A step of the command, half a millisecond late and lost in part: what is given over each step is the mean of
/// `(u − d)(1 − e^(−t/T))`.
#[test]
fn lagging_motors_follow_in_their_time() {
    let (lag, h, dead) = (4e-3, 1e-3, 0.5);
    let acting = Acting { lag_s: lag, dead_zone_nm: dead, ..Acting::default() };
    let mut motors = Motors::new(&acting, h, 2, 3);
    let mut worst = 0.0_f64;
    for tick in 0..20 {
        motors.command(&[3.0, -3.0, 0.4], f64::from(tick) * 2.0 * h);
        for step in 0..2 {
            let from = f64::from(2 * tick + step) * h;
            let to = from + h;
            let mean = 2.5 * (1.0 + lag * ((-to / lag).exp() - (-from / lag).exp()) / h);
            let given = motors.over_step(step as usize);
            worst = worst.max((given[0] - mean).abs()).max((given[1] + mean).abs());
            assert_eq!(given[2], 0.0);
            motors.advance(step as usize);
        }
    }
    println!("{worst:e}");
    assert!(worst < 1e-14);
}

//! Logging costs the tick nothing.

use crate::bench::{Bench, Target, Torques, emulator};

/// Ticks of Experiment 1 with one image, and the bytes that it has logged.
fn play(image: &str) -> (Vec<Torques>, u64) {
    let emulator = emulator(image);
    let output = emulator.output();
    let mut bench = Bench::new(Target::connect(emulator).expect("a firmware that answers"));
    let ticks = (0..500).map(|_| bench.tick(|_| {})).collect();
    (ticks, output.metadata().expect("it is there").len())
}

/// One image logs nothing, the other every tick in full: the torques are the same, and costs and
/// latencies within 1 %.
#[test]
#[ignore = "needs the firmware's images: `cargo xtask test --only firmware`"]
fn a_tick_costs_the_same_with_every_message_logged() {
    let (silent, nothing) = play("silent");
    let (logging, bytes) = play("emulation");
    println!("logged {bytes} bytes in 500 ticks");
    assert_eq!(nothing, 0);
    assert!(bytes > 500 * 60, "twelve torques a tick at least");
    let mut largest = 0.0_f64;
    for (silent, logging) in silent.iter().zip(&logging) {
        assert_eq!(silent.joint_torques, logging.joint_torques);
        let change = f64::from(logging.cost) / f64::from(silent.cost) - 1.0;
        largest = largest.max(change.abs());
        assert!(change.abs() < 0.01, "{} against {} instructions", logging.cost, silent.cost);
        let late = logging.latency.abs_diff(silent.latency);
        assert!(f64::from(late) < 0.01 * f64::from(silent.cost), "{late} instructions later");
    }
    println!("largest change of a tick's cost: {:.3} %", 100.0 * largest);
}

//! The example for other simulators, and the table in its document, name the messages as they are numbered here.

use surefoot_link::{
    Acknowledged, FromTarget, Joints, RobotId, Sender, Sensors, ToTarget, VERSION, frame_bytes,
};

const JOINTS: usize = 12;
type Order = ToTarget<JOINTS>;

fn read(path: &str) -> String {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The number of a message's kind: its first byte.
fn kind<M: serde::Serialize>(message: &M) -> u8 {
    let mut wire = [0; frame_bytes(JOINTS)];
    let frame = Sender::new(0).encode(message, &mut wire).expect("it fits");
    let plain = cobs::decode_vec(&frame[..frame.len() - 1]).expect("a frame");
    // Behind version, session, and the number 0.
    plain[6]
}

#[test]
fn messages_are_numbered_as_the_example_says() {
    let sensors = Sensors {
        position: [0.0; 3],
        orientation: [1.0, 0.0, 0.0, 0.0],
        velocity: [0.0; 6],
        joint_angles: [0.0; JOINTS].into(),
        joint_rates: [0.0; JOINTS].into(),
        contacts: 0,
        forces: Joints::new([0.0; 8], 0),
    };
    let arm = kind(&Order::Arm(RobotId { joints: 12, fingerprint: 0 }));
    let disarm = kind(&Order::Disarm);
    let sensors = kind(&Order::Sensors { taken_us: 0, sensors });
    let acknowledged = kind(&FromTarget::<JOINTS>::Acknowledged(Acknowledged::Done));
    let script = read("tests/peers/lock_step.py");
    for line in [
        format!("VERSION = {VERSION}  # of"),
        format!("ARM, DISARM, SENSORS = {arm}, {disarm}, {sensors}\n"),
        format!("IDENTITY, ACKNOWLEDGED, TORQUES = 0, {acknowledged}, 2\n"),
    ] {
        assert!(script.contains(&line), "lock_step.py should have: {line}");
    }
    let document = read("docs/lock-step.md");
    for row in [
        format!("| `Arm` | {arm} |"),
        format!("| `Disarm` | {disarm} |"),
        format!("| `Sensors` | {sensors} |"),
        format!("| `Acknowledged` | {acknowledged} |"),
    ] {
        assert!(document.contains(&row), "docs/lock-step.md should have: {row}");
    }
}

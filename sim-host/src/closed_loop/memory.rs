//! What sensors and motors must remember for a run to be taken up again to the same bits.

use super::{Motors, Sensors};
use crate::record::HardwareMemory;
use crate::scene::Scene;

/// What they remember; `None` where all of them are ideal.
pub(super) fn memory(scene: &Scene, sensors: &Sensors, motors: &Motors) -> Option<HardwareMemory> {
    let is_ideal = scene.sensing.is_ideal() && scene.acting.is_ideal();
    (!is_ideal)
        .then(|| HardwareMemory { encoder_counts: sensors.counts(), torques: motors.pending() })
}

/// Goes on with it at tick `first`; `false` if it is of other sensors or motors.
pub(super) fn remember(
    scene: &Scene,
    memory: Option<&HardwareMemory>,
    first: u64,
    sensors: &mut Sensors,
    motors: &mut Motors,
) -> bool {
    let Some(memory) = memory else {
        return scene.sensing.is_ideal() && scene.acting.is_ideal();
    };
    let joints = sensors.joints();
    if memory.encoder_counts.as_ref().is_some_and(|counts| counts.len() != joints) {
        return false;
    }
    sensors.skip(first, memory.encoder_counts.as_deref());
    // Before the first tick encoders have nothing to remember.
    let same_encoders = scene.sensing.encoder_counts > 0 && first > 0;
    same_encoders == memory.encoder_counts.is_some() && motors.resume(&memory.torques)
}

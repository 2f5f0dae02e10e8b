//! What sensors and motors must remember for a run to be taken up again to the same bits.

use super::{Motors, Sensors};
use crate::record::HardwareMemory;
use crate::scene::Scene;

/// What they remember; `None` where all of them are ideal.
pub(super) fn memory(scene: &Scene, sensors: &Sensors, motors: &Motors) -> Option<HardwareMemory> {
    let is_ideal = scene.sensing.is_ideal() && scene.acting.is_ideal();
    (!is_ideal).then(|| HardwareMemory {
        encoders: sensors.memory(),
        torques: motors.pending(),
        lagging: motors.lagging(),
    })
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
    if memory.encoders.as_ref().is_some_and(|encoders| !encoders.fits(joints)) {
        return false;
    }
    sensors.skip(first, memory.encoders.as_ref());
    // Before the first tick encoders have nothing to remember.
    let same_encoders = sensors.has_encoders() && first > 0;
    same_encoders == memory.encoders.is_some()
        && motors.resume(&memory.torques, memory.lagging.as_deref())
}

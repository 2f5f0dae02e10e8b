//! From a scene to the smallest plant that plays it.

use crate::plant::{Additions, OnFloor, Plant, StepFailure, Struck, Variational, Welded};
use crate::scene::{Block, Feet, Outline, Scene};
use surefoot_mechanics::integrators::Method;

/// No contact code where feet are welded, no block and no stops where the scene has none, no more bodies than
/// matter.
///
/// # Errors
/// A [`StepFailure`] for a start that is no configuration, or what the model cannot do.
pub fn plant(scene: &Scene) -> Result<Box<dyn Plant>, StepFailure> {
    let (start, step) = (scene.start(), scene.integrator.step_s);
    let robot = scene.robot();
    let stops = scene.acting.stops(&robot);
    let block = scene.block.as_ref().map(Block::thrown);
    if scene.integrator.name == Method::Variational {
        let additions = Additions {
            model: scene.rung().model,
            stops,
            block,
            planes: scene.terrain.planes(&robot, &start),
            differences: scene.plant.differences(&robot),
        };
        return Ok(Box::new(match &scene.feet {
            Feet::Floor { floor, .. } => {
                Variational::on_floor(&robot, &start, step, *floor, &additions)?
            }
            Feet::Welded {} => Variational::welded(&robot, &start, step, &additions)?,
        }));
    }
    let (robot, floor): (Box<dyn Plant>, _) = match &scene.feet {
        Feet::Floor { outline, floor } => {
            let sole = outline.unwrap_or(Outline::A).sole();
            let robot = OnFloor::new(&start, *floor, &sole).with_stops(stops);
            (Box::new(robot), Some(*floor))
        }
        Feet::Welded {} => (Box::new(Welded::new(&start)?.with_stops(stops)), None),
    };
    Ok(match block {
        Some(block) => Box::new(Struck::new(robot, block, floor)),
        None => robot,
    })
}

//! The residual of the equations of motion, and what is made of it.

mod observer;
mod oracle;
mod residual;
mod ticks;

use surefoot::spatial::{Pose, Wrench};

/// A wrench in world axes in those of a body.
fn in_axes(body: &Pose<f64>, w: Wrench<f64>) -> Wrench<f64> {
    Wrench { force: body.rotation.tr_mul(&w.force), torque: body.rotation.tr_mul(&w.torque) }
}

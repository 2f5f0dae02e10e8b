//! Bodies and joints under methods on the differential equations of joint coordinates, by `core`'s forward
//! dynamics.

mod description;
mod equations;
mod motion;

pub(super) use motion::OnTree;

//! Robots as constant data: trees of bodies and joints, checked when they are compiled.
//!
//! A tree is described in its home configuration (all joint coordinates zero), every length and
//! direction in one frame, as §4.1 describes its biped: where the centres of mass are, where the
//! joints are, which way their axes point. [`Tree::new`] is a `const fn` that derives all constants
//! the algorithms need, so that they lie in flash, and that refuses an ill-formed tree at compile
//! time. [`Tree::try_new`] does so for links that are known at run time, with a [`TreeFault`].

mod body_check;
mod body_shape;
mod compile_time;
mod fault;
mod general_joint;
mod joint;
mod limbs;
mod link;
mod node;
pub mod robots;
mod single_precision;
mod tree;

pub use body_shape::BodyShape;
pub(crate) use compile_time::square_root;
pub use fault::{LinkFault, TreeFault};
pub use general_joint::{GeneralJoint, GeneralMotion};
pub use joint::{Axis, JointKind};
pub use link::Link;
pub(crate) use node::{InertiaShape, Node};
pub(crate) use single_precision::vector_to_f32;
pub use tree::Tree;

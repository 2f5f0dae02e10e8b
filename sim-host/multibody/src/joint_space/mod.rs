//! The differential equations of bodies and joints of any number, in the joint coordinates of their tree, with what
//! acts beside the tree: closed loops, springs between points, wheels that roll without slip.
//!
//! # Notation
//! `q, u` joint coordinates and generalized velocities; `M` mass matrix; `Q` forces, gyroscopic ones included;
//! `J` rows of the constraints' rates (those of loops, differentiated, and those of rolling, which have no position);
//! `γ` what is left of their second derivative where `u̇ = 0`; `M = LᵀL` the factor that has no entries but those of the
//! tree (Featherstone 2008, §6.5):
//! ```text
//! M u̇ = Q + Jᵀ λ,   J u̇ + γ = 0                                                                        (1)
//! Y = L⁻ᵀ Jᵀ,  z = L u̇:   z = L⁻ᵀ Q + Y w,   YᵀY w = −γ − Yᵀ L⁻ᵀ Q                                      (2)
//! ```
//! `YᵀY` has an entry for two constraints only if they have a joint in common: a row of windows costs as many operations
//! as it has windows. One refinement gives the accuracy of an orthogonal factorization ("corrected seminormal
//! equations", Björck 1987). Rows that others imply are found where a step begins, on the manifold, and left out until
//! it ends: at a method's stages, which are off the manifold by the method's error, none of them is implied.

mod equations;
mod joint;
mod kinematics;
mod mass;
mod rows;
mod solve;
#[cfg(test)]
mod tests;

pub use equations::{JointSpace, JointSpaceFault, SettleFault};

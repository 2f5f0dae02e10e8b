//! Chapter 3: kinematics and dynamics of trees.

mod closed_forms;
mod faults;
mod identities;
mod momentum;
mod rotors;
mod trees;
mod vectors;
mod virtual_work;

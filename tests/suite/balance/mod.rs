//! Chapter 4: the balance controller.

mod contact_patches;
mod contact_wrenches;
mod distribution;
mod faults;
mod ground;
mod limited;
mod orientation;
mod supervisor;
mod vectors;
mod whole_body;
mod workspace;

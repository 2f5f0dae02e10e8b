//! Chapter 4: the balance controller.

mod distribution;
mod faults;
mod ground;
mod orientation;
mod supervisor;
mod vectors;
mod workspace;

//! Chapter 4: the balance controller.

mod distribution;
mod faults;
mod orientation;
mod supervisor;
mod vectors;
mod workspace;

//! Chapter 4: the balance controller.

mod distribution;
mod faults;
mod orientation;
mod vectors;
mod workspace;

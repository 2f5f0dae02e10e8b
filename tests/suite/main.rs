//! The suite: every algorithm against something that was not written here.

mod balance;
mod certify;
mod closed_loop;
mod documents;
mod dynamics;
mod estimate;
mod mechanics;
mod multibody;
mod precision;
mod qp;
mod spatial;
mod walk;

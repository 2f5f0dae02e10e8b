//! The residual of the equations of motion, and what is made of it.

mod observer;
mod oracle;
mod residual;
mod ticks;

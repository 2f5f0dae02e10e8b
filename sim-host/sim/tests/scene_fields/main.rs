//! Fields of scenes: each counts or is refused, and no number of any breaks a run.

mod effects;
mod leaves;
mod numbers;
mod pushes;
mod record;
mod representative;

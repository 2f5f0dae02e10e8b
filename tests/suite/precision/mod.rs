//! What accuracy costs: orders, order lost at contact, the same conclusions in every run, and advice.

mod advice;
mod orders;
mod repeats;

use surefoot_sim::precision::Effort;

/// Without times, and with steps as fine as a test can wait for.
const UNTIMED: Effort = Effort { most_evaluations: 30_000, repeats: 0, timed_s: 0.0 };

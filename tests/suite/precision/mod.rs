//! What accuracy costs: orders, order lost at contact, the same conclusions in every run, and advice.

mod advice;
mod controller;
mod defaults;
mod orders;
mod peers;
mod repeats;

use surefoot_host::precision::Effort;

/// The chart's steps, without times.
const UNTIMED: Effort = Effort { repeats: 0, ..Effort::CHART };

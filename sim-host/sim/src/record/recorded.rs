//! What a run has recorded, whatever moved in it: files, pages and pictures are made from this.

use crate::picture::{Moment, Shown};
use serde_json::Value;
use surefoot::dynamics::DynamicsFault;

/// What a run has recorded, whatever moved in it. Samples are counted from zero.
pub trait Record {
    /// What there is to see.
    fn shown(&self) -> &Shown;

    /// Times of all samples, s.
    fn times(&self) -> Vec<f64>;

    /// Names of all columns, with units.
    fn columns(&self) -> Vec<String>;

    /// What these hold at a sample, with as many digits as give back the same f64; empty where there is nothing.
    fn row(&self, sample: usize) -> Vec<String>;

    /// What there is to see at a sample.
    ///
    /// # Errors
    /// A [`DynamicsFault`] for what is no configuration, as a run that diverged may end in.
    fn moment(&self, sample: usize) -> Result<Moment, DynamicsFault>;

    /// Where joints are, by name.
    fn joints(&self, sample: usize) -> Vec<JointReading<'_>>;

    /// What else there is, as JSON.
    fn details(&self) -> Details;

    /// The same at a sample.
    fn detail(&self, sample: usize) -> Value;
}

/// Where a joint is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointReading<'a> {
    /// Its name, for people.
    pub name: &'a str,
    /// rad or m
    pub position: f64,
    /// rad/s or m/s
    pub velocity: f64,
    /// Of its motor, spring and damper, N·m or N; none where it has none.
    pub effort: Option<f64>,
}

/// How [`Record::detail`] is to be read.
#[derive(Clone, Debug)]
pub struct Details {
    /// Topic of its messages.
    pub topic: &'static str,
    /// Name of their schema.
    pub schema_name: &'static str,
    /// JSON schema.
    pub schema: Value,
}

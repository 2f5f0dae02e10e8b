//! Certificates: intervals against problems whose probability is known, sensitivities against a function whose indices
//! are, searches against half-spaces, and studies of scenes against themselves on other numbers of processors.

mod intervals;
mod sensitivity;
mod studies;
mod vary;

//! Appendix A, against nalgebra's own types and dense 6 × 6 matrices.

mod inertias;
mod poses;

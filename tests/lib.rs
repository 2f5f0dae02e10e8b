//! Shared problems and fixtures of the suite.

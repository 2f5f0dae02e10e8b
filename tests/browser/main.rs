//! The report's page in a browser without a window: the replay shows the run, at any width, without errors.

mod chromium;
mod live;
mod pages;
mod picture;
mod probe;
mod replay;

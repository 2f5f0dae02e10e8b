//! The binary as its users meet it: exit statuses, one JSON document on stdout, messages that say
//! what, where and what was expected.

mod any_robot;
mod certifying;
mod charts;
mod documented;
mod files;
mod firmware;
mod importing;
mod mechanisms;
mod program;
mod reports;
mod reproduced;
mod robots;
mod wrong_input;

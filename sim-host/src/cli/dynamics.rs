//! `surefoot dynamics`: kinematics and dynamics of a robot for the states of a file.

use super::import::{How, failed, refused};
use super::{bad_input, say};
use clap::{Args, ValueEnum};
use std::path::PathBuf;
use std::process::ExitCode;
use surefoot_robots::dynamics::{Convention, DynamicsError, Precision, Results, evaluate_file};

/// Of what, and how it is written.
#[derive(Debug, Args)]
pub(super) struct Options {
    /// A URDF (.urdf) or MJCF (.xml) file, or a robot.toml
    robot: PathBuf,
    /// States: joints with idx_q, nq, idx_v, nv, and for each state q, v, a, tau
    #[arg(long, value_name = "FILE.json")]
    states: PathBuf,
    #[command(flatten)]
    how: How,
    /// How floating and spherical joints are written, in and out
    #[arg(long, value_enum, default_value_t = ConventionName::Pinocchio)]
    convention: ConventionName,
    /// Of the arithmetic
    #[arg(long, value_enum, default_value_t = PrecisionName::F64)]
    precision: PrecisionName,
    /// Print one JSON document on stdout: the states, each with leaf_frames, rnea, crba, aba
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ConventionName {
    /// Quaternions x, y, z, w; linear velocity of the base in its own axes; continuous joints as cos, sin
    Pinocchio,
    /// Quaternions w, x, y, z; linear velocity of the base in the world's axes
    Mujoco,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum PrecisionName {
    F64,
    F32,
}

/// Evaluates and prints.
pub(super) fn run(options: &Options) -> ExitCode {
    let convention = match options.convention {
        ConventionName::Pinocchio => Convention::Pinocchio,
        ConventionName::Mujoco => Convention::Mujoco,
    };
    let precision = match options.precision {
        PrecisionName::F64 => Precision::F64,
        PrecisionName::F32 => Precision::F32,
    };
    let how = options.how.options();
    match evaluate_file(&options.robot, &options.states, &how, convention, precision) {
        Ok(results) if options.json => match serde_json::to_string(&results) {
            Ok(text) => say(&format!("{text}\n"), ExitCode::SUCCESS),
            Err(error) => failed("output", &error.to_string(), true),
        },
        Ok(results) => say(&summary(&results), ExitCode::SUCCESS),
        Err(DynamicsError::Robot(error)) => refused(&error, options.json),
        Err(error @ (DynamicsError::States { .. } | DynamicsError::NotUnit { .. })) => {
            bad_input(&error.to_string(), options.json)
        }
        Err(error @ (DynamicsError::Fault { .. } | DynamicsError::Singular { .. })) => {
            failed("dynamics", &error.to_string(), options.json)
        }
    }
}

fn summary(results: &Results) -> String {
    use std::fmt::Write;
    let mut out = format!(
        "{}: {} base, nq {}, nv {}, {:.3} kg; --json prints all\n",
        results.robot, results.base, results.nq, results.nv, results.mass
    );
    let largest = |x: &[f64]| x.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (index, state) in results.states.iter().enumerate() {
        let diagonal = (0..results.nv).map(|i| state.crba[i][i]).fold(0.0, f64::max);
        // Writing to a string does not fail.
        let _ = writeln!(
            out,
            "  state {index}: largest torque for a {:.4e}, largest acceleration under tau {:.4e}, \
             largest mass {diagonal:.4e}",
            largest(&state.rnea),
            largest(&state.aba)
        );
    }
    out
}

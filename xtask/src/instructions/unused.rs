//! What a scene does not have costs nothing: of the code of such features not one instruction is executed.

use super::callgrind::Counts;
use super::provide_valgrind;
use crate::workspace::{self, Built};
use anyhow::{Result, ensure};

/// Source files of features that scenes may be without.
const FEATURES: [(&str, &[&str]); 5] = [
    ("contact", &["sim-host/multibody/src/contact/"]),
    ("thrown bodies", &["recursive/strike.rs", "recursive/bond.rs", "multibody/src/striker.rs"]),
    (
        "loops",
        &[
            "recursive/loops.rs",
            "recursive/closing_rows.rs",
            "recursive/driven_loops.rs",
            "multibody/src/closure.rs",
            "multibody/src/joint.rs",
        ],
    ),
    ("springs, dampers, stops", &["multibody/src/joint_law.rs"]),
    ("motors of spherical joints", &["recursive/motors.rs", "multibody/src/gimbal.rs"]),
];

/// Steps that are counted, and the features that they have.
const WORKLOADS: [(&str, &[&str]); 6] = [
    ("multibody-step/free-body/f64", &[]),
    ("multibody-step/biped-flight/f64", &[]),
    ("multibody-step/chain-25/f64", &[]),
    ("multibody-step/biped-feet/f64", &["contact", "springs, dampers, stops"]),
    ("plant-step/floor-lumped/f64", &["contact", "motors of spherical joints"]),
    ("plant-step/welded-lumped/f64", &["loops", "motors of spherical joints"]),
];

/// What a step may take to ask whether there is any of a feature, in a build that is not optimised across crates:
/// instructions. In the program as it ships nothing of that is left.
const QUESTION: u64 = 40;

/// Counts the instructions of each feature in each step: zero where there is none of it (or, as the tests are
/// `built`, no more than a question), and, lest the count be blind, not zero where there is.
///
/// # Returns
/// What was shown.
pub fn nothing_unused_runs(built: Built) -> Result<String> {
    provide_valgrind()?;
    let program = workspace::example("instructions", built)?;
    let most = match built {
        Built::Released => 0,
        Built::WithTests => QUESTION,
    };
    let mut failures = Vec::<String>::new();
    for (workload, has) in WORKLOADS {
        let counts = Counts::of_call(&program, workload)?;
        ensure!(counts.within("recursive/step.rs") > 0, "{workload}: no line of it is known");
        for (feature, files) in FEATURES {
            let found: u64 = files.iter().map(|file| counts.within(file)).sum();
            eprintln!("  {workload}: {feature}: {found} of {}", counts.total);
            match (has.contains(&feature), found) {
                (true, found) if found <= most => {
                    failures.push(format!("{workload}: next to none of {feature} was counted"))
                }
                (false, found) if found > most => {
                    failures.push(format!("{workload} runs {found} of {feature} for nothing"));
                }
                _ => {}
            }
        }
    }
    ensure!(failures.is_empty(), "instructions: {}", failures.join("; "));
    Ok(format!("{} kinds of step run no instruction of what they do not have", WORKLOADS.len()))
}

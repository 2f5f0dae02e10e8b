//! What came of each stage.

use anyhow::{Result, bail};
use std::fmt::Display;
use std::time::{Duration, Instant};

/// The stages so far.
#[derive(Default)]
pub struct Record {
    stages: Vec<Stage>,
}

struct Stage {
    name: &'static str,
    time: Duration,
    /// What it found, in one line; or why it failed.
    outcome: Result<String, String>,
}

impl Record {
    /// Runs a stage and notes its time and what came of it.
    ///
    /// # Returns
    /// What the stage found, unless it failed.
    pub fn stage<T: Display>(
        &mut self,
        name: &'static str,
        run: impl FnOnce() -> Result<T>,
    ) -> Option<T> {
        eprintln!("\n== {name}");
        let start = Instant::now();
        let result = run();
        let outcome = match &result {
            Ok(finding) => Ok(finding.to_string()),
            Err(error) => {
                eprintln!("error: {error:#}");
                Err(format!("{error:#}"))
            }
        };
        self.stages.push(Stage { name, time: start.elapsed(), outcome });
        result.ok()
    }

    /// Prints the summary.
    ///
    /// # Errors
    /// When a stage failed, or when there was none to run: nothing tested is not a success.
    pub fn finish(self) -> Result<()> {
        println!("\n{:<14} {:>8}  result", "stage", "time");
        for Stage { name, time, outcome } in &self.stages {
            let (word, detail) = match outcome {
                Ok(finding) => ("passed", finding.as_str()),
                Err(error) => ("FAILED", error.lines().next().unwrap_or_default()),
            };
            println!("{name:<14} {:>6.1} s  {word}: {detail}", time.as_secs_f64());
        }
        let failed: Vec<&str> = self
            .stages
            .iter()
            .filter(|stage| stage.outcome.is_err())
            .map(|stage| stage.name)
            .collect();
        if self.stages.is_empty() {
            bail!("the options leave no stage to run");
        }
        if !failed.is_empty() {
            bail!(
                "{} of {} stages failed: {}. Why is said above, at `== {}`.",
                failed.len(),
                self.stages.len(),
                failed.join(", "),
                failed[0]
            );
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Record;
    use anyhow::anyhow;

    #[test]
    fn one_failure_fails_the_whole_and_is_named() {
        let mut record = Record::default();
        assert_eq!(record.stage("good", || Ok("fine")), Some("fine"));
        assert_eq!(record.stage::<&str>("bad", || Err(anyhow!("broken"))), None);
        let error = record.finish().unwrap_err().to_string();
        assert!(error.contains("1 of 2 stages failed: bad"), "{error}");
    }

    #[test]
    fn nothing_run_is_no_success() {
        assert!(Record::default().finish().is_err());
    }
}

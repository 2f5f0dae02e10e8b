//! A command to run: shown before it runs, limited in time, and named by its error when it fails.

use crate::workspace;
use anyhow::{Context, Result, anyhow, bail};
use std::ffi::OsString;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Duration;

/// A command that takes longer hangs: all of CI has less.
const DEFAULT_LIMIT: Duration = Duration::from_secs(3600);

/// How much of a silent command's output its error repeats.
const LINES_OF_A_FAILURE: usize = 12;

/// A command in the workspace's folder, its arguments, and what it is given beyond this program's
/// environment.
#[derive(Clone)]
pub struct Step {
    program: OsString,
    arguments: Vec<OsString>,
    environment: Vec<(String, OsString)>,
    folder: PathBuf,
    limit: Duration,
}

impl Step {
    /// A command with its arguments.
    pub fn new<A: Into<OsString>>(
        program: impl Into<OsString>,
        arguments: impl IntoIterator<Item = A>,
    ) -> Self {
        Self {
            program: program.into(),
            arguments: arguments.into_iter().map(Into::into).collect(),
            environment: Vec::new(),
            folder: workspace::root().to_owned(),
            limit: DEFAULT_LIMIT,
        }
    }

    /// Sets an environment variable.
    pub fn env(mut self, name: impl Into<String>, value: impl Into<OsString>) -> Self {
        self.environment.push((name.into(), value.into()));
        self
    }

    /// Runs in another folder than the workspace's.
    pub fn in_folder(mut self, folder: &Path) -> Self {
        folder.clone_into(&mut self.folder);
        self
    }

    /// Stops the command, as a failure, when it takes longer.
    pub fn within(mut self, seconds: u64) -> Self {
        self.limit = Duration::from_secs(seconds);
        self
    }

    /// Adds arguments.
    pub fn args<A: Into<OsString>>(mut self, arguments: impl IntoIterator<Item = A>) -> Self {
        self.arguments.extend(arguments.into_iter().map(Into::into));
        self
    }

    /// Runs with the output going where this program's goes.
    pub fn run(&self) -> Result<()> {
        eprintln!("  $ {self}");
        let output = self.wait(self.expression())?;
        self.expect_success(&output)
    }

    /// Runs in silence.
    pub fn run_silently(&self) -> Result<()> {
        eprintln!("  $ {self}");
        let output = self.wait(self.expression().stderr_to_stdout().stdout_capture())?;
        self.expect_success_or_repeat(&output, &output.stdout)
    }

    /// Runs with its progress going where this program's goes, for what it writes to stdout.
    pub fn run_and_read(&self) -> Result<String> {
        eprintln!("  $ {self}");
        let output = self.wait(self.expression().stdout_capture())?;
        self.expect_success(&output)?;
        self.text(output)
    }

    /// Runs unshown and in silence, for what it writes to stdout.
    pub fn read(&self) -> Result<String> {
        let output = self.wait(self.expression().stdout_capture().stderr_capture())?;
        self.expect_success_or_repeat(&output, &output.stderr)?;
        self.text(output)
    }

    /// Whether the command can be started and succeeds. It runs unshown and in silence.
    pub fn succeeds(&self) -> bool {
        let output = self.wait(self.expression().stdout_null().stderr_null());
        output.is_ok_and(|output| output.status.success())
    }

    fn expression(&self) -> duct::Expression {
        let command = duct::cmd(&self.program, &self.arguments).dir(&self.folder);
        let command = command.unchecked().stdin_null();
        self.environment.iter().fold(command, |command, (name, value)| command.env(name, value))
    }

    fn wait(&self, expression: duct::Expression) -> Result<Output> {
        let handle = expression.start().map_err(|error| {
            let program = self.program.display();
            anyhow!("`{program}` cannot be started ({error}); is it installed and on the PATH?")
        })?;
        if let Some(output) = handle.wait_timeout(self.limit)? {
            return Ok(output.clone());
        }
        handle.kill()?;
        bail!("`{self}` took longer than {} s and was stopped", self.limit.as_secs())
    }

    fn expect_success(&self, output: &Output) -> Result<()> {
        if !output.status.success() {
            bail!("`{self}` failed ({})", output.status);
        }
        Ok(())
    }

    /// The error of a command that was silent repeats the end of what it would have said.
    fn expect_success_or_repeat(&self, output: &Output, said: &[u8]) -> Result<()> {
        self.expect_success(output).map_err(|error| {
            let text = String::from_utf8_lossy(said);
            let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
            let end = &lines[lines.len().saturating_sub(LINES_OF_A_FAILURE)..];
            anyhow!("{error}, saying:\n    {}", end.join("\n    "))
        })
    }

    fn text(&self, output: Output) -> Result<String> {
        let text = String::from_utf8(output.stdout)
            .with_context(|| format!("`{self}` wrote something else than text"))?;
        Ok(text.trim().to_owned())
    }
}

/// As one would type it.
impl fmt::Display for Step {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value) in &self.environment {
            write!(f, "{name}={} ", value.display())?;
        }
        write!(f, "{}", self.program.display())?;
        self.arguments.iter().try_for_each(|argument| write!(f, " {}", argument.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::Step;

    #[test]
    fn a_failure_names_the_command_and_repeats_what_it_said() {
        let step = Step::new("sh", ["-c", "echo the reason; exit 3"]).env("ANSWER", "42");
        let error = step.run_silently().unwrap_err().to_string();
        assert!(error.contains("ANSWER=42 sh -c"), "{error}");
        assert!(error.contains("exit status: 3"), "{error}");
        assert!(error.contains("the reason"), "{error}");
    }

    #[test]
    fn a_missing_program_is_named() {
        let error = Step::new("surefoot-no-such-program", [""; 0]).read().unwrap_err().to_string();
        assert!(error.contains("`surefoot-no-such-program` cannot be started"), "{error}");
    }

    #[test]
    fn a_command_over_its_time_is_stopped() {
        let error = Step::new("sleep", ["60"]).within(0).run_silently().unwrap_err().to_string();
        assert!(error.contains("took longer than 0 s"), "{error}");
    }
}

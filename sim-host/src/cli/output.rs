//! What goes to stdout and stderr, and what becomes of a run whose words nobody can take.

use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// What a shell says of a program that a closed pipe has ended: 128 and the number of SIGPIPE.
const READER_GONE: u8 = 141;

/// Writes to stdout.
///
/// # Errors
/// The exit status, where that cannot be: a disk that is full is told on stderr, a reader that has gone away, as in
/// `| head`, is not.
pub(super) fn print(text: &str) -> Result<(), ExitCode> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| lost(&error))
}

/// Writes to stdout, and gives the exit status: this one, if all was written.
pub(super) fn say(text: &str, status: ExitCode) -> ExitCode {
    print(text).err().unwrap_or(status)
}

/// The exit status where stdout could not be written.
pub(super) fn lost(error: &std::io::Error) -> ExitCode {
    if error.kind() == ErrorKind::BrokenPipe {
        return ExitCode::from(READER_GONE);
    }
    complain(format_args!("error: standard output: {error}"));
    ExitCode::from(super::RUN_FAILED)
}

/// Writes a line to stderr. Where that cannot be there is nobody left to tell.
pub(super) fn complain(line: impl std::fmt::Display) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

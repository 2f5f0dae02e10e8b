//! The `surefoot` command: see [`surefoot_host::cli`].

fn main() -> std::process::ExitCode {
    surefoot_host::cli::main()
}

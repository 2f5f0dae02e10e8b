//! The `surefoot` command: see [`surefoot_sim::cli`].

fn main() -> std::process::ExitCode {
    surefoot_sim::cli::main()
}

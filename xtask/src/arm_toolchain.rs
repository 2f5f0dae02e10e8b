//! A compiler for thumbv7em-none-eabihf, by one of two ways.
//!
//! 1. `rustup target add`: core precompiled. Needs rustup's server.
//! 2. Debian's `rustc-web` with `rust-web-src`: the same cargo, that compiler, and core built from
//!    its source. Needs Debian's packages. Compiler and source must be of one version, so that both
//!    are installed at the version that apt offers for the first.
//!
//! `SUREFOOT_ARM_TOOLCHAIN=rustup` or `debian` chooses; else the first that works is taken.

use crate::shell::{apt_install, cargo, output};
use anyhow::{Context, Result, bail};
use std::process::Command;
use std::time::{Duration, Instant};

/// The target of a Cortex-M4F.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// How long rustup may try to reach its server.
const PATIENCE: Duration = Duration::from_secs(120);

/// Where Debian puts its compiler.
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";

/// What has to be set to compile for the target.
pub struct ArmToolchain {
    name: String,
    environment: Vec<(&'static str, String)>,
}

impl ArmToolchain {
    /// The compiler's name and version.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// A cargo command that compiles for the target; its files go to a folder of their own, since
    /// they may come from another compiler than the host's.
    pub fn cargo(&self, subcommand: &str) -> Command {
        let mut command = cargo();
        command.args([subcommand, "--target", TARGET, "--target-dir", "target/arm"]);
        command.envs(self.environment.iter().map(|(name, value)| (*name, value)));
        command
    }
}

/// Finds or installs a compiler for the target.
///
/// # Errors
/// If neither way works, with both reasons.
pub fn arm_toolchain() -> Result<ArmToolchain> {
    match std::env::var("SUREFOOT_ARM_TOOLCHAIN").as_deref() {
        Ok("rustup") => rustup(),
        Ok("debian") => debian(),
        Ok(other) if other != "auto" => {
            bail!("SUREFOOT_ARM_TOOLCHAIN={other}: expected rustup, debian or auto")
        }
        _ => rustup().or_else(|first| {
            eprintln!("no target by rustup ({first:#}); trying Debian's compiler");
            debian().with_context(|| format!("rustup: {first:#}; and Debian's compiler"))
        }),
    }
}

fn rustup() -> Result<ArmToolchain> {
    let installed = output(Command::new("rustup").args(["target", "list", "--installed"]))?;
    if !installed.lines().any(|line| line == TARGET) {
        add_target()?;
    }
    let name = output(Command::new("rustc").arg("--version"))?.trim().to_owned();
    Ok(ArmToolchain { name, environment: Vec::new() })
}

/// `rustup target add`, stopped when the server does not answer.
fn add_target() -> Result<()> {
    let mut child = Command::new("rustup")
        .args(["target", "add", TARGET])
        .spawn()
        .context("cannot start rustup")?;
    let started = Instant::now();
    loop {
        if let Some(status) = child.try_wait()? {
            if status.success() {
                return Ok(());
            }
            bail!("`rustup target add {TARGET}` did not succeed");
        }
        if started.elapsed() > PATIENCE {
            child.kill()?;
            child.wait()?;
            bail!("`rustup target add {TARGET}` got no answer in {} s", PATIENCE.as_secs());
        }
        std::thread::sleep(Duration::from_millis(100));
    }
}

fn debian() -> Result<ArmToolchain> {
    let ready = compiler_version().is_ok_and(|version| source_version().is_some_and(|s| s == version));
    if !ready {
        let policy = output(Command::new("apt-cache").args(["policy", "rustc-web"]))
            .context("no apt on this machine, and so no Debian compiler")?;
        let candidate = candidate(&policy);
        let version = match candidate {
            Some(version) => version,
            None => {
                apt_install(&["ca-certificates"])?;
                let policy = output(Command::new("apt-cache").args(["policy", "rustc-web"]))?;
                self::candidate(&policy).context("apt offers no package rustc-web")?
            }
        };
        apt_install(&[
            &format!("rustc-web={version}"),
            &format!("rust-web-src={version}"),
        ])?;
    }
    let version = compiler_version()?;
    match source_version() {
        Some(source) if source == version => {}
        source => bail!("Debian's compiler is {version}, its source {source:?}: they must agree"),
    }
    let linker = rust_lld()?;
    Ok(ArmToolchain {
        name: format!("Debian's rustc {version}, core from source"),
        environment: vec![
            ("RUSTC", DEBIAN_RUSTC.to_owned()),
            // Building core from source is for nightly compilers, or for those told to be one.
            ("RUSTC_BOOTSTRAP", "1".to_owned()),
            ("CARGO_UNSTABLE_BUILD_STD", "core".to_owned()),
            ("__CARGO_TESTS_ONLY_SRC_ROOT", format!("/usr/src/rustc-{version}/library")),
            ("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_LINKER", linker),
        ],
    })
}

fn candidate(policy: &str) -> Option<String> {
    let line = policy.lines().find_map(|line| line.trim().strip_prefix("Candidate: "))?;
    (line != "(none)").then(|| line.to_owned())
}

/// "1.96.0" of "rustc 1.96.0 (…)".
fn compiler_version() -> Result<String> {
    let text = output(Command::new(DEBIAN_RUSTC).arg("--version"))?;
    let version = text.split_whitespace().nth(1).context("rustc prints no version")?;
    Ok(version.to_owned())
}

/// Version of the newest source under /usr/src that has the library.
fn source_version() -> Option<String> {
    let version = compiler_version().ok()?;
    let library = format!("/usr/src/rustc-{version}/library/core/src/lib.rs");
    std::path::Path::new(&library).is_file().then_some(version)
}

/// The linker that comes with the rustup toolchain.
fn rust_lld() -> Result<String> {
    let sysroot = output(Command::new("rustc").args(["--print", "sysroot"]))?;
    let host = output(Command::new("rustc").args(["--print", "host-tuple"]))?;
    let path = format!("{}/lib/rustlib/{}/bin/rust-lld", sysroot.trim(), host.trim());
    if std::path::Path::new(&path).is_file() {
        Ok(path)
    } else {
        bail!("the toolchain has no rust-lld at {path}")
    }
}

//! A compiler for a target: the reference board's, thumbv7em-none-eabihf (Cortex-M4F), or another one.
//!
//! Two ways lead to one. The first is rustup's compiled `core` for the target. Where its server
//! cannot be reached, Debian's packages of the compiler and of its sources do: cargo then compiles
//! `core` itself, which a released compiler does only with `RUSTC_BOOTSTRAP`. Debian's compiler
//! comes without a linker for the target; the rustup toolchain that runs cargo has one.

use crate::step::Step;
use crate::{apt, workspace};
use anyhow::{Context, Result, bail, ensure};
use std::env;
use std::fmt;
use std::path::{Path, PathBuf};

/// The reference board's triple.
pub const TARGET: &str = "thumbv7em-none-eabihf";

/// Environment variable that says which way to go: `rustup`, `debian`, or `auto` (the default: one
/// after the other).
const CHOICE: &str = "SUREFOOT_ARM_TOOLCHAIN";

/// Debian's packages of the compiler and of the sources it was built from. Both must have one
/// version: a compiler compiles no other version's `core`.
const PACKAGES: [&str; 2] = ["rustc-web", "rust-web-src"];
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";

/// Seconds to wait for rustup. It downloads a few MB; a server that does not answer keeps it
/// waiting.
const RUSTUP_LIMIT: u64 = 120;

/// A compiler that can compile for the target.
pub struct Toolchain {
    /// The target's triple.
    target: String,
    compiler: Compiler,
}

enum Compiler {
    /// The compiler that cargo uses anyway, with a compiled `core` beside it.
    Rustup,
    /// Debian's compiler, which compiles `core` from source.
    Debian {
        /// Version of both packages.
        version: String,
        /// The linker of the toolchain that runs cargo.
        linker: PathBuf,
    },
}

impl Toolchain {
    /// Finds a compiler for the target, and installs one where there is none.
    pub fn provide(target: &str) -> Result<Self> {
        let compiler = Compiler::provide(target)?;
        Ok(Self { target: target.to_owned(), compiler })
    }

    /// A cargo command that compiles for the target with this compiler.
    pub fn cargo(&self, subcommand: &str) -> Step {
        let cargo = workspace::cargo([subcommand, "--target", &self.target]);
        match &self.compiler {
            Compiler::Rustup => cargo,
            Compiler::Debian { linker, .. } => cargo
                .env("RUSTC", DEBIAN_RUSTC)
                .env("RUSTC_BOOTSTRAP", "1")
                .env("CARGO_UNSTABLE_BUILD_STD", "core")
                .env(self.setting("LINKER"), linker),
        }
    }

    /// The environment variable that is cargo's setting of the target.
    pub fn setting(&self, name: &str) -> String {
        let target = self.target.to_uppercase().replace(['-', '.'], "_");
        format!("CARGO_TARGET_{target}_{name}")
    }

    /// # Returns
    /// The compiler's release, such as `1.95.0`.
    pub fn release(&self) -> Result<String> {
        let version = match self.compiler {
            Compiler::Rustup => workspace::rustc(["--version"]),
            Compiler::Debian { .. } => Step::new(DEBIAN_RUSTC, ["--version"]),
        };
        let said = version.read()?;
        let release = said.split_whitespace().nth(1);
        Ok(release.with_context(|| format!("`{version}` says {said:?}"))?.to_owned())
    }
}

impl Compiler {
    fn provide(target: &str) -> Result<Self> {
        let choice = env::var_os(CHOICE).unwrap_or_else(|| "auto".into());
        match choice.to_str() {
            Some("rustup") => Self::from_rustup(target),
            Some("debian") => Self::from_debian(),
            Some("auto") => Self::from_rustup(target).or_else(|rustup| {
                eprintln!("{rustup:#}\nSo now Debian's packages are tried.");
                Self::from_debian().map_err(|debian| neither(target, &rustup, &debian))
            }),
            _ => bail!("{CHOICE} must be rustup, debian or auto, and is {}", choice.display()),
        }
    }

    fn from_rustup(target: &str) -> Result<Self> {
        if !has_compiled_core(target)? {
            // Its own word, not its stack, where it fails.
            let add = Step::new("rustup", ["target", "add", target]).env("RUST_BACKTRACE", "0");
            add.within(RUSTUP_LIMIT).run_silently()?;
            ensure!(
                has_compiled_core(target)?,
                "rustup added {target} to another toolchain than the one that runs cargo"
            );
        }
        Ok(Self::Rustup)
    }

    fn from_debian() -> Result<Self> {
        let linker = linker()?;
        let usable = installed_pair().filter(|version| expect_new_enough(version).is_ok());
        let version = match usable {
            Some(version) => version,
            None => {
                apt::install_same_version(PACKAGES, expect_new_enough)?;
                installed_pair().context("apt-get installed the packages, but dpkg lacks them")?
            }
        };
        let sources = Step::new(DEBIAN_RUSTC, ["--print", "sysroot"]).read()?;
        let sources = Path::new(&sources).join("lib/rustlib/src/rust/library");
        ensure!(
            sources.is_dir(),
            "the compiler {DEBIAN_RUSTC} looks for its sources in {}, where {} has not put them",
            sources.display(),
            PACKAGES[1]
        );
        Ok(Self::Debian { version, linker })
    }
}

impl fmt::Display for Toolchain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.compiler {
            Compiler::Rustup => write!(f, "rustup's core for {}", self.target),
            Compiler::Debian { version, .. } => {
                write!(f, "Debian's compiler {version}, with core from its sources")
            }
        }
    }
}

/// Whether cargo's own compiler has a compiled `core` for the target.
fn has_compiled_core(target: &str) -> Result<bool> {
    let folder = workspace::rustc(["--print", "target-libdir", "--target", target]).read()?;
    let Ok(files) = Path::new(&folder).read_dir() else { return Ok(false) };
    Ok(files.flatten().any(|file| file.file_name().to_string_lossy().starts_with("libcore-")))
}

/// The linker that rustup's toolchains bring along for targets such as this one.
fn linker() -> Result<PathBuf> {
    let folder = workspace::rustc(["--print", "target-libdir"]).read()?;
    let linker = Path::new(&folder).with_file_name("bin").join("rust-lld");
    ensure!(
        linker.is_file(),
        "the toolchain that runs cargo has no linker for the target ({} is missing); \
         toolchains installed by rustup have it",
        linker.display()
    );
    Ok(linker)
}

/// The version of both packages, if they are installed and agree.
fn installed_pair() -> Option<String> {
    let [compiler, sources] = PACKAGES.map(apt::installed_version);
    compiler.filter(|version| sources.as_ref() == Some(version))
}

/// Whether Debian's compiler is one that can compile this workspace.
fn expect_new_enough(version: &str) -> Result<()> {
    let minor = |version: &str| -> Option<u32> { version.split('.').nth(1)?.parse().ok() };
    let needed = env!("CARGO_PKG_RUST_VERSION");
    ensure!(
        minor(version) >= minor(needed),
        "Debian's compiler here is {version}; this workspace needs Rust {needed}"
    );
    Ok(())
}

/// Both ways are closed: why, and what opens one.
fn neither(target: &str, rustup: &anyhow::Error, debian: &anyhow::Error) -> anyhow::Error {
    anyhow::anyhow!(
        "no compiler for {target} is to be had here.\n\
         rustup: {rustup:#}\n\
         Debian: {debian:#}\n\
         To mend it, run `rustup target add {target}` on a machine that reaches rustup's server, or \
         install Debian's packages {} and {} in one version. \
         All that needs no target: `cargo xtask test --skip-target`.",
        PACKAGES[0],
        PACKAGES[1]
    )
}

#[cfg(test)]
mod tests {
    use super::expect_new_enough;

    #[test]
    fn an_old_compiler_is_refused_before_it_is_downloaded() {
        assert!(expect_new_enough("1.96.0+dfsg1-1~deb12u2").is_ok());
        assert!(expect_new_enough("1.85.0+dfsg3-1~deb12u3").is_err());
        assert!(expect_new_enough("unheard of").is_err());
    }
}

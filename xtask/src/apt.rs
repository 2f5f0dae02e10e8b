//! Debian's packages, where this machine has them.

use crate::step::Step;
use anyhow::{Context, Result, bail};
use std::io::{IsTerminal, stdin};
use std::path::Path;

/// Seconds to wait for the lists of packages.
const UPDATE_LIMIT: u64 = 300;
/// Seconds to wait for packages; the largest set here is some 100 MB.
const INSTALL_LIMIT: u64 = 1200;

/// Installs the newest version of a package.
pub fn install(package: &str) -> Result<()> {
    update()?;
    apt_get(["install", package], INSTALL_LIMIT).run_silently()
}

/// Unpacks a package into a folder, with those it depends on that are not installed: for where installing
/// it would remove what someone has chosen. Nothing of the machine changes.
pub fn unpack(package: &str, folder: &Path) -> Result<()> {
    let wanted = ["--print-uris", "--no-install-recommends", "install", package];
    let plan = Step::new("apt-get", ["-y"]).args(wanted).env("LC_ALL", "C").read()?;
    let names = plan.lines().filter_map(planned_package);
    let archives = folder.join("archives");
    std::fs::create_dir_all(&archives)
        .with_context(|| format!("cannot make {}", archives.display()))?;
    let download = Step::new("apt-get", ["download"]).args(names).in_folder(&archives);
    download.within(INSTALL_LIMIT).run_silently()?;
    for archive in std::fs::read_dir(&archives)? {
        let paths = [archive?.path().into_os_string(), folder.into()];
        let arguments = ["--extract".into()].into_iter().chain(paths);
        Step::new("dpkg-deb", arguments).run_silently()?;
    }
    Ok(std::fs::remove_dir_all(&archives)?)
}

/// The package that a line of `--print-uris` names: `'http://…' NAME_VERSION_ARCHITECTURE.deb SIZE …`, with
/// colons as `%3a`.
fn planned_package(line: &str) -> Option<String> {
    let file = line.strip_prefix('\'')?.split_whitespace().nth(1)?;
    let mut parts = file.strip_suffix(".deb")?.split('_');
    let (name, version) = (parts.next()?, parts.next()?.replace("%3a", ":"));
    Some(format!("{name}={version}"))
}

/// Installs packages that must have one version in common: the newest of the first.
///
/// `is_usable` judges that version before anything is downloaded.
pub fn install_same_version(
    packages: [&str; 2],
    is_usable: impl FnOnce(&str) -> Result<()>,
) -> Result<()> {
    update()?;
    let version = candidate(packages[0])?;
    is_usable(&version)?;
    let pinned = packages.map(|package| format!("{package}={version}"));
    apt_get(["install".to_owned()].into_iter().chain(pinned), INSTALL_LIMIT).run_silently()
}

/// The version of a package that is installed and ready to use.
pub fn installed_version(package: &str) -> Option<String> {
    let query =
        Step::new("dpkg-query", ["--show", "--showformat=${db:Status-Status} ${Version}", package]);
    let answer = query.read().ok()?;
    answer.strip_prefix("installed ").map(str::to_owned)
}

fn update() -> Result<()> {
    if !Step::new("apt-get", ["--version"]).succeeds() {
        bail!("this machine has no apt-get");
    }
    apt_get(["update"], UPDATE_LIMIT).run_silently()
}

/// The version that would be installed.
fn candidate(package: &str) -> Result<String> {
    let policy = Step::new("apt-cache", ["policy", package]).env("LC_ALL", "C").read()?;
    let version = policy.lines().find_map(|line| line.trim().strip_prefix("Candidate: "));
    match version {
        Some(version) if version != "(none)" => Ok(version.to_owned()),
        _ => bail!("the package {package} is not among those that apt-get knows of"),
    }
}

/// An apt-get command as the administrator, which asks nothing, and waits for another one to end.
fn apt_get<A: Into<String>>(arguments: impl IntoIterator<Item = A>, limit: u64) -> Step {
    let is_administrator = Step::new("id", ["-u"]).read().is_ok_and(|user| user == "0");
    let rise: &[&str] = match (is_administrator, stdin().is_terminal()) {
        (true, _) => &[],
        // Someone is there to type a password.
        (false, true) => &["sudo"],
        (false, false) => &["sudo", "-n"],
    };
    let apt_get = ["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-y"];
    // Nothing that someone has chosen to install is removed to make room.
    let options = ["--no-install-recommends", "--no-remove", "-o", "DPkg::Lock::Timeout=120"];
    let fixed = rise.iter().copied().chain(apt_get).chain(options).map(str::to_owned);
    let mut words = fixed.chain(arguments.into_iter().map(Into::into));
    let program = words.next().unwrap_or_default();
    Step::new(program, words).within(limit)
}

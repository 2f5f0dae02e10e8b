//! Chromium, one process for each look.

use crate::picture::Picture;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, Instant};

/// A look that takes longer hangs.
const LIMIT: Duration = Duration::from_secs(120);

/// Without a window, without the network, and with a profile of its own.
const SETTINGS: [&str; 10] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--hide-scrollbars",
    // Pages of one folder may look into each other.
    "--allow-file-access-from-files",
];

/// A folder of the tests' own, which stays.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("browser").join(name);
    std::fs::create_dir_all(&folder).expect("a folder for temporary files");
    folder
}

/// A folder for one process.
fn passing_folder(name: &str) -> PathBuf {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    folder(&format!("{name}-{}-{count}", std::process::id()))
}

/// What a window of so many pixels shows of a page; `fragment` is what follows its address.
pub fn screenshot(page: &Path, fragment: &str, (width, height): (u32, u32)) -> Picture {
    let folder = passing_folder("screenshot");
    let file = folder.join("screenshot.png");
    let mut screenshot = std::ffi::OsString::from("--screenshot=");
    screenshot.push(&file);
    let size = format!("--window-size={width},{height}");
    chromium(page, fragment, &[screenshot, size.into()]);
    let picture = Picture::read(&file);
    // A picture that was looked at is of no more use.
    let _ = std::fs::remove_dir_all(folder);
    picture
}

/// The page as it stands after so many milliseconds of the page's own time; `fragment` is what follows its address.
pub fn document(page: &Path, fragment: &str, milliseconds: u32) -> String {
    let time = format!("--virtual-time-budget={milliseconds}");
    let output = chromium(page, fragment, &["--dump-dom".into(), time.into()]);
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn chromium(page: &Path, fragment: &str, arguments: &[std::ffi::OsString]) -> Output {
    let profile = passing_folder("profile");
    let mut user_data = std::ffi::OsString::from("--user-data-dir=");
    user_data.push(&profile);
    let mut child = Command::new("chromium")
        .args(SETTINGS)
        .arg(user_data)
        .args(arguments)
        .arg(format!("file://{}{fragment}", page.display()))
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("chromium is installed (`cargo xtask test --only browser` sees to it)");
    // It may write more than a pipe holds.
    let mut stdout = child.stdout.take().expect("a pipe");
    let reader = std::thread::spawn(move || {
        let mut text = Vec::new();
        std::io::Read::read_to_end(&mut stdout, &mut text).map(|_| text)
    });
    let started = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().expect("a child of ours") {
            break status;
        }
        if started.elapsed() > LIMIT {
            let _ = child.kill();
            panic!("chromium took longer than {} s", LIMIT.as_secs());
        }
        std::thread::sleep(Duration::from_millis(20));
    };
    let stdout = reader.join().expect("a reader").expect("what chromium wrote");
    let _ = std::fs::remove_dir_all(profile);
    assert!(status.success(), "chromium: {status}");
    Output { status, stdout, stderr: Vec::new() }
}

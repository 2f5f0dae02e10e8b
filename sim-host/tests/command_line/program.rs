//! The program, and folders to run it in.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const SCENE: &str = include_str!("../../scenes/experiment-1-welded.toml");

/// A folder of this test's own, for scenes and results.
pub fn folder(test: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(test);
    std::fs::create_dir_all(&folder).expect("a folder below the target directory");
    folder
}

pub fn surefoot(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_surefoot"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program starts")
}

/// Exit status and both streams.
pub fn said(output: &Output) -> (Option<i32>, String, String) {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("UTF-8");
    (output.status.code(), text(&output.stdout), text(&output.stderr))
}

/// The scene of the welded feet with some lines changed.
pub fn changed_scene(folder: &Path, changes: &[(&str, &str)]) -> String {
    let mut scene = SCENE.to_owned();
    for (line, by) in changes {
        assert!(scene.contains(line), "the scene has the line {line}");
        scene = scene.replace(line, by);
    }
    let path = folder.join("pushed.toml");
    std::fs::write(&path, scene).expect("writable");
    path.to_str().expect("UTF-8").to_owned()
}

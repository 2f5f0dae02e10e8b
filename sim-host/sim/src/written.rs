//! Files that are there whole, or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::Path;

/// Writes a file aside and renames it: whoever reads it, and whoever writes it at the same time, sees one file or the
/// other, never a mixture. Nothing is left of one that cannot be finished.
///
/// # Errors
/// With the file's name.
pub fn write_whole<E: std::fmt::Display>(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<&File>) -> Result<(), E>,
) -> Result<(), String> {
    let context = |error: &dyn std::fmt::Display| format!("{}: {error}", path.display());
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let mut aside = tempfile::Builder::new();
    aside.prefix(".").suffix(".part");
    // As readable as any other file: the system takes from it what its user masks.
    #[cfg(unix)]
    aside.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let aside = aside.tempfile_in(folder.unwrap_or(Path::new("."))).map_err(|e| context(&e))?;
    let mut to = BufWriter::new(aside.as_file());
    write(&mut to).map_err(|error| context(&error))?;
    to.flush().map_err(|error| context(&error))?;
    drop(to);
    aside.persist(path).map_err(|error| context(&error.error))?;
    Ok(())
}

/// The same of a text.
///
/// # Errors
/// With the file's name.
pub fn write_text(path: &Path, text: &str) -> Result<(), String> {
    write_whole(path, |to| to.write_all(text.as_bytes()))
}

/// The same of rows of numbers and words, with a head.
///
/// # Errors
/// With the file's name.
pub fn write_rows(
    path: &Path,
    rows: impl FnOnce(&mut csv::Writer<&mut BufWriter<&File>>) -> Result<(), csv::Error>,
) -> Result<(), String> {
    write_whole(path, |to| {
        let mut writer = csv::Writer::from_writer(to);
        rows(&mut writer)?;
        writer.flush().map_err(csv::Error::from)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_cannot_be_finished_leaves_the_old_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("record.csv");
        write_text(&path, "whole").expect("written");
        let failed = write_whole(&path, |to| {
            to.write_all(b"half")?;
            Err(std::io::Error::other("no more"))
        });
        assert!(
            failed.is_err_and(|error| error.contains("record.csv") && error.contains("no more"))
        );
        assert_eq!(std::fs::read_to_string(&path).expect("there"), "whole");
        assert_eq!(std::fs::read_dir(folder.path()).expect("there").count(), 1);
    }
}

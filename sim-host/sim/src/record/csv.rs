//! The record as CSV: one row a sample, one named column a number, units in the names.

use super::Record;
use std::io::Write;

/// Writes all samples. Columns of what a run has not, such as a block, are empty. Numbers are printed with as many digits
/// as give back the same f64.
///
/// # Errors
/// Those of the writer.
pub fn write_csv(record: &dyn Record, to: impl Write) -> Result<(), ::csv::Error> {
    let mut writer = ::csv::Writer::from_writer(to);
    writer.write_record(record.columns())?;
    for sample in 0..record.times().len() {
        writer.write_record(record.row(sample))?;
    }
    writer.flush()?;
    Ok(())
}

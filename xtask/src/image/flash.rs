//! How much flash an image takes.

use super::Image;
use object::{Object, ObjectSection, SectionKind};

/// Bytes of flash: code, constants with the vector table, and the initial values of variables.
pub fn flash_bytes(image: &Image<'_>) -> u64 {
    let is_in_flash = |kind| {
        matches!(
            kind,
            SectionKind::Text
                | SectionKind::ReadOnlyData
                | SectionKind::ReadOnlyString
                | SectionKind::Data
        )
    };
    image.sections().filter(|section| is_in_flash(section.kind())).map(|s| s.size()).sum()
}

//! How much memory an image takes.

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

/// Bytes of RAM but for the stack: variables, whether initialised, cleared, or left alone at reset.
pub fn ram_bytes(image: &Image<'_>) -> u64 {
    let is_in_ram = |kind| matches!(kind, SectionKind::Data | SectionKind::UninitializedData);
    image.sections().filter(|section| is_in_ram(section.kind())).map(|s| s.size()).sum()
}

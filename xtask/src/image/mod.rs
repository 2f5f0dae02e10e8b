//! What a linked image of the target says of the code in it.

mod call_sites;
mod flash;
mod panicking;

pub use flash::flash_bytes;
pub use panicking::{Panicking, panicking};

use anyhow::{Context, Result};
use object::read::elf::ElfFile32;

/// An executable of the target.
pub type Image<'a> = ElfFile32<'a>;

/// Takes the contents of a file for an executable of the target.
pub fn parse(contents: &[u8]) -> Result<Image<'_>> {
    Image::parse(contents).context("not a 32-bit ELF file, as the target's linker makes them")
}

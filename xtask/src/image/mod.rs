//! What a linked image of the target says of the code in it.

mod call_sites;
mod memory;
mod panicking;
mod reachable;

pub use memory::{flash_bytes, ram_bytes};
pub use panicking::{Panicking, panicking};
pub use reachable::{function, reachable_panics};

use anyhow::{Context, Result};
use object::read::elf::ElfFile32;

/// An executable of the target.
pub type Image<'a> = ElfFile32<'a>;

/// Takes the contents of a file for an executable of the target.
pub fn parse(contents: &[u8]) -> Result<Image<'_>> {
    Image::parse(contents).context("not a 32-bit ELF file, as the target's linker makes them")
}

//! Where in the source a function of an image is called.
//!
//! Link-time optimisation inlines nearly everything, so that a caller's symbol says little. The
//! image keeps its relocations (`--emit-relocs`), which tell at which addresses a function is
//! called, and line tables, which tell the source position of an address and of all functions
//! inlined there.

use super::Image;
use super::panicking::readable;
use crate::workspace;
use addr2line::gimli::{Dwarf, EndianSlice, LittleEndian, SectionId};
use addr2line::{Context, Frame};
use anyhow::Result;
use object::{Object, ObjectSection, ObjectSymbol, RelocationTarget, SectionKind, SymbolIndex};
use std::collections::BTreeSet;
use std::path::Path;

type Slice<'a> = EndianSlice<'a, LittleEndian>;

/// The calls within an image.
pub struct CallSites<'a> {
    image: &'a Image<'a>,
    lines: Context<Slice<'a>>,
}

impl<'a> CallSites<'a> {
    /// Reads the line tables of an image.
    pub fn new(image: &'a Image<'a>) -> Result<Self> {
        let section = |id: SectionId| -> Result<Slice<'a>> {
            let contents = match image.section_by_name(id.name()) {
                Some(section) => section.data()?,
                None => &[],
            };
            Ok(EndianSlice::new(contents, LittleEndian))
        };
        Ok(Self { image, lines: Context::from_dwarf(Dwarf::load(section)?)? })
    }

    /// Where the function is called, or its address taken, by functions other than the `ignored`.
    pub fn of(&self, function: SymbolIndex, ignored: impl Fn(&str) -> bool) -> Vec<String> {
        let sections = self.image.sections().filter(|section| section.kind() == SectionKind::Text);
        let addresses = sections.flat_map(|section| section.relocations()).filter_map(
            |(address, relocation)| {
                (relocation.target() == RelocationTarget::Symbol(function)).then_some(address)
            },
        );
        let sites: BTreeSet<String> = addresses
            .filter(|&address| !self.caller(address).is_some_and(|caller| ignored(&caller)))
            .map(|address| self.describe(address))
            .collect();
        sites.into_iter().collect()
    }

    /// Name of the function that an address lies in.
    fn caller(&self, address: u64) -> Option<String> {
        let symbol = self.image.symbols().find(|symbol| {
            // Bit 0 of a function's address says that it is in the Thumb instruction set.
            let start = symbol.address() & !1;
            (start..start + symbol.size()).contains(&address)
        })?;
        Some(readable(symbol.name().ok()?))
    }

    /// Source position of an address, from the innermost inlined function out to the first one of
    /// this workspace.
    fn describe(&self, address: u64) -> String {
        let mut chain = Vec::new();
        if let Ok(mut frames) = self.lines.find_frames(address).skip_all_loads() {
            while let Ok(Some(frame)) = frames.next() {
                let (position, is_ours) = describe_frame(&frame);
                chain.push(position);
                if is_ours {
                    break;
                }
            }
        }
        if chain.is_empty() {
            let caller = self.caller(address).unwrap_or_default();
            return format!("{address:#010x} {caller}");
        }
        chain.join("\n      in ")
    }
}

/// `file:line (function)`, and whether the file is one of this workspace's.
fn describe_frame(frame: &Frame<'_, Slice<'_>>) -> (String, bool) {
    let function = frame.function.as_ref().and_then(|name| name.raw_name().ok());
    let function = function.map_or_else(|| "?".to_owned(), |name| without_types(&readable(&name)));
    let location = frame.location.as_ref();
    let file = location.and_then(|location| location.file).unwrap_or("?");
    let line = location.and_then(|location| location.line).unwrap_or(0);
    let ours = Path::new(file).strip_prefix(workspace::root()).ok();
    let shown = ours.unwrap_or_else(|| in_its_package(file));
    (format!("{}:{line} ({function})", shown.display()), ours.is_some())
}

/// A function's name without its type parameters, which can run to several lines.
fn without_types(function: &str) -> String {
    match function.find('<') {
        None | Some(0) => function.to_owned(),
        Some(length) => function[..length].to_owned(),
    }
}

/// The path of a downloaded package's file, without the folders that cargo keeps packages in.
fn in_its_package(file: &str) -> &Path {
    let in_registry = file.split_once("/registry/src/").and_then(|(_, path)| path.split_once('/'));
    Path::new(in_registry.map_or(file, |(_registry, path)| path))
}

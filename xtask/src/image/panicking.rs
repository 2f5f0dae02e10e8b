//! Which panicking functions an image holds.
//!
//! The linker leaves out what cannot be reached, so that a function that is there can be called.
//! Every panic ends in the image's panic handler: where the handler is missing, nothing can panic.
//! The functions on the way to it say what kind of panic it is.

use super::Image;
use super::call_sites::CallSites;
use anyhow::Result;
use object::{Object, ObjectSymbol};
use rustc_demangle::demangle;

/// A panicking function that an image holds.
pub struct Panicking {
    /// Its name, demangled.
    pub function: String,
    /// Where it is called by functions that are not themselves on the way to a panic: source
    /// positions with the chain of inlined functions around them.
    pub sites: Vec<String>,
}

/// All panicking functions of an image, by name. None for an image that cannot panic.
pub fn panicking(image: &Image<'_>) -> Result<Vec<Panicking>> {
    let functions: Vec<_> = image
        .symbols()
        .filter(|symbol| symbol.is_definition())
        .filter_map(|symbol| Some((symbol.index(), readable(symbol.name().ok()?))))
        .filter(|(_, name)| is_panicking(name))
        .collect();
    if functions.is_empty() {
        return Ok(Vec::new());
    }
    let calls = CallSites::new(image)?;
    let mut found: Vec<_> = functions
        .into_iter()
        .map(|(index, function)| Panicking { function, sites: calls.of(index, is_panicking) })
        .collect();
    found.sort_by(|a, b| a.function.cmp(&b.function));
    Ok(found)
}

/// A symbol's name as it is written in the source, without the compiler's hash.
pub(super) fn readable(symbol: &str) -> String {
    format!("{:#}", demangle(symbol))
}

/// Whether a function, by its demangled name, does nothing but panic.
///
/// That is the panic handler (the image's, and the compiler's name for it), the module
/// `core::panicking`, and the functions outside it that format a message and go there: all have
/// names such as `slice_index_fail`, `unwrap_failed` or `panic_already_borrowed`.
pub(super) fn is_panicking(function: &str) -> bool {
    let in_core = function.starts_with("core::") || function.starts_with("<core::");
    let says_so = |name: &str| {
        name.starts_with("panic") || name.ends_with("_fail") || name.ends_with("_failed")
    };
    function == "panic_free::panic_reached"
        || function.ends_with("rust_begin_unwind")
        || in_core && function.split("::").any(says_so)
}

#[cfg(test)]
mod tests {
    use super::is_panicking;

    #[test]
    fn the_ways_to_panic_are_told_from_the_rest() {
        for name in [
            "panic_free::panic_reached",
            "__rustc::rust_begin_unwind",
            "core::panicking::panic_bounds_check",
            "core::slice::index::slice_index_fail::do_panic::runtime",
            "core::slice::index::slice_start_index_len_fail",
            "core::option::expect_failed",
            "core::option::unwrap_failed",
            "core::result::unwrap_failed",
            "core::cell::panic_already_borrowed",
            "<core::slice::Foo>::copy_from_slice::len_mismatch_fail",
        ] {
            assert!(is_panicking(name), "{name}");
        }
        for name in [
            "panic_free_tick::__cortex_m_rt_main",
            "panic_free::ROBOT",
            "surefoot::balance::fault::may_fail",
            "core::ptr::drop_in_place",
            "libm::math::sqrtf::sqrtf",
        ] {
            assert!(!is_panicking(name), "{name}");
        }
    }
}

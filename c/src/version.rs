//! Which version this is.

/// Version of this header: larger where calls or layouts have changed.
pub const SUREFOOT_VERSION_MAJOR: u32 = 0;
/// Version of this header: before 1.0 larger where calls or layouts have changed.
pub const SUREFOOT_VERSION_MINOR: u32 = 1;
/// Version of this header: larger where nothing of that has changed.
pub const SUREFOOT_VERSION_PATCH: u32 = 0;

/// As cargo writes it.
const fn number(text: &str) -> u32 {
    let (mut number, mut rest) = (0, text.as_bytes());
    while let [digit, more @ ..] = rest {
        number = 10 * number + (*digit - b'0') as u32;
        rest = more;
    }
    number
}

const _: () = assert!(
    SUREFOOT_VERSION_MAJOR == number(env!("CARGO_PKG_VERSION_MAJOR"))
        && SUREFOOT_VERSION_MINOR == number(env!("CARGO_PKG_VERSION_MINOR"))
        && SUREFOOT_VERSION_PATCH == number(env!("CARGO_PKG_VERSION_PATCH")),
    "these are the package's numbers: change them with its version, and make the header anew"
);

/// Version of the library: `MAJOR << 16 | MINOR << 8 | PATCH`. A program whose header says another major or, before
/// 1.0, another minor number must not call the rest.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_version() -> u32 {
    SUREFOOT_VERSION_MAJOR << 16 | SUREFOOT_VERSION_MINOR << 8 | SUREFOOT_VERSION_PATCH
}

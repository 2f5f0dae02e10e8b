//! The observer of disturbances has no panicking path.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    panic_free::opaque_observer();
    panic_free::halt()
}

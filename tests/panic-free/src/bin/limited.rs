//! A tick within limits has no panicking path, nor has the supervisor around it.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    panic_free::opaque_limited_tick();
    panic_free::halt()
}

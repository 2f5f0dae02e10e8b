//! A tick of the whole-body controller has no panicking path, nor has what finds a robot's legs.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    panic_free::opaque_whole_body_tick();
    panic_free::halt()
}

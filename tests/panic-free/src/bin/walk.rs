//! The planner of walks has no panicking path, nor has what measures a robot for it.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    panic_free::opaque_plan();
    panic_free::halt()
}

//! A tick in which feet press or swing has no panicking path, nor has what a planner reads of the motion.

#![cfg_attr(target_os = "none", no_std, no_main)]

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    panic_free::opaque_motion_tick();
    panic_free::halt()
}

//! Proof that the check can fail: a tick, and an index that the compiler cannot see to be in
//! bounds.

#![cfg_attr(target_os = "none", no_std, no_main)]

use core::hint::black_box;

#[cfg_attr(target_os = "none", cortex_m_rt::entry)]
fn main() -> ! {
    panic_free::opaque_tick();
    let torques = black_box([0.0_f32; 12]);
    black_box(torques[black_box(11)]);
    panic_free::halt()
}

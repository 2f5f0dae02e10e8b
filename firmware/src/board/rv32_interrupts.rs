//! The tick's interrupts on RISC-V: software's, and the core's timer's.

use core::arch::naked_asm;

/// riscv-rt's trap keeps the integer registers that a function may use; these keep the floating-point ones too, as
/// the tick computes with them while idle does.
macro_rules! keeping_floats {
    ($handler:ident) => {
        #[unsafe(no_mangle)]
        #[unsafe(naked)]
        extern "C" fn $handler() {
            naked_asm!(
                ".option push",
                ".option arch, +f",
                "addi sp, sp, -96",
                "sw ra, 0(sp)",
                "fsw ft0, 4(sp)",
                "fsw ft1, 8(sp)",
                "fsw ft2, 12(sp)",
                "fsw ft3, 16(sp)",
                "fsw ft4, 20(sp)",
                "fsw ft5, 24(sp)",
                "fsw ft6, 28(sp)",
                "fsw ft7, 32(sp)",
                "fsw ft8, 36(sp)",
                "fsw ft9, 40(sp)",
                "fsw ft10, 44(sp)",
                "fsw ft11, 48(sp)",
                "fsw fa0, 52(sp)",
                "fsw fa1, 56(sp)",
                "fsw fa2, 60(sp)",
                "fsw fa3, 64(sp)",
                "fsw fa4, 68(sp)",
                "fsw fa5, 72(sp)",
                "fsw fa6, 76(sp)",
                "fsw fa7, 80(sp)",
                "frcsr t0",
                "sw t0, 84(sp)",
                "call {tick}",
                "lw t0, 84(sp)",
                "fscsr t0",
                "flw ft0, 4(sp)",
                "flw ft1, 8(sp)",
                "flw ft2, 12(sp)",
                "flw ft3, 16(sp)",
                "flw ft4, 20(sp)",
                "flw ft5, 24(sp)",
                "flw ft6, 28(sp)",
                "flw ft7, 32(sp)",
                "flw ft8, 36(sp)",
                "flw ft9, 40(sp)",
                "flw ft10, 44(sp)",
                "flw ft11, 48(sp)",
                "flw fa0, 52(sp)",
                "flw fa1, 56(sp)",
                "flw fa2, 60(sp)",
                "flw fa3, 64(sp)",
                "flw fa4, 68(sp)",
                "flw fa5, 72(sp)",
                "flw fa6, 76(sp)",
                "flw fa7, 80(sp)",
                "lw ra, 0(sp)",
                "addi sp, sp, 96",
                "ret",
                ".option pop",
                tick = sym tick,
            )
        }
    };
}

keeping_floats!(MachineSoft);
keeping_floats!(MachineTimer);

extern "C" fn tick() {
    crate::plain::tick();
}

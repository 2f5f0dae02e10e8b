//! STM32F405 at 168 MHz. Section numbers are those of its reference manual, RM0090.
//!
//! | what | where |
//! |---|---|
//! | tick | interrupt TIM2, of that timer on the chip |
//! | link | USART1, PA9 out, PA10 in, 921600 baud, interrupt USART1 |
//! | motor enable | PB0, high while torques may differ from zero |
//! | clock | internal 16 MHz oscillator (±1 %) and PLL, so that any crystal will do |

use super::{Counter, Link, TickTimer};
use core::sync::atomic::{AtomicU32, Ordering};
use heapless::spsc::{Consumer, Producer, Queue};
use surefoot_link::LEGS;

pub use stm32f4::stm32f405 as device;

/// Received bytes on their way to idle: 2 ms of traffic at 921600 baud.
pub type ByteQueue = Queue<u8, BYTES>;
const BYTES: usize = 256;

/// Divides APB2's 84 MHz to 921600 baud: 91.15, by 16 at 1/16ths as §30.3.4 has it, is 0x05b.
const BAUD_921600: u16 = 91;

/// The board's parts, each for one owner.
pub struct Board {
    /// For the tick.
    pub timer: TickTimer,
    /// For everyone.
    pub counter: Counter,
    /// For the tick.
    pub motors: Motors,
    /// For the tick.
    pub watchdog: Watchdog,
    /// For the UART's interrupt.
    pub uart: UartReceiver,
    /// For idle.
    pub link: Link,
}

impl Board {
    /// Sets up clocks, pins and peripherals.
    pub fn start(
        device: device::Peripherals,
        core: cortex_m::Peripherals,
        bytes_in: Producer<'static, u8, BYTES>,
        bytes_out: Consumer<'static, u8, BYTES>,
    ) -> Self {
        let device::Peripherals { RCC, FLASH, GPIOA, GPIOB, TIM2, USART1, IWDG, .. } = device;
        // QEMU has no clock tree: to wait for the PLL there is to wait for ever.
        if cfg!(not(feature = "emulation")) {
            start_clock(&RCC, &FLASH);
        }
        RCC.ahb1enr().modify(|_, w| w.gpioaen().set_bit().gpioben().set_bit());
        RCC.apb1enr().modify(|_, w| w.tim2en().set_bit());
        RCC.apb2enr().modify(|_, w| w.usart1en().set_bit());
        // PB0: output, low. PA9, PA10: alternate function 7, USART1 (datasheet, table 9).
        GPIOB.bsrr().write(|w| w.br0().set_bit());
        GPIOB.moder().modify(|_, w| w.moder0().output());
        GPIOA.afrh().modify(|_, w| w.afrh9().af7().afrh10().af7());
        GPIOA.moder().modify(|_, w| w.moder9().alternate().moder10().alternate());

        // SAFETY: the divider is a number, and any is allowed.
        USART1.brr().write(|w| unsafe { w.bits(BAUD_921600) });
        USART1.cr1().write(|w| w.ue().set_bit().te().set_bit().re().set_bit().rxneie().set_bit());
        let counter = Counter::start(core);
        Self {
            timer: TickTimer::new(TIM2, counter),
            counter,
            motors: Motors { port: GPIOB },
            watchdog: Watchdog { registers: IWDG },
            uart: UartReceiver { bytes: bytes_in },
            link: Link::start(Uart { registers: USART1, bytes: bytes_out }),
        }
    }
}

/// 168 MHz from the internal oscillator: 16 MHz / 16 · 336 / 2 (§7.3.2), five wait states (§3.5.1).
fn start_clock(rcc: &device::RCC, flash: &device::FLASH) {
    flash.acr().write(|w| w.latency().ws5().prften().set_bit().icen().set_bit().dcen().set_bit());
    // SAFETY: 16, 336 and 7 are within the fields' ranges; PLLP = 0 stands for 2.
    rcc.pllcfgr().write(|w| unsafe {
        w.pllm().bits(16).plln().bits(336).pllp().div2().pllsrc().hsi().pllq().bits(7)
    });
    rcc.cr().modify(|_, w| w.pllon().set_bit());
    while rcc.cr().read().pllrdy().bit_is_clear() {}
    rcc.cfgr().modify(|_, w| w.hpre().div1().ppre1().div4().ppre2().div2());
    rcc.cfgr().modify(|_, w| w.sw().pll());
    while !rcc.cfgr().read().sws().is_pll() {}
}

/// When the present tick was due, in lock step.
static DUE: AtomicU32 = AtomicU32::new(0);

/// Runs the tick at once: its interrupt has the highest priority.
pub fn tick_now(counter: Counter) {
    DUE.store(counter.now(), Ordering::Relaxed);
    rtic::pend(device::Interrupt::TIM2);
    cortex_m::asm::isb();
}

/// Cost since [`tick_now`].
#[inline(always)]
pub fn since_due(counter: Counter) -> u32 {
    counter.since(DUE.load(Ordering::Relaxed))
}

/// Where torques go. This board has no drives: the pin says whether there may be torques, and the
/// link carries them.
pub struct Motors {
    port: device::GPIOB,
}

impl Motors {
    /// Torques in N·m, by leg from hip to foot.
    #[inline(always)]
    pub fn set(&mut self, _joint_torques: &[[f32; 6]; LEGS], is_enabled: bool) {
        self.port.bsrr().write(|w| if is_enabled { w.bs0().set_bit() } else { w.br0().set_bit() });
    }
}

/// Resets a firmware whose tick hangs. It starts with the first free-running tick, and then cannot be
/// stopped (§21.3).
pub struct Watchdog {
    registers: device::IWDG,
}

impl Watchdog {
    /// 32 kHz / 16, so that 100 counts are 50 ms; with `period`, in seconds, of at most 10 ms.
    pub fn start(&mut self) {
        self.registers.kr().write(|w| w.key().start());
        self.registers.kr().write(|w| w.key().unlock());
        self.registers.pr().write(|w| w.pr().divide_by16());
        self.registers.rlr().write(|w| w.rl().set(100));
        self.feed();
    }

    /// Not yet.
    #[inline(always)]
    pub fn feed(&mut self) {
        self.registers.kr().write(|w| w.key().feed());
    }
}

/// The receiving interrupt's end of the UART.
pub struct UartReceiver {
    bytes: Producer<'static, u8, BYTES>,
}

impl UartReceiver {
    /// One byte into the queue; a full queue loses it, and with it a frame, which is then counted.
    pub fn receive(&mut self) {
        // SAFETY: of USART1's registers only this reads the data register; reading it is what
        // acknowledges the interrupt.
        let byte = unsafe { (*device::USART1::ptr()).dr().read().dr().bits() };
        let _ = self.bytes.enqueue(byte as u8);
    }
}

/// Idle's end of the UART.
pub struct Uart {
    registers: device::USART1,
    bytes: Consumer<'static, u8, BYTES>,
}

impl Uart {
    /// What has arrived; sleeps until the next interrupt if there is nothing.
    pub fn receive(&mut self, buffer: &mut [u8]) -> usize {
        let mut received = 0;
        for place in buffer.iter_mut() {
            let Some(byte) = self.bytes.dequeue() else { break };
            *place = byte;
            received += 1;
        }
        // An emulator that sleeps lets time go by the clock on the wall.
        if received == 0 && cfg!(not(feature = "emulation")) {
            cortex_m::asm::wfi();
        }
        received
    }

    /// Waits while the line is busy: idle has nothing better to do.
    pub fn send(&mut self, bytes: &[u8]) {
        for byte in bytes {
            while self.registers.sr().read().txe().bit_is_clear() {}
            self.registers.dr().write(|w| w.dr().set(u16::from(*byte)));
        }
    }
}

/// Resets the chip. Memory keeps its contents.
pub fn restart() -> ! {
    cortex_m::peripheral::SCB::sys_reset()
}

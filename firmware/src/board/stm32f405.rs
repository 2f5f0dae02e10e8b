//! STM32F405 at 168 MHz. Section numbers are those of its reference manual, RM0090.
//!
//! | what | where |
//! |---|---|
//! | tick | interrupt TIM2, of that timer on the chip |
//! | link | USART1, PA9 out, PA10 in, 3 Mbaud, interrupt USART1 |
//! | motor enable | PB0, high while torques may differ from zero |
//! | clock | the crystal and PLL, or the internal oscillator (`stm32f4_clock.rs`) |
//! | µs | TIM5, which goes round after 71 minutes |

use super::{Counter, Link, MICROSECOND, TickTimer, stm32f4_clock, tick_timer};
use crate::robot::{FRAME, ROW, ROWS};
use heapless::spsc::{Consumer, Producer, Queue};
use surefoot_firmware::clock::divider;
use surefoot_firmware::uart::{self, Errors};
use surefoot_firmware::watchdog;
use surefoot_link::{BAUD, Clock, LineErrors};

pub use stm32f4::stm32f405 as device;

/// Received bytes on their way to idle. While idle sends the longest frame, at the line's rate or up to
/// half as slow for the ticks between, at most twice as many bytes come, at the same rate.
pub type ByteQueue = Queue<u8, BYTES>;
const BYTES: usize = 2 * FRAME;

/// Clock of USART1: APB2's, Hz.
const UART_HZ: u32 = 84_000_000;

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
    /// What it is clocked by.
    pub clock: Clock,
}

impl Board {
    /// Sets up clocks, pins and peripherals.
    pub fn start(
        device: device::Peripherals,
        core: cortex_m::Peripherals,
        bytes_in: Producer<'static, u8, BYTES>,
        bytes_out: Consumer<'static, u8, BYTES>,
    ) -> Self {
        let device::Peripherals {
            RCC, FLASH, GPIOA, GPIOB, TIM2, TIM5, TIM11, USART1, IWDG, ..
        } = device;
        // QEMU has no clock tree.
        let clock = if cfg!(feature = "emulation") {
            Clock::Emulated
        } else {
            stm32f4_clock::start(&RCC, &FLASH, &TIM11)
        };
        RCC.ahb1enr().modify(|_, w| w.gpioaen().set_bit().gpioben().set_bit());
        RCC.apb1enr().modify(|_, w| w.tim2en().set_bit().tim5en().set_bit());
        RCC.apb2enr().modify(|_, w| w.usart1en().set_bit());
        // PB0: output, low. PA9, PA10: alternate function 7, USART1 (datasheet, table 9).
        GPIOB.bsrr().write(|w| w.br0().set_bit());
        GPIOB.moder().modify(|_, w| w.moder0().output());
        // Pulled up, so that a line without a host is silent.
        GPIOA.pupdr().modify(|_, w| w.pupdr10().pull_up());
        GPIOA.afrh().modify(|_, w| w.afrh9().af7().afrh10().af7());
        GPIOA.moder().modify(|_, w| w.moder9().alternate().moder10().alternate());

        TIM5.psc().write(|w| w.psc().set(MICROSECOND - 1));
        // The divider takes effect with an update (section 18.3.1).
        TIM5.egr().write(|w| w.ug().set_bit());
        TIM5.cr1().write(|w| w.cen().set_bit());

        // SAFETY: the divider is a number, and any is allowed.
        USART1.brr().write(|w| unsafe { w.bits(const { divider(UART_HZ, BAUD) }) });
        USART1.cr1().write(|w| w.ue().set_bit().te().set_bit().re().set_bit().rxneie().set_bit());
        let counter = Counter::start(core);
        Self {
            timer: tick_timer(TIM2, counter),
            counter,
            motors: Motors { port: GPIOB },
            watchdog: Watchdog { registers: IWDG },
            uart: UartReceiver { bytes: bytes_in },
            link: super::link(Uart { registers: USART1, bytes: bytes_out }),
            clock,
        }
    }
}

/// µs since the reset.
#[inline(always)]
pub fn now_us() -> u32 {
    // SAFETY: a read without effect.
    unsafe { (*device::TIM5::ptr()).cnt().read().bits() }
}

/// Runs the tick at once: its interrupt has the highest priority.
#[inline(always)]
pub fn pend_tick() {
    rtic::pend(device::Interrupt::TIM2);
    cortex_m::asm::isb();
}

/// Where torques go. This board has no drives: the pin says whether there may be torques, and the
/// link carries them.
pub struct Motors {
    port: device::GPIOB,
}

impl Motors {
    /// Torques in N·m, by leg from hip to foot.
    #[inline(always)]
    pub fn set(&mut self, _joint_torques: &[[f32; ROW]; ROWS], is_enabled: bool) {
        self.port.bsrr().write(|w| if is_enabled { w.bs0().set_bit() } else { w.br0().set_bit() });
    }
}

/// No torque, at once and from anywhere: the safe state of this board.
pub fn motors_off() {
    // SAFETY: a write that resets one pin, and no other.
    unsafe { (*device::GPIOB::ptr()).bsrr().write(|w| w.br0().set_bit()) };
}

/// Resets a firmware whose tick hangs. It starts with the first free-running tick, and then cannot be
/// stopped (section 21.3).
pub struct Watchdog {
    registers: device::IWDG,
}

impl Watchdog {
    /// Waits for three periods of this many µs at least, from now on. It is in standby; setting the
    /// registers takes up to five periods of the slow oscillator, 0.3 ms.
    pub fn start(&mut self, period_us: u32) {
        let Some(setting) = watchdog::Watchdog::covering(period_us) else { return };
        self.registers.kr().write(|w| w.key().start());
        self.registers.kr().write(|w| w.key().unlock());
        self.await_update();
        self.registers.pr().write(|w| w.pr().set(setting.prescaler));
        self.registers.rlr().write(|w| w.rl().set(setting.reload));
        // Fed before, it would count down from the old number (section 21.4.4).
        self.await_update();
        self.feed();
    }

    /// Not for ever, should the oscillator be dead: 20 000 reads take a millisecond.
    fn await_update(&self) {
        let is_updating = || {
            let status = self.registers.sr().read();
            status.pvu().bit_is_set() || status.rvu().bit_is_set()
        };
        for _ in 0..20_000 {
            if !is_updating() {
                break;
            }
        }
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

static ERRORS: Errors = Errors::new();

/// What the UART has found wrong.
pub fn line_errors() -> LineErrors {
    ERRORS.tally()
}

/// The UART's registers, as its interrupt sees them.
struct Usart1;

impl uart::Registers for Usart1 {
    #[inline(always)]
    fn status(&self) -> u32 {
        // SAFETY: of all others only `Uart::send` reads it, which the interrupt can interrupt, and not
        // the other way round: so no flag is cleared that the interrupt has not seen.
        unsafe { (*device::USART1::ptr()).sr().read().bits().into() }
    }

    #[inline(always)]
    fn data(&self) -> u32 {
        // SAFETY: nothing else reads it.
        unsafe { (*device::USART1::ptr()).dr().read().bits().into() }
    }
}

impl UartReceiver {
    /// One byte into the queue; a full queue loses it, and with it a frame, which is then counted.
    #[inline(always)]
    pub fn receive(&mut self) {
        if let Some(byte) = uart::receive(&Usart1, &ERRORS)
            && self.bytes.enqueue(byte).is_err()
        {
            ERRORS.note_unqueued();
        }
    }
}

/// Idle's end of the UART.
pub struct Uart {
    registers: device::USART1,
    bytes: Consumer<'static, u8, BYTES>,
}

impl Uart {
    /// Whether something has arrived.
    pub fn has_bytes(&self) -> bool {
        self.bytes.ready()
    }

    /// What has arrived.
    pub fn receive(&mut self, buffer: &mut [u8]) -> usize {
        let mut received = 0;
        for place in buffer.iter_mut() {
            let Some(byte) = self.bytes.dequeue() else { break };
            *place = byte;
            received += 1;
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

//! Every order of orders, ticks, and records of ticks: an order to configure is answered with *done*
//! if, and only if, the tick takes it.

use std::collections::VecDeque;
use surefoot::balance::Mode;
use surefoot_firmware::orders::Orders;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Order {
    Configure,
    Arm,
    Disarm,
}

/// What can happen next.
#[derive(Clone, Copy, Debug)]
enum Event {
    /// The host sends it, and idle answers.
    Sent(Order),
    /// The timer's tick: it takes all orders, and leaves a record.
    Tick,
    /// The timer's tick, which finds a reason to stop.
    Stop,
    /// Idle takes a record.
    Record,
}

const EVENTS: [Event; 6] = [
    Event::Sent(Order::Configure),
    Event::Sent(Order::Arm),
    Event::Sent(Order::Disarm),
    Event::Tick,
    Event::Stop,
    Event::Record,
];

/// Places in each queue, as in the firmware.
const PLACES: usize = 3;

struct Target {
    orders: Orders,
    queue: VecDeque<Order>,
    records: VecDeque<(u32, Mode)>,
    mode: Mode,
    taken: u32,
    /// Orders to configure that were answered with *done*, and that a tick has taken in standby.
    done: u32,
    configured: u32,
    refused: u32,
}

impl Target {
    fn happens(&mut self, event: Event) {
        match event {
            Event::Sent(order) => {
                let is_possible = self.queue.len() < PLACES;
                if !is_possible || order == Order::Configure && !self.orders.is_standby() {
                    return;
                }
                self.done += u32::from(order == Order::Configure);
                self.queue.push_back(order);
                self.orders.note_sent(order == Order::Arm);
            }
            Event::Tick | Event::Stop => {
                while let Some(order) = self.queue.pop_front() {
                    self.take(order);
                }
                if matches!(event, Event::Stop) && self.mode == Mode::Active {
                    self.mode = Mode::Stopped;
                }
                // A full queue loses the newest.
                if self.records.len() < PLACES {
                    self.records.push_back((self.taken, self.mode));
                }
            }
            Event::Record => {
                if let Some((taken, mode)) = self.records.pop_front() {
                    self.orders.note_tick(taken, mode);
                }
            }
        }
    }

    fn take(&mut self, order: Order) {
        self.taken = self.taken.wrapping_add(1);
        match order {
            Order::Configure if self.mode == Mode::Standby => self.configured += 1,
            Order::Configure => self.refused += 1,
            Order::Arm => self.mode = Mode::Active,
            Order::Disarm => self.mode = Mode::Standby,
        }
    }
}

#[test]
fn done_means_done_in_every_order_of_events() {
    const LENGTH: u32 = 8;
    let mut configured = 0;
    for history in 0..6_usize.pow(LENGTH) {
        let mut target = Target {
            orders: Orders::new(),
            queue: VecDeque::new(),
            records: VecDeque::new(),
            mode: Mode::Standby,
            taken: 0,
            done: 0,
            configured: 0,
            refused: 0,
        };
        for place in 0..LENGTH {
            target.happens(EVENTS[history / 6_usize.pow(place) % 6]);
        }
        target.happens(Event::Tick);
        assert_eq!((target.configured, target.refused), (target.done, 0), "history {history}");
        configured += u64::from(target.configured);
    }
    assert!(configured > 100_000, "{configured}");
}

/// It is never refused for ever: with all records taken, standby is known as such.
#[test]
fn standby_is_known_once_all_is_taken() {
    let mut orders = Orders::new();
    orders.note_sent(true);
    // A tick before the order was taken.
    orders.note_tick(0, Mode::Standby);
    assert!(!orders.is_standby(), "armed by the next tick");
    orders.note_tick(1, Mode::Active);
    assert!(!orders.is_standby());
    orders.note_sent(false);
    orders.note_tick(2, Mode::Standby);
    assert!(orders.is_standby());
}

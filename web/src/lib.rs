//! What the page of a browser calls: a scene is started, pushed and advanced, and what there is to see comes back as
//! JSON. The page and this module share one buffer of text; a page has one scene at a time.
//!
//! ```text
//! page: write request ─► surefoot_start ─► answer (what stands still)
//!       surefoot_push, surefoot_advance ─► answer (what moves)
//! ```

// The interface of a module of WebAssembly is addresses and lengths. They are looked at in this file alone.
#![allow(unsafe_code)]

mod frame;
mod live;
mod request;

pub use frame::{Frame, Still};
pub use live::Live;
pub use request::Request;

use serde::Serialize;
use std::cell::RefCell;

#[derive(Default)]
struct Page {
    text: Vec<u8>,
    live: Option<Live>,
}

thread_local! {
    static PAGE: RefCell<Page> = RefCell::default();
}

/// Makes room for a request of so many bytes, and tells where.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_room(bytes: usize) -> *mut u8 {
    PAGE.with_borrow_mut(|page| {
        page.text.clear();
        page.text.resize(bytes, 0);
        page.text.as_mut_ptr()
    })
}

/// Where the last answer is.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_answer() -> *const u8 {
    PAGE.with_borrow(|page| page.text.as_ptr())
}

/// Starts the scene that the request names.
///
/// # Returns
/// The length of the answer in bytes: a [`Still`], or `{"error": …}`.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_start() -> usize {
    PAGE.with_borrow_mut(|page| {
        let started = Request::read(&page.text).and_then(|request| Live::start(&request));
        let answer = started.map(|live| {
            let still = live.still();
            page.live = Some(live);
            still
        });
        respond(&mut page.text, answer)
    })
}

/// Pushes the central body from now on for 0.1 s, N·s along the world's axes. Of no effect before a start.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_push(x: f64, y: f64, z: f64) {
    PAGE.with_borrow_mut(|page| {
        if let Some(live) = &mut page.live {
            live.push([x, y, z]);
        }
    });
}

/// Goes on for so many simulated seconds, 0.1 at most, or until the run ends.
///
/// # Returns
/// The length of the answer in bytes: a [`Frame`], or `{"error": …}`.
#[unsafe(no_mangle)]
pub extern "C" fn surefoot_advance(seconds: f64) -> usize {
    PAGE.with_borrow_mut(|page| {
        let answer = match &mut page.live {
            None => Err("no scene has been started".to_owned()),
            Some(live) => {
                live.advance(seconds.clamp(0.0, 0.1));
                live.frame()
            }
        };
        respond(&mut page.text, answer)
    })
}

fn respond(text: &mut Vec<u8>, answer: Result<impl Serialize, String>) -> usize {
    let written = answer.and_then(|answer| serde_json::to_vec(&answer).map_err(|e| e.to_string()));
    // A text is always written.
    *text =
        written.unwrap_or_else(|error| serde_json::json!({ "error": error }).to_string().into());
    text.len()
}

//! Which samples are enough to play a run.

use crate::record::Sample;

/// Frames a second that nobody's eye or screen tells apart from more.
const MOST_PER_SECOND: f64 = 200.0;

/// Frames of a long run: more would make its page slow to open.
const MOST_FRAMES: usize = 2000;

/// Every n-th sample's index, and the last one.
pub fn frames(samples: &[Sample]) -> Vec<usize> {
    let (Some(first), Some(last)) = (samples.first(), samples.last()) else { return Vec::new() };
    let intervals = samples.len() - 1;
    let seconds = last.time_s - first.time_s;
    let most = ((MOST_PER_SECOND * seconds).ceil() as usize).clamp(1, MOST_FRAMES);
    let every = intervals.div_ceil(most).max(1);
    let mut frames: Vec<usize> = (0..samples.len()).step_by(every).collect();
    if frames.last() != Some(&intervals) {
        frames.push(intervals);
    }
    frames
}

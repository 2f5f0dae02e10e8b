//! Which samples are enough to play a run.

/// Frames a second that nobody's eye or screen tells apart from more.
const MOST_PER_SECOND: f64 = 200.0;

/// Frames of a long run: more would make its page slow to open.
const MOST_FRAMES: usize = 2000;

/// Poses in all frames, likewise.
const MOST_POSES: usize = 300_000;

/// Frames that a motion is still seen in.
const LEAST_FRAMES: usize = 50;

/// Every n-th of these times (s) by its index, and the last one, for so many bodies.
pub fn frames(times: &[f64], bodies: usize) -> Vec<usize> {
    let (Some(first), Some(last)) = (times.first(), times.last()) else { return Vec::new() };
    let intervals = times.len() - 1;
    let affordable = (MOST_POSES / bodies.max(1)).clamp(LEAST_FRAMES, MOST_FRAMES);
    let most = ((MOST_PER_SECOND * (last - first)).ceil() as usize).clamp(1, affordable);
    let every = intervals.div_ceil(most).max(1);
    let mut frames: Vec<usize> = (0..times.len()).step_by(every).collect();
    if frames.last() != Some(&intervals) {
        frames.push(intervals);
    }
    frames
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_few_enough_and_have_both_ends() {
        let of = |count: u32, rate: f64| -> Vec<usize> {
            let times: Vec<f64> = (0..count).map(|k| f64::from(k) / rate).collect();
            frames(&times, 13)
        };
        assert_eq!(of(0, 500.0), [0; 0]);
        assert_eq!(of(1, 500.0), [0]);
        assert_eq!(of(12, 100.0), (0..12).collect::<Vec<_>>());
        assert_eq!(of(12, 500.0), [0, 3, 6, 9, 11]);
        let long = of(60_001, 500.0);
        assert!(long.len() <= MOST_FRAMES + 1 && long.last() == Some(&60_000));
        let times: Vec<f64> = (0..4000).map(|k| f64::from(k) / 100.0).collect();
        assert_eq!(frames(&times, 1_000_000).len(), LEAST_FRAMES + 1);
    }
}

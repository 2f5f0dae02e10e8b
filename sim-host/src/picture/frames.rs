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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_few_enough_and_have_both_ends() {
        let sample = |time_s: f64| Sample {
            time_s,
            positions: vec![0.0; 19],
            velocities: vec![0.0; 18],
            torques: vec![0.0; 12],
            desired_wrench: [0.0; 6],
            position_error: [0.0; 3],
            orientation_error: [1.0, 0.0, 0.0, 0.0],
            foot_forces: vec![0.0; 2],
            contacts: None,
            energy: [0.0; 2],
            corner_forces: None,
            block: None,
        };
        let of = |count: u32, rate: f64| -> Vec<usize> {
            let samples: Vec<Sample> = (0..count).map(|k| sample(f64::from(k) / rate)).collect();
            frames(&samples)
        };
        assert_eq!(of(0, 500.0), [0; 0]);
        assert_eq!(of(1, 500.0), [0]);
        assert_eq!(of(12, 100.0), (0..12).collect::<Vec<_>>());
        assert_eq!(of(12, 500.0), [0, 3, 6, 9, 11]);
        let long = of(60_001, 500.0);
        assert!(long.len() <= MOST_FRAMES + 1 && long.last() == Some(&60_000));
    }
}

//! Instructions of ticks, by callgrind on this program itself: what a run with one pass through the states executes
//! more than one with none is that pass's ticks, and nothing else.

use super::controller_form::ControllerForm;
use crate::callgrind::CountFailure;
use crate::callgrind::instructions;
use std::ffi::OsStr;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use surefoot_sim::closed_loop::Controller;
use surefoot_sim::plant::PlantState;

/// Passes a controller through all states, again and again.
pub fn pass(controller: &mut dyn Controller, states: &[PlantState], passes: u32) {
    for _ in 0..passes {
        for state in states {
            // A fault takes its instructions too.
            let _ = black_box(controller.tick(black_box(state)));
        }
    }
}

/// States in a file, for the program that is counted; gone when this is.
pub(super) struct StatesFile {
    path: PathBuf,
    states: usize,
}

impl StatesFile {
    pub fn write(states: &[PlantState]) -> std::io::Result<Self> {
        let path = std::env::temp_dir().join(format!("surefoot-{}.states", std::process::id()));
        let numbers =
            states.iter().flat_map(|state| state.positions.iter().chain(&state.velocities));
        let bytes: Vec<u8> = numbers.flat_map(|x| x.to_le_bytes()).collect();
        std::fs::write(&path, bytes)?;
        Ok(Self { path, states: states.len() })
    }

    /// Instructions of a tick of each form, the mean over all states.
    pub fn count(&self, forms: &[ControllerForm]) -> Result<Vec<u64>, CountFailure> {
        let total = |form: &ControllerForm, passes: &str| {
            let form = form.arguments();
            let mut all: Vec<&OsStr> = ["count-ticks", "--passes", passes].map(OsStr::new).into();
            all.extend(form.iter().map(OsStr::new));
            all.push(self.path.as_os_str());
            instructions(&all)
        };
        let counts = forms.iter().map(|form| {
            let (none, one) = (total(form, "0")?, total(form, "1")?);
            Ok(one.saturating_sub(none) / self.states.max(1) as u64)
        });
        counts.collect()
    }
}

impl Drop for StatesFile {
    fn drop(&mut self) {
        // It may be gone already.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// The states of such a file.
///
/// # Errors
/// Where it cannot be read, or is of another length.
pub fn read_states(path: &Path) -> std::io::Result<Vec<PlantState>> {
    let home =
        PlantState::home(surefoot_sim::robot::biped(surefoot_sim::scene::Outline::A).joint_count());
    let (coordinates, velocities) = (home.positions.len(), home.velocities.len());
    let all = coordinates + velocities;
    let bytes = std::fs::read(path)?;
    let (numbers, odd) = bytes.as_chunks::<8>();
    if !odd.is_empty() || numbers.len() % all != 0 {
        let reason = format!("not a whole number of states of {all} numbers");
        return Err(std::io::Error::new(std::io::ErrorKind::InvalidData, reason));
    }
    let number = |k: usize| f64::from_le_bytes(numbers[k]);
    let state = |first: usize| PlantState {
        positions: (0..coordinates).map(|i| number(first + i)).collect(),
        velocities: (0..velocities).map(|i| number(first + coordinates + i)).collect(),
    };
    Ok((0..numbers.len()).step_by(all).map(state).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use surefoot_sim::scene::load;

    #[test]
    fn states_are_read_as_they_were_written() {
        let first = load("experiment-1").expect("built in").initial.state();
        let mut second = first.clone();
        second.velocities[17] = -0.1;
        let file = StatesFile::write(&[first.clone(), second.clone()]).expect("written");
        assert_eq!(read_states(&file.path).expect("read"), [first, second]);
        std::fs::write(&file.path, [0; 12]).expect("written");
        assert!(read_states(&file.path).is_err());
        let path = file.path.clone();
        drop(file);
        assert!(!path.exists());
    }
}

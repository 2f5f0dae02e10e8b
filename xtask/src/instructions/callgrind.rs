//! Instructions of one call, all together and by source file.

use crate::step::Step;
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;

/// Calls in the shorter run. Every call is like the others, so that a few will do.
const CALLS: u64 = 10;

/// Seconds for one run; the longest takes two.
const RUN_LIMIT: u64 = 120;

/// Instructions.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// All.
    pub total: u64,
    /// By source file, code that was inlined elsewhere included.
    pub by_file: BTreeMap<String, u64>,
}

impl Counts {
    /// Of one call of a workload: what a run with twice the calls executes more, shared among them.
    pub fn of_call(program: &Path, workload: &str) -> Result<Self> {
        let file = program.with_extension("callgrind");
        let run = |calls: u64| -> Result<Self> {
            Step::new("valgrind", ["--quiet", "--tool=callgrind"])
                .args([format!("--callgrind-out-file={}", file.display())])
                .args([program])
                .args([workload, &calls.to_string()])
                .within(RUN_LIMIT)
                .read()?;
            let text = std::fs::read_to_string(&file)
                .with_context(|| format!("callgrind has not written {}", file.display()))?;
            Self::read(&text).with_context(|| format!("{} has no total", file.display()))
        };
        let (once, twice) = (run(CALLS)?, run(2 * CALLS)?);
        let share = |twice: u64, once: u64| twice.saturating_sub(once) / CALLS;
        let of_file = |(file, count): (&String, &u64)| {
            (file.clone(), share(*count, once.by_file.get(file).copied().unwrap_or(0)))
        };
        Ok(Self {
            total: share(twice.total, once.total),
            by_file: twice.by_file.iter().map(of_file).collect(),
        })
    }

    /// Of all files with this in their path.
    pub fn within(&self, path: &str) -> u64 {
        self.by_file.iter().filter(|(file, _)| file.contains(path)).map(|(_, count)| count).sum()
    }

    /// From a file of callgrind's; none if it has no total.
    ///
    /// A line `fl=`, `fi=` or `fe=` names the file of the costs that follow, by number and at first by name as
    /// well; the cost after a line `calls=` is that of the function called, which has its own lines. A cost has
    /// the number of its source line before it, or what that differs by from the last one. Line 0 is a
    /// compiler's for instructions that belong to no line, as where branches were joined: they are in no file.
    fn read(text: &str) -> Option<Self> {
        let mut names: BTreeMap<&str, &str> = BTreeMap::new();
        let mut counts = Self::default();
        let mut here = "";
        let mut at: i64 = 0;
        let mut is_of_callee = false;
        for line in text.lines() {
            if let Some(total) = line.strip_prefix("totals: ") {
                counts.total = total.trim().parse().ok()?;
            } else if let Some((key, file)) = line.split_once('=') {
                is_of_callee = key == "calls";
                if !matches!(key, "fl" | "fi" | "fe" | "cfl" | "cfi") {
                    continue;
                }
                let (number, name) = file.split_once(' ').unwrap_or((file, ""));
                if !name.is_empty() {
                    names.insert(number, name);
                }
                if !key.starts_with('c') {
                    here = names.get(number).copied().unwrap_or(file);
                }
            } else if let Some((position, cost)) = line.split_once(' ')
                && let Ok(cost) = cost.trim().parse::<u64>()
                && let Some(position) = moved(at, position)
            {
                at = position;
                if !std::mem::take(&mut is_of_callee) && at != 0 {
                    let sum: &mut u64 = counts.by_file.entry(here.to_owned()).or_default();
                    *sum += cost;
                }
            }
        }
        (counts.total > 0).then_some(counts)
    }
}

/// A source line: its number, or `+n`, `-n`, `*` from the last one; none where it is neither.
fn moved(last: i64, position: &str) -> Option<i64> {
    match position.as_bytes().first()? {
        b'*' => Some(last),
        // `parse` takes either sign.
        b'+' | b'-' => Some(last + position.parse::<i64>().ok()?),
        _ => position.parse().ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::Counts;

    const FILE: &str = "# callgrind format\nevents: Ir\n\nfl=(1) /src/step.rs\nfn=(1) step\n10 100\n\
        +2 30\nfi=(2) /src/contact/point.rs\n7 5\n-7 4\nfe=(1)\n12 1\ncfi=(3) /src/loops.rs\ncfn=(2) solve\n\
        calls=1 3\n* 900\n+1 2\n\nfl=(3)\nfn=(2)\n3 900\n\ntotals: 1042\n";

    #[test]
    fn costs_belong_to_the_file_of_their_line() {
        let counts = Counts::read(FILE).expect("a total");
        assert_eq!(counts.total, 1042);
        assert_eq!(counts.within("step.rs"), 133);
        assert_eq!(counts.within("contact/"), 5);
        assert_eq!(counts.within("loops.rs"), 900);
        assert_eq!(counts.by_file.values().sum::<u64>() + 4, counts.total, "but for line 0");
        assert_eq!(Counts::read("summary: 7\n"), None);
    }
}

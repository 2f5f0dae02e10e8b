//! Rows as people read them, and a run as IFToMM's library takes it.

use super::play::Played;
use super::row::Row;
use std::fmt::Write;

fn number(x: Option<f64>) -> String {
    x.map_or_else(|| "none".to_owned(), |x| format!("{x:.1e}"))
}

/// A table in Markdown, with what is missed below it.
pub fn table(rows: &[Row]) -> String {
    let mut out = String::from(
        "| problem | method, step | error | bar | meets | s | advised | error | s | MuJoCo |\n\
         |---|---|---:|---:|---|---:|---|---:|---:|---:|\n",
    );
    // Writing to a string cannot fail.
    for row in rows {
        let step = match (&row.method, row.step_s) {
            (Some(method), Some(step)) => format!("{method}, {step:.3e} s"),
            _ => "none".to_owned(),
        };
        let advised = row.advised.as_ref();
        let by = advised.and_then(|advised| Some((advised.method.as_ref()?, advised.step_s?)));
        let by = by.map_or_else(|| "–".to_owned(), |(name, step)| format!("{name}, {step:.1e} s"));
        let seconds = |x: Option<f64>| x.map_or_else(|| "–".to_owned(), |x| format!("{x:.2}"));
        let _ = writeln!(
            out,
            "| {} | {step} | {} | {:.0e} | {} | {} | {by} | {} | {} | {} |",
            row.name,
            number(row.error),
            row.bar,
            if row.meets { "yes" } else { "no" },
            seconds(row.wall_s),
            number(advised.and_then(|advised| advised.error)),
            seconds(advised.and_then(|advised| advised.wall_s)),
            row.peers.get("mujoco").map_or_else(|| "–".to_owned(), |peer| number(peer.error)),
        );
    }
    let met = rows.iter().filter(|row| row.meets).count();
    let _ = writeln!(out, "\n{met} of {} meet their bar.", rows.len());
    for row in rows.iter().filter(|row| !row.meets) {
        let why = row.reason.as_deref().unwrap_or("its error is larger than the bar");
        let _ = writeln!(out, "- {}: {why}", row.name);
    }
    out
}

/// Time, and coordinates of all mass centres: one line an instant, as results are submitted.
pub fn iftomm_text(played: &Played) -> String {
    let mut out = String::from("time");
    // Writing to a string cannot fail.
    for body in &played.bodies {
        let name = body.replace(' ', "_");
        let _ = write!(out, "\t{name}_x\t{name}_y\t{name}_z");
    }
    out.push_str("\tenergy\n");
    for trace in &played.traces {
        let _ = write!(out, "{:.9e}", trace.time_s);
        for state in trace.configuration.as_chunks::<7>().0 {
            let [x, y, z, ..] = state;
            let _ = write!(out, "\t{x:.15e}\t{y:.15e}\t{z:.15e}");
        }
        let _ = writeln!(out, "\t{:.15e}", trace.energy);
    }
    out
}

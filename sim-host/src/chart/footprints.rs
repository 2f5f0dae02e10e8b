//! A walk seen from above: where feet stood, how the centre of pressure went, and the capture point before it.
//!
//! One scale in both directions, the way ahead to the right; a long way in strips, one below the other.

use nalgebra::{Rotation2, Vector2};
use std::fmt::Write;
use surefoot_sim::picture::OKABE_ITO;
use surefoot_sim::record::{Sample, center_of_pressure};
use surefoot_sim::robot::Robot;

/// Pixels.
const WIDTH: f64 = 900.0;
const MARGIN: f64 = 24.0;
const HEAD: f64 = 62.0;
/// A strip is at most so long, m, in heights of the robot's central body; and there are at most so many.
const STRIP: f64 = 2.6;
const STRIPS: f64 = 8.0;
/// A foot stands that carries this share of the weight for so long, s.
const STANDS: f64 = 0.05;
const LEAST_S: f64 = 0.04;

/// A foot on the ground.
struct Footprint {
    foot: usize,
    /// Around it, in the picture's axes, m.
    outline: Vec<Vector2<f64>>,
}

/// What there is to draw, in the picture's axes, m.
struct Walk {
    prints: Vec<Footprint>,
    pressure: Vec<Option<Vector2<f64>>>,
    capture: Vec<Option<Vector2<f64>>>,
}

/// The picture as SVG; `None` of a run of whose ground and capture point nothing is recorded.
pub fn footprints(of: &str, robot: &Robot, samples: &[Sample]) -> Option<String> {
    let noted = |sample: &Sample| {
        sample.note.as_ref().and_then(|note| note.capture_point).map(Vector2::from)
    };
    samples.iter().find_map(noted)?;
    let (first, last) = (samples.first()?, samples.last()?);
    let at = |sample: &Sample| Vector2::new(sample.positions[0], sample.positions[1]);
    let way = at(last) - at(first);
    let ahead = if way.norm() > first.positions[2] { way.y.atan2(way.x) } else { 0.0 };
    let turn = Rotation2::new(-ahead);
    let walk = Walk {
        prints: prints(robot, samples, &turn),
        pressure: samples.iter().map(|s| Some(turn * center_of_pressure(robot, s)?)).collect(),
        capture: samples.iter().map(|s| Some(turn * noted(s)?)).collect(),
    };
    Some(drawn(of, robot, &walk, first.positions[2]))
}

/// Each foot's outline in the middle of each time for which it stands.
fn prints(robot: &Robot, samples: &[Sample], turn: &Rotation2<f64>) -> Vec<Footprint> {
    let least = STANDS * robot.tree.mass() * robot.tree.gravity().norm();
    let mut prints = Vec::new();
    for (foot, own) in robot.feet.iter().enumerate() {
        let stands = |sample: &Sample| sample.foot_forces.get(foot).is_some_and(|f| *f > least);
        for time in samples.chunk_by(|a, b| stands(a) == stands(b)) {
            let [begin, .., end] = time else { continue };
            if !stands(begin) || end.time_s - begin.time_s < LEAST_S {
                continue;
            }
            let Ok(poses) = robot.tree.body_poses(&time[time.len() / 2].positions) else {
                continue;
            };
            let Some(pose) = poses.get(own.body) else { continue };
            let points = own.points.iter().map(|p| turn * pose.transform_point(p.at).xy());
            prints.push(Footprint { foot, outline: around(points.collect()) });
        }
    }
    prints
}

/// Points in order about their middle.
fn around(mut points: Vec<Vector2<f64>>) -> Vec<Vector2<f64>> {
    let middle = points.iter().sum::<Vector2<f64>>() / points.len().max(1) as f64;
    let angle = |p: &Vector2<f64>| (p.y - middle.y).atan2(p.x - middle.x);
    points.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    points
}

fn drawn(of: &str, robot: &Robot, walk: &Walk, height: f64) -> String {
    let all = walk.prints.iter().flat_map(|print| &print.outline);
    let all = all.chain(walk.pressure.iter().flatten()).chain(walk.capture.iter().flatten());
    let (mut least, mut most) = (Vector2::repeat(f64::INFINITY), Vector2::repeat(-f64::INFINITY));
    for point in all {
        (least, most) = (least.inf(point), most.sup(point));
    }
    let room = 0.05 * height;
    let (least, most) = (least.add_scalar(-room), most.add_scalar(room));
    let strips = ((most.x - least.x) / (STRIP * height)).ceil().clamp(1.0, STRIPS);
    let length = (most.x - least.x) / strips;
    let scale = (WIDTH - 2.0 * MARGIN) / length;
    let tall = scale * (most.y - least.y);
    let total = HEAD + strips * (tall + MARGIN);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{total:.0}\" \
         viewBox=\"0 0 {WIDTH} {total:.0}\" font-family=\"sans-serif\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"{:.0}\" y=\"24\" font-size=\"20\" text-anchor=\"middle\">{}: steps from above</text>\n",
        0.5 * WIDTH,
        escaped(of),
    );
    legend(&mut svg, robot, scale);
    for strip in 0..strips as usize {
        let from = least.x + length * strip as f64;
        let top = HEAD + strip as f64 * (tall + MARGIN);
        // The world's second axis is up in the picture.
        let place =
            |p: &Vector2<f64>| (MARGIN + scale * (p.x - from), top + scale * (most.y - p.y));
        let wide = scale * length;
        let _ = writeln!(
            svg,
            "<clipPath id=\"strip-{strip}\"><rect x=\"{MARGIN}\" y=\"{top:.1}\" width=\"{wide:.1}\" \
             height=\"{tall:.1}\"/></clipPath>\n\
             <rect x=\"{MARGIN}\" y=\"{top:.1}\" width=\"{wide:.1}\" height=\"{tall:.1}\" fill=\"none\" \
             stroke=\"#ccc\"/>\n<g clip-path=\"url(#strip-{strip})\">",
        );
        for print in &walk.prints {
            let mut points = String::new();
            for point in &print.outline {
                let (x, y) = place(point);
                let _ = write!(points, "{x:.1},{y:.1} ");
            }
            let colour = colour(print.foot);
            // A point foot is a dot.
            let dot = 0.008 * height * scale;
            let width = if print.outline.len() < 2 { dot } else { 1.2 };
            let points = if print.outline.len() < 2 { points.repeat(2) } else { points };
            let _ = writeln!(
                svg,
                "<polygon points=\"{}\" fill=\"{colour}\" fill-opacity=\"0.18\" stroke=\"{colour}\" \
                 stroke-width=\"{width:.1}\" stroke-linejoin=\"round\"/>",
                points.trim_end(),
            );
        }
        for (points, style) in [(&walk.capture, CAPTURE), (&walk.pressure, PRESSURE)] {
            for run in points.split(Option::is_none).filter(|run| run.len() > 1) {
                let mut path = String::new();
                for point in thinned(run) {
                    let (x, y) = place(&point);
                    if (-WIDTH..2.0 * WIDTH).contains(&x) {
                        let _ = write!(path, "{x:.1},{y:.1} ");
                    }
                }
                let path = path.trim_end();
                let _ = writeln!(svg, "<polyline points=\"{path}\" fill=\"none\" {style}/>");
            }
        }
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

const PRESSURE: &str = "stroke=\"#000\" stroke-width=\"1.2\"";
const CAPTURE: &str = "stroke=\"#a0487c\" stroke-width=\"1.6\" stroke-dasharray=\"5 3\"";

/// Points that are a millimetre or more from the one before.
fn thinned(run: &[Option<Vector2<f64>>]) -> Vec<Vector2<f64>> {
    let mut kept: Vec<Vector2<f64>> = Vec::new();
    for point in run.iter().flatten() {
        if kept.last().is_none_or(|last| (last - point).norm() > 1e-3) {
            kept.push(*point);
        }
    }
    kept
}

fn legend(svg: &mut String, robot: &Robot, scale: f64) {
    let mut x = MARGIN;
    let mut entry = |svg: &mut String, mark: String, name: &str| {
        let _ = writeln!(
            svg,
            "<g transform=\"translate({x:.0} 46)\">{mark}<text x=\"28\" y=\"4\" font-size=\"14\">{}</text></g>",
            escaped(name),
        );
        x += 40.0 + 7.4 * name.chars().count() as f64;
    };
    for (foot, own) in robot.feet.iter().enumerate() {
        let colour = colour(foot);
        let mark = format!(
            "<rect y=\"-6\" width=\"22\" height=\"12\" fill=\"{colour}\" fill-opacity=\"0.18\" stroke=\"{colour}\"/>"
        );
        entry(svg, mark, &own.name);
    }
    for (style, name) in [(PRESSURE, "centre of pressure"), (CAPTURE, "capture point")] {
        entry(svg, format!("<line x2=\"22\" {style}/>"), name);
    }
    // A bar of 10 or 50 cm.
    let (metres, words) = if scale > 400.0 { (0.1, "10 cm") } else { (0.5, "50 cm") };
    let end = WIDTH - MARGIN;
    let begin = end - metres * scale;
    let _ = writeln!(
        svg,
        "<path d=\"M{begin:.1} 42v8m0-4H{end:.1}m0-4v8\" stroke=\"#333\" fill=\"none\"/>\
         <text x=\"{end:.1}\" y=\"36\" font-size=\"12\" text-anchor=\"end\">{words}</text>",
    );
}

/// Of feet by number.
fn colour(foot: usize) -> String {
    let (r, g, b) = OKABE_ITO[foot % OKABE_ITO.len()];
    format!("#{r:02x}{g:02x}{b:02x}")
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

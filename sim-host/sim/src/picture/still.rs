//! A picture of a moment, as SVG.

use super::Moment;
use super::placed::{Placed, back_to_front};
use super::view::View;
use crate::picture::OKABE_ITO;
use crate::record::Record;
use nalgebra::Vector3;
use std::fmt::Write;
use surefoot::dynamics::DynamicsFault;
use surefoot::spatial::{Pose, Quaternion};

pub(super) const WIDTH: f64 = 900.0;
pub(super) const HEIGHT: f64 = 640.0;
/// Of the height of the picture, for that of the first body's centre above the floor.
const BODY_HEIGHT: f64 = 0.567;
/// The latter, of the robot of the text, m.
const STANDING: f64 = 1.1;
/// From the robot's right (it faces −x), a little behind and above: a thrown block is seen too.
const AZIMUTH_DEG: f64 = 66.0;
const ELEVATION_DEG: f64 = 12.0;

type Color = (u8, u8, u8);

const BODY: Color = OKABE_ITO[2];
const LEFT_LEG: Color = OKABE_ITO[5];
const RIGHT_LEG: Color = OKABE_ITO[3];
const BLOCK: Color = OKABE_ITO[4];
const GROUND_FORCE: Color = OKABE_ITO[1];

/// Draws what moves, a block and the forces of the ground at the sample nearest to a time (s).
///
/// # Errors
/// A [`DynamicsFault`] for a sample that is no configuration.
pub fn still(record: &dyn Record, time_s: f64) -> Result<String, DynamicsFault> {
    let times = record.times();
    let distance = |k: &usize| (times[*k] - time_s).abs();
    let nearest = (0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let mut svg = format!(
        "<svg width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\">\n\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#FFFFFF\"/>\n"
    );
    if let Some(sample) = nearest {
        // Writing to a string cannot fail.
        let _ = scene(&mut svg, record, STANDING, true, (times[sample], &record.moment(sample)?));
    }
    svg.push_str("</svg>\n");
    Ok(svg)
}

/// What there is to see at a moment, of something whose first body is so high (m) above the floor.
pub(super) fn scene(
    svg: &mut String,
    record: &dyn Record,
    height: f64,
    has_shadows: bool,
    (time_s, moment): (f64, &Moment),
) -> std::fmt::Result {
    let (shown, poses) = (record.shown(), &moment.poses);
    let [x, y, _] = poses[0].position.into();
    let center = Vector3::new(x, y, 0.68 * height);
    let view = View::new(
        AZIMUTH_DEG.to_radians(),
        ELEVATION_DEG.to_radians(),
        center,
        BODY_HEIGHT * HEIGHT / height,
        [WIDTH / 2.0, 0.53 * HEIGHT],
    );
    let of_groups = [BODY, LEFT_LEG, RIGHT_LEG];
    let mut solids: Vec<(Placed<'_>, Color)> = Vec::new();
    for (body, pose) in shown.bodies.iter().zip(poses) {
        let color = of_groups[usize::from(body.group) % of_groups.len()];
        solids.extend(body.solids.iter().map(|solid| (Placed::new(solid, pose), color)));
    }
    if let (Some(solid), Some(block)) = (&shown.block, &moment.block) {
        let [x, y, z, s, i, j, k] = block.pose;
        let rotation = Quaternion::from_array([s, i, j, k]).to_matrix();
        let pose = Pose { rotation, position: Vector3::new(x, y, z) };
        solids.push((Placed::new(solid, &pose), BLOCK));
    }
    floor(svg, &view, center)?;
    for (solid, _) in solids.iter().filter(|_| has_shadows) {
        paint_shadow(svg, &view, solid)?;
    }
    for k in back_to_front(&solids, view.eye()) {
        let (solid, color) = &solids[k];
        paint_solid(svg, &view, solid, *color)?;
    }
    for (point, force) in shown.points.iter().zip(&moment.forces) {
        let (at, force) = (poses[point.body].transform_point(point.at), Vector3::from(*force));
        if force.norm() > 1.0 {
            arrow(svg, &view, at, at + force * shown.force_length, GROUND_FORCE)?;
        }
    }
    writeln!(
        svg,
        "<text x=\"24\" y=\"40\" font-size=\"20\">t = {time_s:.3} s</text>\n\
         <text x=\"24\" y=\"62\" font-size=\"14\" fill=\"#5A5A5A\">floor in squares of 20 cm; \
         arrows: forces of the ground, {:.0} cm for 100 N</text>",
        1e4 * shown.force_length,
    )
}

fn floor(svg: &mut String, view: &View, center: Vector3<f64>) -> std::fmt::Result {
    let (x0, y0) = ((center.x / 0.2).round() * 0.2, (center.y / 0.2).round() * 0.2);
    for k in -4..=4 {
        let along = 0.2 * f64::from(k);
        for (from, to) in [
            (Vector3::new(x0 + along, y0 - 0.8, 0.0), Vector3::new(x0 + along, y0 + 0.8, 0.0)),
            (Vector3::new(x0 - 0.8, y0 + along, 0.0), Vector3::new(x0 + 0.8, y0 + along, 0.0)),
        ] {
            let ([x1, y1], [x2, y2]) = (view.project(&from), view.project(&to));
            writeln!(
                svg,
                "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"#D8D8D8\"/>"
            )?;
        }
    }
    Ok(())
}

fn arrow(
    svg: &mut String,
    view: &View,
    from: Vector3<f64>,
    to: Vector3<f64>,
    color: Color,
) -> std::fmt::Result {
    let ([x1, y1], [x2, y2]) = (view.project(&from), view.project(&to));
    let length = f64::hypot(x2 - x1, y2 - y1).max(1e-9);
    let (ux, uy) = ((x2 - x1) / length, (y2 - y1) / length);
    let head = length.min(9.0);
    let (bx, by) = (x2 - head * ux, y2 - head * uy);
    let (wx, wy) = (-0.45 * head * uy, 0.45 * head * ux);
    let color = hex(color, 1.0);
    writeln!(
        svg,
        "<path d=\"M{x1:.1} {y1:.1}L{bx:.1} {by:.1}\" stroke=\"{color}\" stroke-width=\"2.5\"/>\
         <path d=\"M{x2:.1} {y2:.1}L{:.1} {:.1}L{:.1} {:.1}Z\" fill=\"{color}\"/>",
        bx + wx,
        by + wy,
        bx - wx,
        by - wy,
    )
}

fn paint_solid(
    svg: &mut String,
    view: &View,
    solid: &Placed<'_>,
    color: Color,
) -> std::fmt::Result {
    for face in solid.faces {
        let normal = solid.normal(face);
        if view.faces_us(&normal) {
            let fill = hex(color, brightness(&normal));
            let points = outline(view, solid, face, |v| *v);
            writeln!(
                svg,
                "<polygon points=\"{points}\" fill=\"{fill}\" stroke=\"#202020\" \
                 stroke-width=\"0.8\" stroke-linejoin=\"round\"/>"
            )?;
        }
    }
    Ok(())
}

/// All faces as the sun at the zenith throws them on the floor.
fn paint_shadow(svg: &mut String, view: &View, solid: &Placed<'_>) -> std::fmt::Result {
    for face in solid.faces {
        let points = outline(view, solid, face, |v| Vector3::new(v.x, v.y, 0.0));
        writeln!(svg, "<polygon points=\"{points}\" fill=\"#E6E6E6\"/>")?;
    }
    Ok(())
}

fn outline(
    view: &View,
    solid: &Placed<'_>,
    face: &[usize],
    of: impl Fn(&Vector3<f64>) -> Vector3<f64>,
) -> String {
    let point = |i: &usize| {
        let [x, y] = view.project(&of(&solid.vertices[*i]));
        format!("{x:.1},{y:.1}")
    };
    face.iter().map(point).collect::<Vec<_>>().join(" ")
}

/// Of a face with this normal, under a lamp above, to the right of the robot and a little behind.
fn brightness(normal: &Vector3<f64>) -> f64 {
    let lamp = Vector3::new(0.3, 0.55, 0.78);
    0.78 + 0.32 * normal.dot(&lamp)
}

/// A colour, darkened or made lighter.
fn hex((red, green, blue): Color, brightness: f64) -> String {
    let part = |part: u8| (f64::from(part) * brightness).clamp(0.0, 255.0).round() as u8;
    format!("#{:02X}{:02X}{:02X}", part(red), part(green), part(blue))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_loop::{Scalar, controller, run};
    use crate::record::RobotRecord;
    use crate::scene::load;

    #[test]
    fn a_still_shows_the_robot_and_its_forces_at_the_nearest_sample() {
        let mut scene = load("experiment-1").expect("a built-in scene");
        scene.duration_s = 0.4;
        let run = run(&scene, controller(&scene, Scalar::F64).as_mut(), &mut |_| {});
        let svg = still(&RobotRecord::new(&scene, &run.samples), 0.3203).expect("a picture");
        assert!(svg.contains("t = 0.320 s"));
        // Of each of 13 solids at least two faces are seen, and all throw shadows.
        assert!(svg.matches("<polygon").count() > 13 * (2 + 6));
        assert_eq!(svg.matches("<path").count(), 2 * 8, "an arrow at each corner, with its head");
        assert!(!svg.contains("NaN"));
        let nothing = still(&RobotRecord::new(&scene, &[]), 0.3).expect("an empty picture");
        assert_eq!(nothing.matches("<polygon").count(), 0);
    }
}

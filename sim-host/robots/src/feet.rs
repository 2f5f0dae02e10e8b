//! Where the feet touch the floor: stated soles, or points of collision shapes.

use crate::description::{DescribedFoot, Description, Shape, ShapeKind};
use crate::error::{ImportError, Refusal};
use crate::hull;
use crate::mesh;
use crate::reduce::Placement;
use crate::robot::{Foot, Robot};
use crate::{Options, nearest};
use nalgebra::{Isometry3, Point3, Vector3};

/// Shapes whose lowest point is higher than the foot's by more are no part of the sole, m.
const SOLE_DEPTH: f64 = 5e-3;
/// Points of a mesh's sole at most: enough for a rectangle, few enough for a contact solver.
const MOST_POINTS: usize = 4;

/// The feet of `--feet` and `--sole`, in the order stated. Which side is down is taken from the home pose:
/// all joints at 0 (or where they are locked), the root link upright.
pub(crate) fn feet(
    description: &Description,
    placements: &[Placement],
    robot: &Robot,
    options: &Options,
) -> Result<Vec<Foot>, ImportError> {
    let home = robot.home_poses();
    let mut names: Vec<&str> = options.feet.iter().map(String::as_str).collect();
    for sole in &options.soles {
        if !names.contains(&sole.link.as_str()) {
            names.push(&sole.link);
        }
    }
    if names.is_empty() {
        let all = description.feet.iter();
        return all.map(|foot| described_foot(description, placements, foot)).collect();
    }
    names.into_iter().map(|name| foot(description, placements, &home, options, name)).collect()
}

/// A foot that the file has, in the link that it is part of now.
fn described_foot(
    description: &Description,
    placements: &[Placement],
    foot: &DescribedFoot,
) -> Result<Foot, ImportError> {
    let Placement { link, pose } = &placements[foot.link];
    let Some(link) = *link else {
        let refusal = Refusal::NoSole { reason: "it is fixed to the world".into() };
        let place = &description.links[foot.link].place;
        return Err(ImportError::refused(Some(place), format!("foot {}", foot.name), refusal));
    };
    let moved = |p: &Vector3<f64>| pose.transform_point(&(*p).into()).coords;
    Ok(Foot { name: foot.name.clone(), link, points: foot.points.iter().map(moved).collect() })
}

/// The file has no link of this name.
pub(crate) fn no_link(description: &Description, option: &str, name: &str) -> ImportError {
    let names = description.links.iter().map(|link| link.name.as_str());
    let refusal = Refusal::NoSuch { what: "link", nearest: nearest(name, names) };
    ImportError::refused(None, format!("{option} {name}"), refusal)
}

fn foot(
    description: &Description,
    placements: &[Placement],
    home: &[Isometry3<f64>],
    options: &Options,
    name: &str,
) -> Result<Foot, ImportError> {
    let k = description.links.iter().position(|link| link.name == name);
    let k = k.ok_or_else(|| no_link(description, "--feet", name))?;
    let described = &description.links[k];
    let refuse = |reason: String| {
        let refusal = Refusal::NoSole { reason };
        ImportError::refused(Some(&described.place), format!("foot {name}"), refusal)
    };
    let Some(link) = placements[k].link else {
        return Err(refuse("it is fixed to the world and cannot be a foot".into()));
    };
    let pose = placements[k].pose;
    if let Some(sole) = options.soles.iter().find(|sole| sole.link == name) {
        let [x0, x1, y0, y1, z] = sole.rectangle;
        let corners = [[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        let points = corners.map(|[x, y]| pose.transform_point(&Point3::new(x, y, z)).coords);
        return Ok(Foot { name: name.into(), link, points: points.to_vec() });
    }
    if let Some(described) = description.feet.iter().find(|described| described.name == name) {
        return described_foot(description, placements, described);
    }
    let world = home[link] * pose;
    let points = sole(&described.shapes, &world).map_err(refuse)?;
    let points = points.into_iter().map(|p| pose.transform_point(&p.into()).coords).collect();
    Ok(Foot { name: name.into(), link, points })
}

/// The lowest points of a link's shapes, in its frame, which is at `world`.
pub(crate) fn sole(shapes: &[Shape], world: &Isometry3<f64>) -> Result<Vec<Vector3<f64>>, String> {
    if shapes.is_empty() {
        return Err("it has no collision shape".into());
    }
    let mut found = Vec::new();
    let mut passed_over = String::new();
    // Where a foot has simple shapes, its mesh is the same foot again.
    let is_mesh = |shape: &&Shape| matches!(shape.kind, ShapeKind::Mesh(..));
    let simple = shapes.iter().filter(|shape| !is_mesh(shape));
    for shape in simple.chain(shapes.iter().filter(is_mesh)) {
        if is_mesh(&shape) && !found.is_empty() {
            break;
        }
        let own = shape.pose;
        match lowest(shape, &(world * own)) {
            Ok(points) => {
                found.extend(points.into_iter().map(|p| own.transform_point(&p.into()).coords))
            }
            Err(reason) => passed_over = reason,
        }
    }
    let height = |p: &Vector3<f64>| world.transform_point(&(*p).into()).z;
    let bottom = found.iter().map(height).fold(f64::INFINITY, f64::min);
    found.retain(|p| height(p) <= bottom + SOLE_DEPTH);
    if found.is_empty() { Err(passed_over) } else { Ok(found) }
}

/// The points of a shape that stand on the floor, in the shape's frame, which is at `world`.
fn lowest(shape: &Shape, world: &Isometry3<f64>) -> Result<Vec<Vector3<f64>>, String> {
    // Down, in the shape's axes.
    let down = world.rotation.inverse() * -Vector3::z();
    let sign = |x: f64| if x < 0.0 { -1.0 } else { 1.0 };
    Ok(match &shape.kind {
        ShapeKind::Box(half) => {
            // The corners of the face that looks down most.
            let axis = down.iamax();
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
                .map(|(a, b)| {
                    let mut corner = Vector3::zeros();
                    corner[axis] = sign(down[axis]) * half[axis];
                    corner[u] = a * half[u];
                    corner[v] = b * half[v];
                    corner
                })
                .to_vec()
        }
        ShapeKind::Sphere(radius) => vec![down * *radius],
        ShapeKind::Capsule(radius, half) => {
            [-1.0, 1.0].map(|end| Vector3::z() * (end * half) + down * *radius).to_vec()
        }
        ShapeKind::Cylinder(radius, half) => {
            let side = Vector3::new(down.x, down.y, 0.0);
            if down.z.abs() >= side.norm() {
                // It stands: a square in the rim of its lower end.
                let z = sign(down.z) * half;
                let r = radius * std::f64::consts::FRAC_1_SQRT_2;
                [(r, r), (-r, r), (-r, -r), (r, -r)].map(|(x, y)| Vector3::new(x, y, z)).to_vec()
            } else {
                // It lies: the ends of its lowest line.
                let low = side.normalize() * *radius;
                [-1.0, 1.0].map(|end| low + Vector3::z() * (end * half)).to_vec()
            }
        }
        ShapeKind::Mesh(file, scale) => {
            let vertices = mesh::vertices(&shape.place, file, scale)?;
            hull::lowest_face(&vertices, &down, SOLE_DEPTH, MOST_POINTS)
        }
        ShapeKind::Other(what) => return Err(format!("{what} has no points that could stand")),
    })
}

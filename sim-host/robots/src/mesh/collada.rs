//! COLLADA: vertices of all geometries of the scene, with the nodes' transformations, in metres and z up.

use crate::error::ImportError;
use crate::xml::{self, Element};
use nalgebra::{Matrix4, Point3, Unit, Vector3};
use std::path::Path;

/// Nodes in nodes at most.
const DEEPEST: usize = 64;

/// # Errors
/// The file is not readable, or not XML, or a number in it is none.
pub(super) fn vertices(path: &Path) -> Result<Vec<Vector3<f64>>, ImportError> {
    let root = xml::read(path)?;
    let mut scene = Matrix4::identity();
    if let Some(asset) = root.one("asset")? {
        if let Some(meter) =
            asset.one("unit")?.map(|unit| unit.number("meter")).transpose()?.flatten()
        {
            scene *= Matrix4::new_scaling(meter);
        }
        let axis = asset.one("up_axis")?.map(|axis| axis.text.trim().to_owned());
        let quarter = std::f64::consts::FRAC_PI_2;
        match axis.as_deref() {
            Some("Y_UP") => scene = Matrix4::from_axis_angle(&Vector3::x_axis(), quarter) * scene,
            Some("X_UP") => scene = Matrix4::from_axis_angle(&Vector3::y_axis(), -quarter) * scene,
            _ => {}
        }
    }
    let mut found = Vec::new();
    for library in root.all("library_visual_scenes") {
        for node in library.all("visual_scene").flat_map(|scene| scene.all("node")) {
            collect(&root, node, &scene, 0, &mut found)?;
        }
    }
    Ok(found)
}

fn collect(
    root: &Element,
    node: &Element,
    outer: &Matrix4<f64>,
    depth: usize,
    found: &mut Vec<Vector3<f64>>,
) -> Result<(), ImportError> {
    if depth > DEEPEST {
        return Err(node.malformed(format!("nodes nested at most {DEEPEST} deep"), "more"));
    }
    let mut pose = *outer;
    for child in &node.children {
        pose *= transformation(child)?;
    }
    for instance in node.all("instance_geometry") {
        let id = instance.required_attribute("url")?.trim_start_matches('#');
        let all = root.all("library_geometries").flat_map(|library| library.all("geometry"));
        for geometry in all.filter(|geometry| geometry.attribute("id") == Some(id)) {
            for point in positions(geometry)? {
                found.push(pose.transform_point(&point).coords);
            }
        }
    }
    for child in node.all("node") {
        collect(root, child, &pose, depth + 1, found)?;
    }
    Ok(())
}

/// One of a node's transformations; identity for what is none.
fn transformation(element: &Element) -> Result<Matrix4<f64>, ImportError> {
    let numbers = || element.text_numbers();
    let wrong = |count: usize| element.malformed(format!("{count} numbers"), "others");
    Ok(match element.tag.as_str() {
        "matrix" => {
            let numbers = numbers()?;
            if numbers.len() != 16 {
                return Err(wrong(16));
            }
            Matrix4::from_row_slice(&numbers)
        }
        "translate" | "scale" => {
            let [x, y, z] = numbers()?.try_into().map_err(|_| wrong(3))?;
            let vector = Vector3::new(x, y, z);
            if element.tag == "scale" {
                Matrix4::new_nonuniform_scaling(&vector)
            } else {
                Matrix4::new_translation(&vector)
            }
        }
        "rotate" => {
            let [x, y, z, degrees] = numbers()?.try_into().map_err(|_| wrong(4))?;
            let axis = Unit::try_new(Vector3::new(x, y, z), 1e-12);
            let axis = axis.ok_or_else(|| element.malformed("an axis with a length", "none"))?;
            Matrix4::from_axis_angle(&axis, degrees.to_radians())
        }
        _ => Matrix4::identity(),
    })
}

/// The source that the vertices take their POSITION from.
fn positions(geometry: &Element) -> Result<Vec<Point3<f64>>, ImportError> {
    let mut found = Vec::new();
    for mesh in geometry.all("mesh") {
        let inputs = mesh.all("vertices").flat_map(|vertices| vertices.all("input"));
        for input in inputs.filter(|input| input.attribute("semantic") == Some("POSITION")) {
            let id = input.required_attribute("source")?.trim_start_matches('#');
            let sources = mesh.all("source").filter(|source| source.attribute("id") == Some(id));
            for array in sources.flat_map(|source| source.all("float_array")) {
                let numbers = array.text_numbers()?;
                found.extend(numbers.chunks_exact(3).map(|p| Point3::new(p[0], p[1], p[2])));
            }
        }
    }
    Ok(found)
}

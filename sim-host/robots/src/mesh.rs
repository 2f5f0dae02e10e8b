//! Vertices of mesh files, for the corners of soles.

mod collada;

use crate::error::Place;
use nalgebra::Vector3;
use std::path::{Path, PathBuf};

/// Vertices in the shape's frame, m.
///
/// # Errors
/// A sentence: the file is not found, not readable, or of another format than STL, OBJ and DAE.
pub(crate) fn vertices(
    place: &Place,
    name: &str,
    scale: &[f64; 3],
) -> Result<Vec<Vector3<f64>>, String> {
    let path = find(Path::new(place.file.as_ref()), name)
        .ok_or_else(|| format!("its mesh {name} is not found beside the robot file"))?;
    let failed = |what: String| format!("its mesh {} cannot be read: {what}", path.display());
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let vertices = match ending.as_str() {
        "stl" => stl(&path).map_err(failed)?,
        "obj" => obj(&path).map_err(failed)?,
        "dae" => collada::vertices(&path).map_err(|error| failed(error.to_string()))?,
        _ => return Err(failed("it is neither STL, OBJ nor DAE".into())),
    };
    if vertices.is_empty() || vertices.iter().any(|v| !v.iter().all(|x| x.is_finite())) {
        return Err(failed("it has no vertices, or some that are not finite".into()));
    }
    Ok(vertices.iter().map(|v| v.component_mul(&Vector3::from(*scale))).collect())
}

/// The file of a name as URDF and MJCF write it: `package://NAME/…`, `file://…`, or a path. A package is
/// looked for in the folders above the robot file.
fn find(robot: &Path, name: &str) -> Option<PathBuf> {
    let folder = robot.parent()?;
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    if let Some(inside) = name.strip_prefix("package://") {
        let (package, rest) = inside.split_once('/')?;
        let candidates = folder.ancestors().flat_map(|above| {
            let named = above.file_name().is_some_and(|name| name == package);
            [Some(above.join(package).join(rest)), named.then(|| above.join(rest))]
        });
        return candidates.flatten().find(|path| path.is_file());
    }
    let path = folder.join(name.strip_prefix("file://").unwrap_or(name));
    path.is_file().then_some(path)
}

fn stl(path: &Path) -> Result<Vec<Vector3<f64>>, String> {
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let mesh = stl_io::read_stl(&mut std::io::BufReader::new(file)).map_err(|e| e.to_string())?;
    Ok(mesh.vertices.iter().map(|v| Vector3::new(v[0], v[1], v[2]).cast()).collect())
}

fn obj(path: &Path) -> Result<Vec<Vector3<f64>>, String> {
    // Materials are not asked for, so that a missing file of them is no failure.
    let (models, _materials) =
        tobj::load_obj(path, &tobj::LoadOptions::default()).map_err(|error| error.to_string())?;
    let point = |p: &[f32]| Vector3::new(p[0], p[1], p[2]).cast();
    Ok(models.iter().flat_map(|model| model.mesh.positions.chunks_exact(3).map(point)).collect())
}

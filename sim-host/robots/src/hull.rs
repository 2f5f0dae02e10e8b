//! The face that a cloud of points stands on.

use nalgebra::Vector3;

/// Corners of the convex hull of the points that lie at most `depth` above the lowest one, seen along
/// `down`; those that span least are left out until `most` remain.
pub(crate) fn lowest_face(
    points: &[Vector3<f64>],
    down: &Vector3<f64>,
    depth: f64,
    most: usize,
) -> Vec<Vector3<f64>> {
    let bottom = points.iter().map(|p| p.dot(down)).fold(f64::NEG_INFINITY, f64::max);
    // Two directions across.
    let helper = if down.x.abs() < 0.6 { Vector3::x() } else { Vector3::y() };
    let u = down.cross(&helper).normalize();
    let v = down.cross(&u);
    let mut low: Vec<([f64; 2], Vector3<f64>)> = points
        .iter()
        .filter(|p| p.dot(down) >= bottom - depth)
        .map(|p| ([p.dot(&u), p.dot(&v)], *p))
        .collect();
    low.sort_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    low.dedup_by(|a, b| a.0 == b.0);
    let mut corners = hull(&low);
    while corners.len() > most.max(3) {
        let n = corners.len();
        let area = |i: &usize| {
            let [a, b, c] = [(i + n - 1) % n, *i, (i + 1) % n].map(|i| corners[i].0);
            turn(a, b, c).abs()
        };
        let least = (0..n).min_by(|a, b| area(a).total_cmp(&area(b))).unwrap_or(0);
        corners.remove(least);
    }
    corners.into_iter().map(|(_, p)| p).collect()
}

/// Twice the area of a triangle, positive to the left.
fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Andrew's monotone chain, of sorted points.
fn hull(sorted: &[([f64; 2], Vector3<f64>)]) -> Vec<([f64; 2], Vector3<f64>)> {
    if sorted.len() < 3 {
        return sorted.to_vec();
    }
    let half = |points: &mut dyn Iterator<Item = &([f64; 2], Vector3<f64>)>| {
        let mut chain: Vec<([f64; 2], Vector3<f64>)> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice()
                && turn(a.0, b.0, point.0) <= 0.0
            {
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut sorted.iter());
    lower.extend(half(&mut sorted.iter().rev()));
    lower
}

#[cfg(test)]
mod tests {
    use super::lowest_face;
    use nalgebra::Vector3;

    #[test]
    fn a_box_with_a_knob_stands_on_its_four_corners() {
        let mut points = Vec::new();
        for i in 0..11 {
            for j in 0..6 {
                let (x, y) = (0.02 * f64::from(i) - 0.1, 0.02 * f64::from(j) - 0.05);
                points.push(Vector3::new(x, y, 0.0));
                points.push(Vector3::new(3.0 * x, 3.0 * y, 0.1));
            }
        }
        let found = lowest_face(&points, &-Vector3::z(), 5e-3, 4);
        assert_eq!(found.len(), 4);
        for corner in found {
            assert!((corner.x.abs() - 0.1).abs() < 1e-15, "{corner}");
            assert!((corner.y.abs() - 0.05).abs() < 1e-15 && corner.z == 0.0, "{corner}");
        }
    }
}

//! The support polygon: how far a point is inside of what feet span.
//!
//! The hull is found by Andrew's monotone chain ("Another efficient algorithm for convex hulls in two dimensions",
//! Information Processing Letters 9 (1979) 216–219).

use nalgebra::Vector2;

/// Twice the area of the triangle, positive if it is passed counterclockwise.
fn turn(a: &Vector2<f64>, b: &Vector2<f64>, c: &Vector2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

/// Corners of the convex hull, counterclockwise.
pub fn hull(points: &[Vector2<f64>]) -> Vec<Vector2<f64>> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = Vector2<f64>>| {
        let mut chain: Vec<Vector2<f64>> = Vec::new();
        for point in points {
            while let [.., a, b] = &chain[..]
                && turn(a, b, &point) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        // Its last corner is the first of the other chain.
        chain.pop();
        chain
    };
    let mut corners = chain(&mut sorted.iter().copied());
    corners.extend(chain(&mut sorted.iter().rev().copied()));
    corners
}

/// How far a point is inside a hull, m: its distance to the nearest edge, negative outside (then the largest distance
/// beyond an edge's line); `None` for a hull without area.
pub fn inside(corners: &[Vector2<f64>], point: &Vector2<f64>) -> Option<f64> {
    if corners.len() < 3 {
        return None;
    }
    let next = corners.iter().cycle().skip(1);
    let distance = |(a, b): (&Vector2<f64>, &Vector2<f64>)| turn(a, b, point) / (b - a).norm();
    Some(corners.iter().zip(next).map(distance).fold(f64::INFINITY, f64::min))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_in_a_square() {
        let all = [[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [2.0, 2.0], [0.0, 2.0], [1.0, 1.5]];
        let corners = hull(&all.map(Vector2::from));
        assert_eq!(corners.len(), 4);
        let at = |x, y| inside(&corners, &Vector2::new(x, y)).expect("an area");
        assert_eq!((at(1.0, 1.0), at(0.25, 1.0), at(2.5, 1.0)), (1.0, 0.25, -0.5));
        let line = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]].map(Vector2::from);
        assert_eq!(inside(&hull(&line), &Vector2::new(0.5, 0.5)), None);
    }
}

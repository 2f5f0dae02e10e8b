//! `Yᵀ z = b` with the least `z`, by the normal equations and one refinement.

use super::mass::Mass;
use super::rows::Row;

/// `Y` and the factor of `YᵀY`, of rows that do not imply one another.
#[derive(Clone, Debug)]
pub(super) struct Constraints {
    /// Columns of `Y`, by degree of freedom, descending.
    columns: Vec<Vec<(usize, f64)>>,
    /// Lower factor of `YᵀY`, row by row, each from its first entry.
    factor: Vec<Vec<f64>>,
    first: Vec<usize>,
}

/// Of the squared size of a row that is left beside the others, at least: rows with less are implied by them. On the
/// manifold the implied rows of over-constrained mechanisms leave 1e-24 or less; a row of windows 1e-6 rad from where it
/// is singular, 1e-12.
const IMPLIED: f64 = 1e-15;

fn dot(a: &[(usize, f64)], b: &[(usize, f64)]) -> f64 {
    let (mut i, mut j, mut sum) = (0, 0, 0.0);
    while let (Some((at, x)), Some((other, y))) = (a.get(i), b.get(j)) {
        match at.cmp(other) {
            std::cmp::Ordering::Equal => {
                sum += x * y;
                (i, j) = (i + 1, j + 1);
            }
            std::cmp::Ordering::Greater => i += 1,
            std::cmp::Ordering::Less => j += 1,
        }
    }
    sum
}

fn meet(a: &[(usize, f64)], b: &[(usize, f64)]) -> bool {
    a.iter().any(|(i, _)| b.iter().any(|(j, _)| i == j))
}

/// A column of `Y`; `scratch` is zero before and after.
fn column(row: &Row, mass: &Mass, scratch: &mut [f64]) -> Vec<(usize, f64)> {
    for (i, x) in &row.entries {
        scratch[*i] = *x;
    }
    mass.transposed(scratch, row.entries.iter().map(|(i, _)| *i));
    let column = row.entries.iter().map(|(i, _)| (*i, std::mem::take(&mut scratch[*i])));
    column.collect()
}

/// Rows of which none is implied by the others, the largest first taken: by orthogonalization, twice.
pub(super) fn independent(rows: &[Row], mass: &Mass, degrees: usize) -> Vec<usize> {
    let mut scratch = vec![0.0; degrees];
    let mut left: Vec<(usize, Vec<f64>, f64)> = Vec::new();
    for (k, row) in rows.iter().enumerate() {
        let mut dense = vec![0.0; degrees];
        for (i, x) in column(row, mass, &mut scratch) {
            dense[i] = x;
        }
        let size: f64 = dense.iter().map(|x| x * x).sum();
        if size > 0.0 {
            left.push((k, dense, size));
        }
    }
    let mut chosen: Vec<usize> = Vec::new();
    let share = |(_, y, size): &(usize, Vec<f64>, f64)| y.iter().map(|x| x * x).sum::<f64>() / size;
    while let Some(best) =
        (0..left.len()).max_by(|a, b| share(&left[*a]).total_cmp(&share(&left[*b])))
    {
        if !(share(&left[best]) > IMPLIED) {
            break;
        }
        let (k, unit, _) = left.swap_remove(best);
        chosen.push(k);
        let size: f64 = unit.iter().map(|x| x * x).sum();
        for (_, y, _) in &mut left {
            for _ in 0..2 {
                let along: f64 = y.iter().zip(&unit).map(|(a, b)| a * b).sum::<f64>() / size;
                y.iter_mut().zip(&unit).for_each(|(a, b)| *a -= along * b);
            }
        }
    }
    chosen.sort_unstable();
    chosen
}

impl Constraints {
    /// Of the chosen rows.
    pub fn new(rows: &[Row], chosen: &[usize], mass: &Mass, degrees: usize) -> Self {
        let mut scratch = vec![0.0; degrees];
        let columns: Vec<_> =
            chosen.iter().map(|k| column(&rows[*k], mass, &mut scratch)).collect();
        let mut first = Vec::with_capacity(columns.len());
        let mut factor: Vec<Vec<f64>> = Vec::with_capacity(columns.len());
        for (k, y) in columns.iter().enumerate() {
            let from = (0..=k).find(|l| meet(y, &columns[*l])).unwrap_or(k);
            let mut row = Vec::with_capacity(k + 1 - from);
            for l in from..=k {
                let mut x = dot(y, &columns[l]);
                let both = from.max(*first.get(l).unwrap_or(&from));
                for p in both..l {
                    let other = if l == k { row[p - from] } else { factor[l][p - first[l]] };
                    x -= row[p - from] * other;
                }
                if l < k {
                    row.push(x / factor[l][l - first[l]]);
                } else {
                    // What is left of a row by round-off alone is none: it is not pushed.
                    row.push(if x > 0.0 { x.sqrt() } else { f64::INFINITY });
                }
            }
            first.push(from);
            factor.push(row);
        }
        Self { columns, factor, first }
    }

    /// `Yᵀ z`
    fn along(&self, z: &[f64]) -> Vec<f64> {
        self.columns.iter().map(|y| y.iter().map(|(i, x)| x * z[*i]).sum()).collect()
    }

    /// `z += Y (YᵀY)⁻¹ b`
    fn add(&self, mut b: Vec<f64>, z: &mut [f64]) {
        let n = b.len();
        for k in 0..n {
            let (row, from) = (&self.factor[k], self.first[k]);
            let known: f64 = (from..k).map(|p| row[p - from] * b[p]).sum();
            b[k] = (b[k] - known) / row[k - from];
        }
        for k in (0..n).rev() {
            let (row, from) = (&self.factor[k], self.first[k]);
            b[k] /= row[k - from];
            for p in from..k {
                b[p] -= row[p - from] * b[k];
            }
        }
        for (y, w) in self.columns.iter().zip(&b) {
            for (i, x) in y {
                z[*i] += x * w;
            }
        }
    }

    /// Changes `z` by as little as makes `Yᵀ z = b`.
    pub fn meet(&self, b: &[f64], z: &mut [f64]) {
        for _ in 0..2 {
            let left = b.iter().zip(self.along(z)).map(|(b, y)| b - y).collect();
            self.add(left, z);
        }
    }
}

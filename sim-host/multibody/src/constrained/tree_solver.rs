//! Algorithm 5.1: linear equations whose structure is a tree, in time linear in its joints. It knows no
//! physics.
//!
//! # Notation
//! - node k: body k.o and joint k; `ΔX` (7), `Δγ` (1), `Δλ` (`c` of them, 0 to 6)
//! - `M, f`: (5.13)'s first row; `B, b`: the body's own constraint; `G_o, G_i, g`: the joint's, for its
//!   outboard and inboard body; `m` at a step's beginning, `m+1` at its end
//!
//! ```text
//! M ΔX − Bᵐᵀ Δγ − G_oᵐᵀ Δλ − Σ_{j outboard} G_{j,i}ᵐᵀ Δλ_j = −f
//! Bᵐ⁺¹ ΔX = −b,   G_oᵐ⁺¹ ΔX = −g − G_iᵐ⁺¹ ΔX_i                            (5.13)
//! ```
//! In place of the inverse in (5.16) each node keeps `s`, its solution as if its inboard body stood
//! still, and `S`, what the latter's motion changes; `F` of the text is the lower block of `S`:
//!
//! ```text
//! M̂_i += G_iᵐᵀ F G_iᵐ⁺¹,   f̂_i −= G_iᵐᵀ s_λ,   Δ = s − S G_iᵐ⁺¹ ΔX_i       (5.22), (5.23), (5.17)
//! ```

/// Coordinates of a body.
pub const COORDINATES: usize = 7;
/// Constraints of a joint, at most.
pub const MOST: usize = 6;
/// Unknowns of a node, at most.
const SIZE: usize = COORDINATES + 1 + MOST;

/// One node's equations, by rows.
#[derive(Clone, Debug)]
pub struct Equations {
    /// Node of the inboard body; none for a root's, which is the world.
    pub inboard: Option<usize>,
    /// Constraints of the joint.
    pub constraints: usize,
    /// `M`
    pub stiffness: [[f64; COORDINATES]; COORDINATES],
    /// `f`
    pub force: [f64; COORDINATES],
    /// `Bᵐ`, `Bᵐ⁺¹`
    pub norm: [[f64; COORDINATES]; 2],
    /// `b`
    pub norm_error: f64,
    /// `G_oᵐ`, `G_oᵐ⁺¹`; rows beyond `constraints` are of no meaning.
    pub outboard_rows: [[[f64; COORDINATES]; MOST]; 2],
    /// `G_iᵐ`, `G_iᵐ⁺¹`
    pub inboard_rows: [[[f64; COORDINATES]; MOST]; 2],
    /// `g`
    pub error: [f64; MOST],
}

impl Equations {
    /// All zero.
    pub fn new(inboard: Option<usize>, constraints: usize) -> Self {
        Self {
            inboard,
            constraints,
            stiffness: [[0.0; COORDINATES]; COORDINATES],
            force: [0.0; COORDINATES],
            norm: [[0.0; COORDINATES]; 2],
            norm_error: 0.0,
            outboard_rows: [[[0.0; COORDINATES]; MOST]; 2],
            inboard_rows: [[[0.0; COORDINATES]; MOST]; 2],
            error: [0.0; MOST],
        }
    }
}

/// A node's unknowns.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Correction {
    /// `ΔX`
    pub coordinates: [f64; COORDINATES],
    /// `Δγ`
    pub norm_multiplier: f64,
    /// `Δλ`
    pub multipliers: [f64; MOST],
}

/// A joint whose equations cannot be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the equations of joint {joint} are singular")]
pub struct SingularJoint {
    /// Its node.
    pub joint: usize,
}

/// What a node keeps between the two recursions, by rows: `s`, then the columns of `S`. They are solved
/// for together, as rows of one length that a compiler can handle at once.
type Kept = [[f64; RIGHT]; SIZE];

/// Right sides of a node: one, and one for each constraint; and one to make it even.
const RIGHT: usize = 2 + MOST;

/// Equations of a whole tree, inboard nodes first, and room to solve them.
#[derive(Clone, Debug)]
pub struct TreeEquations {
    /// One for each joint.
    pub nodes: Vec<Equations>,
    kept: Vec<Kept>,
}

impl TreeEquations {
    /// Room for these nodes, inboard ones first.
    pub fn new(nodes: Vec<Equations>) -> Self {
        let kept = vec![[[0.0; RIGHT]; SIZE]; nodes.len()];
        Self { nodes, kept }
    }

    /// Solves for all unknowns. `M̂` and `f̂` take the place of `M` and `f`.
    ///
    /// # Errors
    /// A [`SingularJoint`].
    ///
    /// # Cost
    /// Linear in the number of nodes; no allocation.
    pub fn solve(&mut self, corrections: &mut [Correction]) -> Result<(), SingularJoint> {
        for k in (0..self.nodes.len()).rev() {
            self.eliminate(k)?;
        }
        for k in 0..self.nodes.len() {
            let node = &self.nodes[k];
            let mut moved = [0.0; MOST];
            if let Some(inboard) = node.inboard {
                let coordinates = corrections[inboard].coordinates;
                for c in 0..node.constraints {
                    moved[c] = dot(&node.inboard_rows[1][c], &coordinates);
                }
            }
            let all = self.kept[k]
                .map(|row| row[1..].iter().zip(&moved).fold(row[0], |x, (s, by)| x - s * by));
            let correction = &mut corrections[k];
            correction.coordinates.copy_from_slice(&all[..COORDINATES]);
            correction.norm_multiplier = all[COORDINATES];
            correction.multipliers.copy_from_slice(&all[COORDINATES + 1..]);
        }
        Ok(())
    }

    /// One node of the inboard recursion.
    fn eliminate(&mut self, k: usize) -> Result<(), SingularJoint> {
        let node = &self.nodes[k];
        let (constraints, inboard) = (node.constraints, node.inboard);
        let unknowns = COORDINATES + 1 + constraints;
        let unit = unit(node);
        let (matrix, right) = assembled(node, unit);
        let kept = &mut self.kept[k];
        *kept = right;
        if !solve(matrix, kept, unknowns) {
            return Err(SingularJoint { joint: k });
        }
        for row in &mut kept[COORDINATES..unknowns] {
            row.iter_mut().for_each(|x| *x *= unit);
        }
        let Some(inboard) = inboard else { return Ok(()) };
        let [begin, end] = self.nodes[k].inboard_rows;
        let kept = &self.kept[k];
        let into = &mut self.nodes[inboard];
        for a in 0..constraints {
            // Row a of F G_iᵐ⁺¹.
            let mut carried = [0.0; COORDINATES];
            for b in 0..constraints {
                let f = kept[COORDINATES + 1 + a][1 + b];
                for (x, g) in carried.iter_mut().zip(&end[b]) {
                    *x += f * g;
                }
            }
            let multiplier = kept[COORDINATES + 1 + a][0];
            for i in 0..COORDINATES {
                for j in 0..COORDINATES {
                    into.stiffness[i][j] += begin[a][i] * carried[j];
                }
                into.force[i] -= begin[a][i] * multiplier;
            }
        }
        Ok(())
    }
}

/// Of multipliers, so that the blocks of (5.15) are of one size in all units: the largest of `M`'s diagonal.
fn unit(node: &Equations) -> f64 {
    (0..COORDINATES).fold(f64::MIN_POSITIVE, |m, i| m.max(node.stiffness[i][i].abs()))
}

/// The matrix and the right sides of (5.15), with constraints and multipliers in this unit: with the inboard body
/// standing still, and for unit errors of the joint's constraints.
fn assembled(node: &Equations, unit: f64) -> ([[f64; SIZE]; SIZE], Kept) {
    let mut matrix = [[0.0; SIZE]; SIZE];
    let mut right = [[0.0; RIGHT]; SIZE];
    for i in 0..COORDINATES {
        matrix[i][..COORDINATES].copy_from_slice(&node.stiffness[i]);
        matrix[i][COORDINATES] = -node.norm[0][i] * unit;
        matrix[COORDINATES][i] = node.norm[1][i] * unit;
        for c in 0..node.constraints {
            matrix[i][COORDINATES + 1 + c] = -node.outboard_rows[0][c][i] * unit;
            matrix[COORDINATES + 1 + c][i] = node.outboard_rows[1][c][i] * unit;
        }
        right[i][0] = -node.force[i];
    }
    right[COORDINATES][0] = -node.norm_error * unit;
    for c in 0..node.constraints {
        right[COORDINATES + 1 + c][0] = -node.error[c] * unit;
        right[COORDINATES + 1 + c][1 + c] = unit;
    }
    (matrix, right)
}

/// Pivots that are no more than round-off of their column.
const ROUND_OFF: f64 = 1e-14;

/// Solves with the leading `n` rows and columns, by elimination with row exchanges; `right` becomes the
/// solutions. False if singular.
fn solve(mut a: [[f64; SIZE]; SIZE], right: &mut Kept, n: usize) -> bool {
    let sizes: [f64; SIZE] =
        std::array::from_fn(|j| a[..n].iter().fold(0.0, |m, row| row[j].abs().max(m)));
    for k in 0..n {
        let mut best = k;
        for i in k + 1..n {
            if a[i][k].abs() > a[best][k].abs() {
                best = i;
            }
        }
        a.swap(k, best);
        right.swap(k, best);
        let (row, right_row) = (a[k], right[k]);
        if !(row[k].abs() > ROUND_OFF * sizes[k] && row[k].is_finite()) {
            return false;
        }
        let inverse = 1.0 / row[k];
        for i in k + 1..n {
            // Half of these matrices is zero.
            if a[i][k] != 0.0 {
                let factor = a[i][k] * inverse;
                // Left of the pivot both rows are done with; the whole row goes faster than a part.
                for (x, y) in a[i].iter_mut().zip(&row) {
                    *x -= factor * y;
                }
                for (x, y) in right[i].iter_mut().zip(&right_row) {
                    *x -= factor * y;
                }
            }
        }
    }
    for k in (0..n).rev() {
        let inverse = 1.0 / a[k][k];
        let solution = right[k].map(|x| x * inverse);
        right[k] = solution;
        for i in 0..k {
            let factor = a[i][k];
            if factor != 0.0 {
                for (x, y) in right[i].iter_mut().zip(&solution) {
                    *x -= factor * y;
                }
            }
        }
    }
    true
}

fn dot(a: &[f64; COORDINATES], b: &[f64; COORDINATES]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

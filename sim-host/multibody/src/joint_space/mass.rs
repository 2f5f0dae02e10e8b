//! The mass matrix, and its factor of the tree's shape.

use super::super::system::System;
use super::kinematics::Kinematics;
use nalgebra::Vector3;

/// `M = LᵀL`: `L` in place of `M`, with the entries of degrees of freedom that lie one behind the other.
#[derive(Clone, Debug)]
pub(super) struct Mass {
    entries: Vec<f64>,
    parents: Vec<Option<usize>>,
}

impl Mass {
    /// Cost: degrees of freedom times the square of the tree's depth.
    ///
    /// # Errors
    /// The degree of freedom without inertia.
    pub fn factored(
        system: &System,
        now: &Kinematics,
        rotors: impl Iterator<Item = (usize, f64)>,
    ) -> Result<Self, usize> {
        let n = now.dofs.len();
        let mut m = vec![0.0; n * n];
        // Degrees of freedom that move a body: momentum and angular momentum for a unit rate, and the axis.
        let mut moved = Vec::<(usize, [Vector3<f64>; 3])>::new();
        for (k, (link, body)) in system.links().iter().zip(&now.bodies).enumerate() {
            let inertia = Vector3::from(link.body.inertia);
            moved.clear();
            moved.extend(now.path(Some(k)).map(|i| {
                let dof = &now.dofs[i];
                let own = body.turn.conjugate().rotate(dof.angular);
                let spin = body.turn.rotate(inertia.component_mul(&own));
                (i, [dof.velocity_of(&body.center) * link.body.mass, spin, dof.angular])
            }));
            for (at, (i, [momentum, spin, _])) in moved.iter().enumerate() {
                for (j, [_, _, angular]) in &moved[at..] {
                    let velocity = now.dofs[*j].velocity_of(&body.center);
                    m[i * n + j] += momentum.dot(&velocity) + spin.dot(angular);
                }
            }
        }
        for (dof, inertia) in rotors {
            m[dof * n + dof] += inertia;
        }
        let parents: Vec<Option<usize>> = now.dofs.iter().map(|dof| dof.parent).collect();
        let mut mass = Self { entries: m, parents };
        for k in (0..n).rev() {
            let pivot = mass.entries[k * n + k];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return Err(k);
            }
            let root = pivot.sqrt();
            mass.entries[k * n + k] = root;
            let mut i = mass.parents[k];
            while let Some(at) = i {
                mass.entries[k * n + at] /= root;
                i = mass.parents[at];
            }
            let mut i = mass.parents[k];
            while let Some(at) = i {
                let by = mass.entries[k * n + at];
                let mut j = Some(at);
                while let Some(to) = j {
                    mass.entries[at * n + to] -= by * mass.entries[k * n + to];
                    j = mass.parents[to];
                }
                i = mass.parents[at];
            }
        }
        Ok(mass)
    }

    /// `L⁻ᵀ b` in place, of all degrees of freedom or of those of these indices, descending, with all on the way
    /// to the world.
    pub fn transposed(&self, b: &mut [f64], indices: impl Iterator<Item = usize>) {
        let n = self.parents.len();
        for i in indices {
            b[i] /= self.entries[i * n + i];
            let value = b[i];
            let mut j = self.parents[i];
            while let Some(at) = j {
                b[at] -= self.entries[i * n + at] * value;
                j = self.parents[at];
            }
        }
    }

    /// `L⁻¹ z` in place.
    pub fn solve(&self, z: &mut [f64]) {
        let n = self.parents.len();
        for i in 0..n {
            let mut j = self.parents[i];
            while let Some(at) = j {
                z[i] -= self.entries[i * n + at] * z[at];
                j = self.parents[at];
            }
            z[i] /= self.entries[i * n + i];
        }
    }
}

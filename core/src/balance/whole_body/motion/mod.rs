//! Feet that press and legs that swing, in one program.
//!
//! ```text
//! state ─► observe ─┬► motion ─► planner ─► task ─┐
//!                   └──────────────────────────────┴► tick ─► torques, accelerations, foot wrenches
//! ```
//! Each foot brings its contact's directions as unknowns: its wrench where it presses, and where it
//! swings what its reference point's acceleration differs from the wanted one. So double support, single
//! support and flight are one program of one size.
//!
//! # Notation
//! Frame 1; all accelerations from those `θ̈₁` at which every foot accelerates as it is to (a pressing one
//! comes to rest) and the posture's joints as theirs. `X` of the central body, `d_i` of foot i from what
//! is wanted, `w_i` its wrench in sole axes; `J⁺`, `J_b` of the contacts; `M` mass matrix, `h` inverse
//! dynamics at `θ̈₁`, index b for the central body's rows, i for those of leg i's joints.
//! ```text
//! δ_i = J_i⁺ (d_i − J_b,i X),     B = M_b − Σ M_i J_i⁺ J_b,i   (M_b, M_i: columns)  (1)
//! P X + z = Σ_press G_i w_i − Σ_swing M_bi J_i⁺ d_i,     P = B_b,   z = h_b         (2)
//! τ_k = B_k X + Σ_swing M_ki J_i⁺ d_i + h_k − Σ_{press, outboard of k} s_k · G_i w_i (3)
//! ```
//! What is minimised, with x the unknowns of all feet:
//! ```text
//! ½ m² (λ |c̈ − c̈*|² + α |ω̇ − ω̇*|² + Σ_swing (σ |d_lin|² + ρ |d_ang|²)) + ½ ε Σ_press (|f|² + |n|²/ℓ²)
//! ```
//! so that an error of the centre of mass counts as the force that it takes, as in
//! [`ContactProgram`](crate::balance::ContactProgram), and limits give way alike. Where the centre of
//! pressure is the task, `c̈ − c̈*` is horizontally `κ/(m g)` times the moment of the ground's forces about
//! it ([`LinearTask`](super::LinearTask)), each taken at its foot's own height.
//!
//! # Cost
//! The biped on two feet in f32, instructions of a Cortex-M4F: to [observe](super::ObservedBody::observe) 22 400, the
//! planner's view of it 1 400, the tick 35 300 to 36 100 while no limit is in force, and about 4 800 for each that comes
//! or goes. An [`ObservedBody`](super::ObservedBody) has 3.5 KB.
//!
//! # Accuracy
//! In f32, of 800 harsh states of the biped, a third of them with limits in force: torques within 0.03 N·m
//! of f64's.
//!
//! # Sources
//! Centre of pressure as the task: as in walking by the angular momentum about the contact (Gong and
//! Grizzle 2020); wrenches and accelerations of feet as the unknowns of one program, as in task-space
//! inverse dynamics (Sentis and Khatib 2005; Herzog et al., *Auton. Robots* 40, 2016); the inverse of a
//! sum by a small one, Woodbury 1950.

mod dynamics;
mod objective;
mod program;
mod range;
mod tick;

pub use objective::MotionWeights;
pub(super) use range::kept;
pub use tick::{whole_body_motion_tick, whole_body_motion_tick_under};

//! Between a file's order of joints and the robot's, with joints that follow others eliminated.

use super::states::{FramePose, JointEntry, State, StateResult, States};
use super::{AtState, Convention, Dynamics, DynamicsError, Evaluation, JointSlices};
use crate::nearest;
use crate::robot::{Robot, RobotMotion};
use nalgebra::{DMatrix, DVector, Isometry3};
use std::collections::{BTreeMap, HashMap};

/// Pinocchio's word for a floating root joint, whatever the joint's name.
const FREE_FLYER: &str = "JointModelFreeFlyer";

/// Where the numbers of each of the robot's joints are in a state.
pub(super) struct Columns {
    pub nq: usize,
    pub nv: usize,
    /// By links; `None` for a joint that follows another.
    entries: Vec<Option<JointEntry>>,
}

impl Columns {
    pub fn find(
        robot: &Robot,
        states: &States,
        convention: Convention,
    ) -> Result<Self, DynamicsError> {
        let wrong = |message: String| DynamicsError::States { file: String::new(), message };
        let by_name: HashMap<&str, usize> =
            robot.links.iter().enumerate().map(|(k, link)| (link.joint.name.as_str(), k)).collect();
        let floating: Vec<usize> = (0..robot.links.len())
            .filter(|k| robot.links[*k].joint.motion == RobotMotion::Floating)
            .collect();
        let mut entries: Vec<Option<JointEntry>> = vec![None; robot.links.len()];
        let (mut nq, mut nv) = (0, 0);
        for entry in &states.joints {
            let named = by_name.get(entry.name.as_str()).copied();
            let root = match floating.as_slice() {
                [root] if entry.kind.as_deref() == Some(FREE_FLYER) => Some(*root),
                _ => None,
            };
            let Some(k) = named.or(root) else {
                let near = nearest(&entry.name, by_name.keys().copied());
                return Err(wrong(format!(
                    "the robot has no joint {:?} that moves{near}",
                    entry.name
                )));
            };
            let motion = robot.links[k].joint.motion;
            let expected = (convention.coordinates(motion), motion.degrees_of_freedom());
            if (entry.nq, entry.nv) != expected {
                return Err(wrong(format!(
                    "joint {}: expected nq and nv of {expected:?}, found {:?}",
                    entry.name,
                    (entry.nq, entry.nv)
                )));
            }
            if entries[k].replace(entry.clone()).is_some() {
                return Err(wrong(format!("joint {} is listed twice", entry.name)));
            }
            let ends = entry.idx_q.checked_add(entry.nq).zip(entry.idx_v.checked_add(entry.nv));
            let (end_q, end_v) =
                ends.ok_or_else(|| wrong(format!("joint {}: its index is too large", entry.name)))?;
            (nq, nv) = (nq.max(end_q), nv.max(end_v));
        }
        for (entry, link) in entries.iter_mut().zip(&robot.links) {
            if link.joint.follows.is_some() {
                *entry = None;
            } else if entry.is_none() {
                return Err(wrong(format!(
                    "its joints lack {}, which the robot has: list it, or --lock it",
                    link.joint.name
                )));
            }
        }
        let total: usize = entries.iter().flatten().map(|entry| entry.nv).sum();
        let total_q: usize = entries.iter().flatten().map(|entry| entry.nq).sum();
        if (total_q, total) != (nq, nv) {
            return Err(wrong("the joints' indices leave gaps or overlap".into()));
        }
        Ok(Self { nq, nv, entries })
    }

    pub fn evaluate(
        &self,
        dynamics: &Dynamics<'_>,
        robot: &Robot,
        convention: Convention,
        index: usize,
        state: &State,
    ) -> Result<StateResult, DynamicsError> {
        let mut state = state.clone();
        for (numbers, all) in [(&mut state.a, self.nv), (&mut state.tau, self.nv)] {
            if numbers.is_empty() {
                numbers.resize(all, 0.0);
            }
        }
        let lengths = [
            ("q", &state.q, self.nq),
            ("v", &state.v, self.nv),
            ("a", &state.a, self.nv),
            ("tau", &state.tau, self.nv),
        ];
        for (name, numbers, expected) in lengths {
            if numbers.len() != expected || numbers.iter().any(|x| !x.is_finite()) {
                let message = format!(
                    "state {index}: expected {expected} finite numbers in {name}, found {}",
                    numbers.len()
                );
                return Err(DynamicsError::States { file: String::new(), message });
            }
        }
        let full = Full::of(self, robot, convention, &state);
        let evaluation = dynamics.at(convention, &full.slices()).map_err(|error| match error {
            AtState::Input(error) => error,
            AtState::Fault(fault) => {
                let joint = match fault {
                    surefoot::dynamics::DynamicsFault::SingularInertia { joint } => {
                        dynamics.joint_name(joint)
                    }
                    _ => None,
                };
                DynamicsError::Fault { state: index, joint, fault }
            }
        })?;
        let Reduced { rnea, crba, aba } = self.reduced(robot, index, &state, &evaluation)?;
        Ok(StateResult {
            leaf_frames: leaf_frames(robot, &evaluation.poses),
            rnea: rnea.as_slice().to_vec(),
            crba: crba.row_iter().map(|row| row.iter().copied().collect()).collect(),
            aba: aba.as_slice().to_vec(),
            state,
        })
    }

    /// Results in the file's order. Joints that follow others are eliminated: with `v = G v_file`,
    /// `M = Gᵀ M G`, `τ = Gᵀ τ`, and the accelerations solve `M v̇ = τ − h`.
    fn reduced(
        &self,
        robot: &Robot,
        index: usize,
        state: &State,
        evaluation: &Evaluation,
    ) -> Result<Reduced, DynamicsError> {
        let n = evaluation.inverse.len();
        let mut g = DMatrix::zeros(n, self.nv);
        let mut row = 0;
        for (link, entry) in robot.links.iter().zip(&self.entries) {
            match (entry, &link.joint.follows) {
                (Some(entry), _) => {
                    for i in 0..entry.nv {
                        g[(row + i, entry.idx_v + i)] = 1.0;
                    }
                }
                (None, Some(coupling)) => {
                    if let Some(leader) = &self.entries[coupling.leader] {
                        g[(row, leader.idx_v)] = coupling.multiplier;
                    }
                }
                (None, None) => {}
            }
            row += link.joint.motion.degrees_of_freedom();
        }
        let rnea = g.tr_mul(&evaluation.inverse);
        let crba = g.transpose() * &evaluation.mass_matrix * &g;
        if n == self.nv {
            let aba = g.tr_mul(&evaluation.forward);
            return Ok(Reduced { rnea, crba, aba });
        }
        // h = rnea − M a
        let a = DVector::from_row_slice(&state.a);
        let excess = DVector::from_row_slice(&state.tau) - (&rnea - &crba * a);
        let factor = crba.clone().cholesky().ok_or(DynamicsError::Singular { state: index })?;
        Ok(Reduced { rnea, crba, aba: factor.solve(&excess) })
    }
}

/// Results in the file's order.
struct Reduced {
    rnea: DVector<f64>,
    crba: DMatrix<f64>,
    aba: DVector<f64>,
}

/// A state's numbers joint by joint, those of followers from their leaders.
struct Full {
    joints: Vec<[Vec<f64>; 4]>,
}

impl Full {
    fn of(columns: &Columns, robot: &Robot, convention: Convention, state: &State) -> Self {
        let own = |entry: &JointEntry| {
            let (q, v) = (entry.idx_q..entry.idx_q + entry.nq, entry.idx_v..entry.idx_v + entry.nv);
            [
                state.q[q].to_vec(),
                state.v[v.clone()].to_vec(),
                state.a[v.clone()].to_vec(),
                state.tau[v].to_vec(),
            ]
        };
        let joints = robot.links.iter().zip(&columns.entries).map(|(link, entry)| {
            let follows =
                link.joint.follows.and_then(|c| Some((c, columns.entries[c.leader].as_ref()?)));
            match (entry, follows) {
                (Some(entry), _) => own(entry),
                (None, Some((coupling, leader))) => {
                    let [q, v, a, _] = own(leader);
                    let angle = if q.len() == 2 { q[1].atan2(q[0]) } else { q[0] };
                    let k = coupling.multiplier;
                    let angle = k * angle + coupling.offset;
                    let q = match convention.coordinates(link.joint.motion) {
                        2 => vec![angle.cos(), angle.sin()],
                        _ => vec![angle],
                    };
                    [q, vec![k * v[0]], vec![k * a[0]], vec![0.0]]
                }
                (None, None) => Default::default(),
            }
        });
        Self { joints: joints.collect() }
    }

    fn slices(&self) -> Vec<JointSlices<'_>> {
        self.joints.iter().map(|[q, v, a, tau]| JointSlices { q, v, a, tau }).collect()
    }
}

/// Poses of the file's links that carry none.
fn leaf_frames(robot: &Robot, poses: &[Isometry3<f64>]) -> BTreeMap<String, FramePose> {
    let links = (0..robot.links.len())
        .filter(|k| robot.is_leaf(*k))
        .map(|k| (robot.links[k].name.clone(), poses[k]));
    let frames = robot.frames.iter().filter(|frame| frame.is_leaf).map(|frame| {
        let carrier = frame.link.map_or(Isometry3::identity(), |k| poses[k]);
        (frame.name.clone(), carrier * frame.pose)
    });
    let plain = |pose: Isometry3<f64>| {
        let r = pose.rotation.to_rotation_matrix();
        let row = |i: usize| [r[(i, 0)], r[(i, 1)], r[(i, 2)]];
        FramePose {
            rotation: [row(0), row(1), row(2)],
            translation: pose.translation.vector.into(),
        }
    };
    links.chain(frames).map(|(name, pose)| (name, plain(pose))).collect()
}

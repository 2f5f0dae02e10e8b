//! `RUSTFLAGS="-C target-cpu=native" cargo bench -p surefoot-peers --bench protocol`: our dynamics and dynibo's of the
//! biped, by one protocol in one run.
//!
//! 64 random states in rotation, so that no branch is predicted from the call before; both sides in turn, batch by
//! batch, so that both see the same machine; of all batches the least, which other programs disturb least, and the
//! median. Joint poses are included on both sides; dynibo's kinematics are poses only.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::hint::black_box;
use std::time::Instant;
use surefoot::dynamics::{
    forward_dynamics, forward_kinematics, inverse_dynamics, joint_poses, mass_matrix,
};
use surefoot::model::robots::biped::TREE;
use surefoot_peers::Peer;

const STATES: usize = 64;
/// Calls of each state in a batch, and batches.
const ROUNDS: usize = 4;
const BATCHES: usize = 2000;

type State = ([f64; 19], [f64; 18], [f64; 18]);
type Call<'a> = Box<dyn FnMut(usize) + 'a>;

fn main() {
    let mut random = Pcg64::seed_from_u64(7);
    let states: Vec<State> = (0..STATES).map(|_| state(&mut random)).collect();
    let tree = &TREE;
    let poses = |i: usize| joint_poses(black_box(tree), black_box(&states[i].0)).expect("finite");
    let peers = || -> Vec<Peer> { states.iter().map(|(q, v, a)| Peer::new(q, v, a)).collect() };
    let mut of = [peers(), peers(), peers(), peers()];
    let [for_poses, for_inverse, for_forward, for_mass] = &mut of;
    let rows: [(&str, Call, Call); 4] = [
        (
            "forward kinematics",
            Box::new(|i| {
                let (_, v, a) = black_box(&states[i]);
                black_box(&forward_kinematics(tree, &poses(i), v, a));
            }),
            Box::new(|i| {
                black_box(for_poses[i].poses());
            }),
        ),
        (
            "inverse dynamics",
            Box::new(|i| {
                let (_, v, a) = black_box(&states[i]);
                black_box(&inverse_dynamics(tree, &poses(i), v, a, None));
            }),
            Box::new(|i| {
                black_box(for_inverse[i].inverse_dynamics());
            }),
        ),
        (
            "forward dynamics",
            Box::new(|i| {
                let (_, v, a) = black_box(&states[i]);
                black_box(&forward_dynamics(tree, &poses(i), v, a, None).is_ok());
            }),
            Box::new(|i| {
                black_box(for_forward[i].forward_dynamics(black_box(&states[i].2)));
            }),
        ),
        (
            "mass matrix",
            Box::new(|i| {
                black_box(&mass_matrix(tree, &poses(i)));
            }),
            Box::new(|i| {
                black_box(for_mass[i].mass_matrix());
            }),
        ),
    ];
    println!(
        "biped, f64, ns a call: least and median of {BATCHES} batches, {STATES} states in turn"
    );
    println!("{:20} {:>15} {:>15} {:>6}", "", "surefoot", "dynibo", "ratio");
    for (name, mut ours, mut theirs) in rows {
        let (mut a, mut b) = (Vec::new(), Vec::new());
        for _ in 0..BATCHES {
            a.push(batch(&mut ours));
            b.push(batch(&mut theirs));
        }
        let [(a, a_median), (b, b_median)] = [a, b].map(least_and_median);
        println!("{name:20} {a:7.0} {a_median:7.0} {b:7.0} {b_median:7.0} {:6.2}", a / b);
    }
}

/// Numbers in ±1, with a unit quaternion.
fn state(random: &mut Pcg64) -> State {
    let mut number = || random.random_range(-1.0..1.0);
    let mut q: [f64; 19] = std::array::from_fn(|_| number());
    let norm = q[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
    for x in &mut q[3..7] {
        *x /= norm;
    }
    (q, std::array::from_fn(|_| number()), std::array::from_fn(|_| number()))
}

/// ns a call.
fn batch(call: &mut Call) -> f64 {
    let begun = Instant::now();
    for _ in 0..ROUNDS {
        for i in 0..STATES {
            call(i);
        }
    }
    begun.elapsed().as_secs_f64() * 1e9 / (ROUNDS * STATES) as f64
}

fn least_and_median(mut all: Vec<f64>) -> (f64, f64) {
    all.sort_by(f64::total_cmp);
    (all[0], all[all.len() / 2])
}

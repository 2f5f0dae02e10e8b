//! `cargo bench -p surefoot-peers`: time per call of the biped's workloads, and of dynibo on the same
//! biped in the same run. How costs grow with links, instruction counts say better.

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use surefoot_peers::Peer;
use surefoot_tests::workloads::{biped_positions, workloads};

fn ours(criterion: &mut Criterion) {
    for workload in workloads().iter().filter(|workload| workload.name.contains("biped")) {
        criterion.bench_function(&workload.name, |bencher| bencher.iter(|| (workload.call)()));
    }
}

fn dynibo(criterion: &mut Criterion) {
    let q = biped_positions();
    let v = std::array::from_fn(|i| 0.5 * (1.3 * i as f64 + 0.4).sin());
    let a = std::array::from_fn(|i| 0.5 * (1.3 * i as f64 + 0.9).sin());
    let mut peer = Peer::new(&q, &v, &a);
    criterion.bench_function("poses-only/biped/dynibo", |bencher| {
        bencher.iter(|| {
            black_box(black_box(&mut peer).poses());
        });
    });
    criterion.bench_function("inverse-dynamics/biped/dynibo", |bencher| {
        bencher.iter(|| {
            black_box(black_box(&mut peer).inverse_dynamics());
        });
    });
    criterion.bench_function("forward-dynamics/biped/dynibo", |bencher| {
        bencher.iter(|| {
            black_box(black_box(&mut peer).forward_dynamics(&a));
        });
    });
    criterion.bench_function("mass-matrix/biped/dynibo", |bencher| {
        bencher.iter(|| {
            black_box(black_box(&mut peer).mass_matrix());
        });
    });
}

criterion_group!(benches, ours, dynibo);
criterion_main!(benches);

//! `cargo bench -p surefoot-tests`: time per call of every workload, and of dynibo, the fastest Rust
//! peer, on the same biped in the same run.

mod peer;

use criterion::{Criterion, criterion_group, criterion_main};
use surefoot_tests::workloads::workloads;

fn ours(criterion: &mut Criterion) {
    for workload in workloads() {
        criterion.bench_function(&workload.name, |bencher| bencher.iter(|| (workload.call)()));
    }
}

criterion_group!(benches, ours, peer::dynibo);
criterion_main!(benches);

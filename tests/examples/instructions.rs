//! Calls one workload a number of times: `instructions NAME CALLS`; `instructions` lists the names.
//! `cargo xtask instructions` runs it under callgrind.

use surefoot_tests::workloads::workloads;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let all = workloads();
    match (arguments.next(), arguments.next().map(|calls| calls.parse::<u32>())) {
        (Some(name), Some(Ok(calls))) => {
            let workload =
                all.iter().find(|workload| workload.name == name).expect("a name of the list");
            for _ in 0..calls {
                (workload.call)();
            }
        }
        _ => {
            for workload in all {
                println!("{}", workload.name);
            }
        }
    }
}

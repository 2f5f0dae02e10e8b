//! Studies of scenes.

use std::sync::atomic::AtomicBool;
use surefoot_host::certify::{
    Certificate, Contents, Definition, Effort, Folder, Row, Rows, Sampling, Shard, Study, bits,
    merge, on_all, search_failures,
};
use surefoot_sim::closed_loop::{self, Scalar};
use surefoot_sim::scene::{AnyScene, BUILT_IN, parse};

const VARY: &str = r#"
[vary."block.mass_kg"]
uniform = [1.0, 12.0]

[vary.friction]
fields = ["feet.floor.static_friction", "feet.floor.dynamic_friction"]
uniform = [0.15, 0.5]

[vary."sensing.gyroscope_noise"]
log_uniform = [1e-5, 1e-3]

[vary."sensing.seed"]
seed = true
"#;

/// Of experiment 2, cut to some seconds.
fn study(vary: &str, seconds: &str) -> Study {
    let scene = BUILT_IN.iter().find(|scene| scene.name == "experiment-2").expect("built in");
    let definition = Definition {
        scene: "experiment-2".into(),
        scene_text: scene.text.replace("duration_s = 3.0", &format!("duration_s = {seconds}")),
        vary: "vary.toml".into(),
        vary_text: vary.into(),
        seed: 3,
        sampling: Sampling::Sobol,
    };
    Study::new(definition).expect("a study")
}

fn rows(study: &Study, samples: &[u64], workers: usize) -> Vec<Row> {
    let go = AtomicBool::new(false);
    let work = |sample: &u64| study.run(*sample, Scalar::F64);
    let rows = on_all(samples, workers, &go, &work, &mut |_| Ok(())).expect("no error");
    rows.into_iter().map(|row| row.expect("nothing stopped it")).collect()
}

#[test]
fn rows_do_not_depend_on_the_processors() {
    let study = study(VARY, "0.3");
    let samples: Vec<u64> = (0..6).collect();
    let alone = rows(&study, &samples, 1);
    assert_eq!(alone, rows(&study, &samples, 2));
    let backwards: Vec<u64> = samples.iter().rev().copied().collect();
    let mut again = rows(&study, &backwards, 3);
    again.reverse();
    assert_eq!(alone, again);
    // Each is another motion.
    let distinct: std::collections::BTreeSet<&str> =
        alone.iter().map(|row| row.bits.as_str()).collect();
    assert_eq!(distinct.len(), 6);
}

/// A block of up to 60 kg throws the robot over: failures are kept as scenes that replay to the same bits.
#[test]
fn failures_replay_to_the_same_bits() {
    let heavy = VARY.replace("[1.0, 12.0]", "[20.0, 60.0]");
    let study = study(&heavy, "1.0");
    let samples: Vec<u64> = (0..4).collect();
    let all: Rows = rows(&study, &samples, 2).into_iter().map(|row| (row.sample, row)).collect();
    let contents = Contents {
        definition: study.definition().clone(),
        scalar: Scalar::F64,
        samples: 4,
        shard: Shard::WHOLE,
    };
    let certificate = Certificate::of(&study, &contents, &all, 0.95);
    assert!(certificate.failures > 0, "{all:?}");
    assert_eq!(certificate.nearest.len() as u64, certificate.failures);
    let of_modes: u64 = certificate.modes.iter().map(|mode| mode.failures).sum();
    assert_eq!(of_modes, certificate.failures);
    let near = &certificate.nearest[0];
    let text = study.text(near.sample, &near.point).expect("a scene");
    let Ok(AnyScene::Robot(scene)) = parse("failure-1", &text) else { panic!("{text}") };
    let mut controller = closed_loop::controller(&scene, Scalar::F64);
    let run = closed_loop::run(&scene, controller.as_mut(), &mut |_| {});
    assert_eq!(bits(&run.samples), near.bits);
    assert!(run.failure.is_some());
}

/// What is broken off in the middle of a line goes on to the same table, and so do shards; one that is missing, or
/// differs, is told.
#[test]
fn broken_off_and_cut_up_it_is_the_same_table() {
    let study = study(VARY, "0.1");
    let folder = tempfile::tempdir().expect("a folder");
    let named = |name: &str| folder.path().join(name);
    let contents = |shard| Contents {
        definition: study.definition().clone(),
        scalar: Scalar::F64,
        samples: 5,
        shard,
    };
    let all: Rows =
        rows(&study, &[0, 1, 2, 3, 4], 2).into_iter().map(|row| (row.sample, row)).collect();
    let (mut table, before) =
        Folder::open(&named("whole"), &study, &contents(Shard::WHOLE), false).expect("opened");
    assert!(before.is_empty());
    for sample in [3, 0] {
        table.keep(&study, &all[&sample]).expect("kept");
    }
    drop(table);
    let path = named("whole").join("runs.csv");
    let mut text = std::fs::read_to_string(&path).expect("there");
    text.push_str("2,,0.09");
    std::fs::write(&path, text).expect("written");
    let open = |resume| Folder::open(&named("whole"), &study, &contents(Shard::WHOLE), resume);
    assert!(open(false).is_err_and(|error| error.contains("--resume goes on with it")));
    let (table, before) = open(true).expect("opened");
    assert_eq!(before.keys().copied().collect::<Vec<_>>(), [0, 3]);
    assert!(before.iter().all(|(sample, row)| all[sample] == *row));
    table.finish(&study, &all).expect("written");
    let shards: Vec<_> = (1..=2)
        .map(|number| {
            let (shard, path) = (Shard { number, of: 2 }, named(&format!("shard-{number}")));
            let own: Rows = shard.samples(5).map(|k| (k, all[&k].clone())).collect();
            let (table, _) = Folder::open(&path, &study, &contents(shard), false).expect("opened");
            table.finish(&study, &own).expect("written");
            path
        })
        .collect();
    let (_, merged, together) = merge(&shards).expect("all shards");
    assert_eq!((merged.shard, &together), (Shard::WHOLE, &all));
    let missing = merge(&shards[..1]).map(|_| ()).expect_err("a shard is missing");
    assert!(
        missing.contains("2 of 5 samples are in none of the folders, the first is 1"),
        "{missing}"
    );
    let path = shards[0].join("runs.csv");
    let text = std::fs::read_to_string(&path).expect("there");
    std::fs::write(&path, text.replace(&all[&2].bits, "0123456789abcdef")).expect("written");
    let [first, second] = [&shards[0], &named("whole")].map(Clone::clone);
    let differs = merge(&[first, second]).map(|_| ()).expect_err("sample 2 differs");
    assert!(differs.contains("sample 2:"), "{differs}");
}

/// Where plain samples find nothing a search finds failures, and is the same on any number of processors.
#[test]
fn a_search_finds_what_samples_do_not() {
    // Blocks that throw it over are rare: 3.2 deviations from the middle.
    let rare = "[vary.\"block.mass_kg\"]\nnormal = [1.0, 0.5]\nwithin = [0.1, 9.0]\n";
    let study = study(rare, "1.0");
    let go = AtomicBool::new(false);
    let effort = Effort::of_runs(120);
    let find = |workers| {
        let scalar = Scalar::F64;
        search_failures(&study, scalar, (&effort, 0.95), (workers, &go), &mut || {})
            .expect("no error")
            .expect("not stopped")
    };
    let (searched, nearest) = find(2);
    assert!(searched.failures > 0, "{searched:?}");
    assert!(nearest.iter().all(|near| near.distance > 1.0), "{nearest:?}");
    assert_eq!((searched, nearest), find(1));
}

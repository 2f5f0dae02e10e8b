//! No number in any field breaks a run: it is refused by its field, or the record is finite.

use super::leaves::{changed, leaves, written};
use super::record::record;
use super::representative::scenes;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::time::{Duration, Instant};
use surefoot_sim::scene::parse;
use toml::{Table, Value};

/// Whether a scene's text is refused, or played with finite numbers only.
fn check(name: &str, text: &str, what: &str) -> Option<String> {
    match parse(name, text) {
        Err(error) => {
            let message = error.to_string();
            assert!(message.starts_with(&format!("{name}:")), "{what}: {message} names no line");
            Some(message)
        }
        Ok(scene) => {
            if let Ok((numbers, _)) = record(scene) {
                assert!(numbers.iter().all(|x| x.is_finite()), "{what}: not all is finite");
            }
            None
        }
    }
}

#[test]
fn bad_numbers_are_refused_by_their_field() {
    let begun = Instant::now();
    let mut tried = 0;
    for (name, text) in scenes() {
        let table: Table = toml::from_str(&text).expect("TOML");
        for (path, value) in leaves(&table) {
            let path_there = written(&path);
            let numbers: Vec<Value> = match value {
                Value::Float(x) => [
                    f64::NAN,
                    f64::INFINITY,
                    f64::NEG_INFINITY,
                    1e300,
                    -1e300,
                    0.0,
                    -x,
                    1e30,
                    1e-300,
                ]
                .map(Value::Float)
                .into(),
                Value::Integer(_) => {
                    let mut all: Vec<_> = [i64::MAX, i64::MIN, -1, 0].map(Value::Integer).into();
                    all.extend([f64::NAN, 1e300].map(Value::Float));
                    all
                }
                _ => continue,
            };
            for number in numbers {
                let what = format!("{name}: {path_there} = {number}");
                tried += 1;
                let refused = check(&name, &changed(&table, &[(&path, number.clone())]), &what);
                let impossible = number.as_float().is_some_and(|x| !(x.abs() <= 1e30));
                match refused {
                    Some(message) if impossible => {
                        assert!(message.contains(&format!(": {path_there}")), "{what}: {message}");
                    }
                    None if impossible => panic!("{what} is taken"),
                    _ => {}
                }
            }
        }
    }
    println!("{tried} numbers in {:.1?}", begun.elapsed());
    assert!(tried > 4000);
}

/// Several fields at a time, with numbers of every size: whatever the outcome, it comes soon and is finite.
#[test]
fn random_numbers_break_nothing() {
    let mut random = Pcg64Mcg::seed_from_u64(1997);
    let begun = Instant::now();
    let all = scenes();
    let mut played = 0;
    for round in 0..600 {
        let (name, text) = &all[random.random_range(0..all.len())];
        let table: Table = toml::from_str(text).expect("TOML");
        let numbers: Vec<_> = leaves(&table)
            .into_iter()
            .filter_map(|(path, value)| Some((path, value.as_float()?)))
            .collect();
        let changes: Vec<_> = (0..random.random_range(1..4))
            .map(|_| {
                let (path, value) = &numbers[random.random_range(0..numbers.len())];
                let size = 10_f64.powf(random.random_range(-30.0..30.0));
                let factor = 10_f64.powf(random.random_range(-3.0..3.0));
                let other = if random.random::<bool>() { value * factor } else { size };
                let sign = if random.random_range(0..4) == 0 { -1.0 } else { 1.0 };
                (path, Value::Float(sign * other))
            })
            .collect();
        let what = format!("round {round}, {name}: {changes:?}");
        let one = Instant::now();
        played += usize::from(check(name, &changed(&table, &changes), &what).is_none());
        assert!(one.elapsed() < Duration::from_secs(120), "{what} takes {:?}", one.elapsed());
    }
    println!("{played} of 600 played, in {:.1?}", begun.elapsed());
    assert!(played > 100);
}

//! Joints that follow others: eliminated, locked with their leader, or refused by name.

use crate::{BODY, file, robot};
use surefoot_robots::dynamics::{Convention, Precision, evaluate_file};
use surefoot_robots::{Options, import, robot_rs};

/// Two slides of 1 kg, the second at −2 times the first plus 0.1 m.
fn slides() -> String {
    robot(&format!(
        r#"<link name="world"/><link name="a">{BODY}</link><link name="b">{BODY}</link>
        <joint name="lead" type="prismatic"><parent link="world"/><child link="a"/><axis xyz="1 0 0"/></joint>
        <joint name="follow" type="prismatic"><parent link="world"/><child link="b"/><axis xyz="0 0 1"/>
          <mimic joint="lead" multiplier="-2" offset="0.1"/></joint>"#
    ))
}

/// M = m + k² m; gravity acts on the follower alone: h = k m g.
#[test]
fn a_follower_is_eliminated_from_the_dynamics() {
    let states = r#"{ "joints": [{ "name": "lead", "idx_q": 0, "nq": 1, "idx_v": 0, "nv": 1 }],
        "states": [{ "q": [0.3], "v": [0.7], "a": [1.5], "tau": [2.0] }] }"#;
    let states = file("slides.json", states);
    let path = file("slides.urdf", &slides());
    let of = |precision| {
        evaluate_file(&path, &states, &Options::default(), Convention::Pinocchio, precision)
            .expect("dynamics")
    };
    let result = of(Precision::F64);
    let state = &result.states[0];
    let (mass, bias) = (1.0 + 4.0, -2.0 * 9.81);
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-14, "{a} is not {b}");
    near(state.crba[0][0], mass);
    near(state.rnea[0], mass * 1.5 + bias);
    near(state.aba[0], (2.0 - bias) / mass);
    near(state.leaf_frames["a"].translation[0], 0.3);
    near(state.leaf_frames["b"].translation[2], -2.0 * 0.3 + 0.1);
    assert!((of(Precision::F32).states[0].aba[0] - state.aba[0]).abs() < 1e-5);
}

#[test]
fn a_follower_locks_with_its_leader_or_is_refused() {
    let path = file("tied.urdf", &slides());
    let tied = import(&path, &Options::default()).expect("read").robot;
    let message = robot_rs(&tied).expect_err("no tree").to_string();
    assert!(message.contains("joint follow") && message.contains("tied to lead"), "{message}");
    let free = Options { free_couplings: true, ..Options::default() };
    robot_rs(&import(&path, &free).expect("read").robot).expect("a tree");
    let text = slides().replace("</robot>", &format!(
        r#"<link name="c">{BODY}</link><joint name="other" type="revolute"><parent link="b"/><child link="c"/></joint></robot>"#
    ));
    let locks = Options { locks: vec![("lead".into(), 0.5)], ..Options::default() };
    let imported = import(&file("tied-locked.urdf", &text), &locks).expect("a robot");
    assert_eq!(imported.locked, [("lead".to_owned(), 0.5), ("follow".to_owned(), -0.9)]);
    assert_eq!(imported.robot.links.len(), 1);
}

#[test]
fn followers_in_a_loop_are_refused() {
    let text =
        slides().replace(r#"<axis xyz="1 0 0"/>"#, r#"<axis xyz="1 0 0"/><mimic joint="follow"/>"#);
    let message =
        import(&file("loop.urdf", &text), &Options::default()).expect_err("refused").to_string();
    assert!(message.contains("loop.urdf:") && message.contains("in a loop"), "{message}");
}

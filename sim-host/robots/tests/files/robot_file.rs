//! `robot.toml`: back to the same robot, and refused at its line.

use crate::{BODY, file, read, robot};
use surefoot_robots::{Options, import, robot_rs, robot_toml};

fn example() -> String {
    robot(&format!(
        r#"<link name="base">{BODY}<collision><geometry><box size="1 1 1"/></geometry></collision></link>
        <link name="a">{BODY}</link><link name="b">{BODY}</link><link name="c"/>
        <joint name="j" type="revolute"><parent link="base"/><child link="a"/><axis xyz="1 2 3"/>
          <origin xyz="0.1 0.2 0.3" rpy="0.4 0.5 0.6"/><limit lower="-1" upper="2" effort="3" velocity="4"/>
          <dynamics damping="0.1" friction="0.2"/></joint>
        <joint name="k" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/>
          <mimic joint="j" multiplier="0.5" offset="0.1"/></joint>
        <joint name="l" type="fixed"><parent link="b"/><child link="c"/><origin xyz="1 0 0" rpy="1 0 0"/></joint>"#
    ))
}

#[test]
fn a_robot_comes_back_to_the_last_bit() {
    let options = Options { feet: vec!["base".into()], ..Options::default() };
    let path = file("example.urdf", &example());
    let robot = import(&path, &options).expect("a robot").robot;
    let text = robot_toml(&robot);
    let back = read("example.toml", &text).expect("the same").robot;
    assert_eq!(back, robot);
    // And so do joints that are locked after it has gone through its file.
    let locks = Options { locks: vec![("j".into(), 0.7)], ..options };
    let direct = import(&path, &locks).expect("locked").robot;
    let locks = Options { locks: vec![("j".into(), 0.7)], ..Options::default() };
    let through = import(&file("again.toml", &text), &locks).expect("locked").robot;
    assert_eq!(through.links, direct.links);
    assert_eq!(robot_rs(&through).expect("a tree"), robot_rs(&direct).expect("a tree"));
}

#[test]
fn a_wrong_robot_file_is_refused_at_its_line() {
    let robot =
        import(&file("right.urdf", &example()), &Options::default()).expect("a robot").robot;
    let text = robot_toml(&robot);
    for (from, to, words) in [
        ("mass_kg = 1.0", "mass_kg = -1.0", vec!["wrong.toml:", "link base", "mass"]),
        ("mass_kg = 1.0", "mass_kg = nan", vec!["wrong.toml:", "link base", "finite"]),
        ("mass_kg = 1.0", "mass = 1.0", vec!["line", "mass"]),
        ("parent = \"a\"", "parent = \"b\"", vec!["link b", "no link \"b\""]),
        ("name = \"a\"", "name = \"base\"", vec!["\"base\""]),
        ("axis = [0.0, 1.0, 0.0]", "axis = [0.0, 0.0, 0.0]", vec!["joint k", "unit axis"]),
        ("joint = \"j\"", "joint = \"jj\"", vec!["joint k follows jj", "is j meant"]),
        ("kind = \"floating\"", "kind = \"flying\"", vec!["line", "flying"]),
    ] {
        assert!(text.contains(from), "{from} is in\n{text}");
        let message = read("wrong.toml", &text.replacen(from, to, 1)).expect_err(to).to_string();
        for word in words {
            assert!(message.contains(word), "{to}: {message} has no {word}");
        }
    }
}

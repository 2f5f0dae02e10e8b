//! Files that are broken, or made to break the reader: each is refused with file, line and what was
//! expected, soon and without a panic.

use crate::{BODY, file, read, robot};
use std::fmt::Write;
use std::time::{Duration, Instant};
use surefoot_robots::{Options, import, robot_rs};

/// The words of the refusal.
fn refusal(name: &str, text: &str) -> String {
    let started = Instant::now();
    let result = read(name, text).and_then(|imported| robot_rs(&imported.robot));
    assert!(started.elapsed() < Duration::from_secs(20), "{name} takes {:?}", started.elapsed());
    match result {
        Ok(_) => panic!("{name} is not refused"),
        Err(error) => error.to_string(),
    }
}

fn refused(name: &str, text: &str, words: &[&str]) {
    let message = refusal(name, text);
    for word in words {
        assert!(message.contains(word), "{name}: {message} has no {word:?}");
    }
}

#[test]
fn files_that_are_no_xml() {
    refused("empty.urdf", "", &["empty.urdf:1:", "well-formed XML"]);
    refused(
        "truncated.urdf",
        "<robot name=\"r\">\n<link name=\"a\"",
        &["truncated.urdf:1:", "never closed"],
    );
    refused(
        "open.urdf",
        "<robot name=\"r\">\n<link name=\"a\">\n</robot>",
        &["open.urdf:3:", "link"],
    );
    refused("other.urdf", "\n<html/>", &["other.urdf:2:", "<robot>", "<mujoco>", "<html>"]);
    let bomb = "<!DOCTYPE r [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">]>\n<robot name=\"&b;\"/>";
    refused("bomb.urdf", bomb, &["bomb.urdf:1:", "document type definition"]);
    let outside = "<!DOCTYPE r [<!ENTITY a SYSTEM \"file:///etc/passwd\">]><robot name=\"&a;\"/>";
    refused("outside.urdf", outside, &["outside.urdf:1:", "document type definition"]);
    let path = file("bytes.urdf", "");
    std::fs::write(&path, b"<robot name=\"r\">\n\xff\xfe</robot>").expect("written");
    let message = import(&path, &Options::default()).expect_err("refused").to_string();
    assert!(message.contains("bytes.urdf:2:") && message.contains("UTF-8"), "{message}");
    let missing = import("no-such.urdf".as_ref(), &Options::default()).expect_err("refused");
    assert!(missing.to_string().contains("no-such.urdf"), "{missing}");
}

#[test]
fn numbers_that_are_none() {
    let mass = |value: &str| {
        robot(&format!(
            "<link name=\"a\">\n<inertial><mass value=\"{value}\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>"
        ))
    };
    for value in ["NaN", "inf", "-1", "1e12", "one", "1 2", "", "1e400", "0x10"] {
        refused("number.urdf", &mass(value), &["number.urdf:3:", "<mass>", "expected"]);
    }
    let body = BODY.replace("iyz=\"0\"", "");
    refused(
        "missing.urdf",
        &robot(&format!("<link name=\"a\">{body}</link>")),
        &["missing.urdf:2:", "iyz"],
    );
    let body = BODY.replace("<mass value=\"1\"/>", "");
    refused(
        "massless.urdf",
        &robot(&format!("<link name=\"a\">{body}</link>")),
        &["<inertial>", "<mass>"],
    );
}

fn two(joint: &str) -> String {
    robot(&format!("<link name=\"a\">{BODY}</link>\n<link name=\"b\">{BODY}</link>\n{joint}"))
}

#[test]
fn joints_that_make_no_tree() {
    let hinge = |name: &str, parent: &str, child: &str| {
        format!(
            "<joint name=\"{name}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"{child}\"/></joint>\n"
        )
    };
    let good = hinge("j", "a", "b");
    for (name, joints, words) in [
        ("unknown", hinge("j", "a", "c"), vec![":4:", "<child>", "\"c\""]),
        ("orphan", String::new(), vec![":3:", "link b", "a joint that carries it"]),
        ("self", hinge("j", "a", "a"), vec!["link a", "loop"]),
        ("cycle", format!("{good}{}", hinge("k", "b", "a")), vec!["loop"]),
        (
            "twice",
            format!("{good}{}", hinge("k", "a", "b")),
            vec![":5:", "joint k", "link b", "beside j"],
        ),
        ("same-name", format!("{good}{}", hinge("j", "b", "a")), vec![":5:", "name of its own"]),
        ("same-link", format!("{good}<link name=\"b\"/>"), vec![":5:", "name of its own"]),
        ("no-type", good.replace("type=\"revolute\"", ""), vec![":4:", "type"]),
        (
            "planar",
            good.replace("revolute", "planar"),
            vec![":4:", "joint j", "planar", "prismatic"],
        ),
        ("screw", good.replace("revolute", "screw"), vec![":4:", "screw"]),
        ("axis", good.replace("<parent", "<axis xyz=\"0 0 0\"/><parent"), vec![":4:", "axis"]),
        ("short", good.replace("<parent", "<axis xyz=\"0 1\"/><parent"), vec![":4:", "3 numbers"]),
        ("two", good.replace("<parent", "<axis/><axis/><parent"), vec![":4:", "one <axis>"]),
        (
            "limits",
            good.replace("<parent", "<limit lower=\"1\" upper=\"0\"/><parent"),
            vec!["lower ≤ upper"],
        ),
        ("floating", good.replace("revolute", "floating"), vec![":4:", "joint j", "floating"]),
    ] {
        let file = format!("tree-{name}.urdf");
        refused(&file, &two(&joints), &[&[file.as_str()], words.as_slice()].concat());
    }
    refused("nothing.urdf", &robot(""), &["nothing.urdf:1:", "<link>"]);
    refused("still.urdf", &robot("<link name=\"world\"/>"), &["still.urdf:2:", "moves"]);
}

/// As deep and as large as a file can be: no stack overflows, no hour passes.
#[test]
fn sizes_that_would_break_a_recursion() {
    let deep = format!("<robot>{}{}</robot>", "<a>".repeat(100_000), "</a>".repeat(100_000));
    refused("deep.urdf", &deep, &["deep.urdf:1:"]);
    let mut long = format!("<link name=\"l0\">{BODY}</link>\n");
    for i in 1..20_000 {
        let _ = writeln!(
            long,
            "<link name=\"l{i}\">{BODY}</link><joint name=\"j{i}\" type=\"revolute\"><parent link=\"l{}\"/><child link=\"l{i}\"/></joint>",
            i - 1
        );
    }
    refused("long.urdf", &robot(&long), &["degrees of freedom", "128", "--lock"]);
}

#[test]
fn models_that_mujoco_refuses_too() {
    let world = |content: &str| format!("<mujoco>\n<worldbody>{content}</worldbody>\n</mujoco>");
    let ball = "<geom size=\"0.1\"/>";
    for (name, text, words) in [
        ("class", world(&format!("<body>\n<joint class=\"leg\"/>{ball}</body>")), vec![":3:", "\"leg\""]),
        ("size", world("<body><freejoint/>\n<geom size=\"-1\"/></body>"), vec![":3:", "size"]),
        ("shape", world("<body><freejoint/>\n<geom type=\"cone\" size=\"1\"/></body>"), vec![":3:", "cone"]),
        ("joint", world(&format!("<body>\n<joint type=\"screw\"/>{ball}</body>")), vec![":3:", "screw"]),
        ("axis", world(&format!("<body>\n<joint axis=\"0 0 0\"/>{ball}</body>")), vec![":3:", "axis"]),
        ("quat", world(&format!("<body quat=\"0 0 0 0\"><joint/>{ball}</body>")), vec![":2:", "quaternion"]),
        ("twice", world(&format!("<body name=\"b\"><joint/>{ball}</body>\n<body name=\"b\"/>")), vec![":3:", "body b"]),
        ("free", world(&format!("<body><joint/>{ball}<body>\n<freejoint/>{ball}</body></body>")), vec![":3:", "free joint"]),
        ("inertial", world("<body><joint/>\n<inertial mass=\"1\" pos=\"0 0 0\"/></body>"), vec![":3:", "diaginertia"]),
        ("massless", world("<body name=\"b\">\n<joint name=\"j\"/></body>"), vec![":3:", "link b on joint j", "--lock j"]),
        ("include", "<mujoco>\n<include file=\"mjcf-include.xml\"/></mujoco>".into(), vec![":2:", "once"]),
        ("absent", "<mujoco>\n<include file=\"absent-part.xml\"/></mujoco>".into(), vec![":2:", "absent-part.xml"]),
        ("copies", world("\n<replicate count=\"3\"><body/></replicate>"), vec![":3:", "<replicate>", "written out"]),
        ("mesh", "<mujoco><asset><mesh name=\"m\" file=\"m.stl\"/></asset><worldbody><body><freejoint/>\n<geom type=\"mesh\" mesh=\"m\"/></body></worldbody></mujoco>".into(), vec![":2:", "inertia from a mesh", "<inertial>"]),
        ("weld", world(&format!("<body name=\"b\"><joint/>{ball}</body>")).replace("</mujoco>", "<equality>\n<weld body1=\"b\"/></equality></mujoco>"), vec!["<weld> of body1 b", "--free-couplings"]),
    ] {
        let file = format!("mjcf-{name}.xml");
        refused(&file, &text, &[&[file.as_str()], words.as_slice()].concat());
    }
}

//! URDF: what importers lose or get wrong.

use crate::{BODY, file, read, robot};
use surefoot_robots::{BaseChoice, Options, RobotMotion, import};

/// Two bodies on a fixed joint, one rotated by a quarter turn: one body, by the parallel-axis theorem.
#[test]
fn fixed_joints_are_lumped_and_leave_frames() {
    let text = robot(
        r#"<link name="base"><inertial><mass value="2"/><origin xyz="0 0 0.1"/>
             <inertia ixx="1" iyy="2" izz="2.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
           <link name="arm"><inertial><inertia ixx="1" iyy="2" izz="2.5" ixy="0.1" ixz="0" iyz="0"/>
             <mass value="1"/></inertial></link>
           <link name="tip"/>
           <joint name="j" type="fixed"><parent link="base"/><child link="arm"/>
             <origin xyz="0.3 0 0.1" rpy="0 0 1.5707963267948966"/></joint>
           <joint name="k" type="fixed"><parent link="arm"/><child link="tip"/><origin xyz="1 0 0"/></joint>"#,
    );
    let imported = read("lumped.urdf", &text).expect("a robot");
    let robot = imported.robot;
    assert_eq!(robot.links.len(), 1);
    let body = robot.links[0].inertial;
    let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-15, "{a} is not {b}");
    near(body.mass, 3.0);
    near(body.center.x, 0.1);
    near(body.center.z, 0.1);
    // Reduced mass 2·1/3 kg, 0.3 m apart along x; the arm's x and y are exchanged and its xy changes sign.
    let shift = 2.0 / 3.0 * 0.09;
    near(body.inertia.m11, 1.0 + 2.0);
    near(body.inertia.m22, 2.0 + 1.0 + shift);
    near(body.inertia.m33, 5.0 + shift);
    near(body.inertia.m12, -0.1);
    let names: Vec<(&str, bool)> =
        robot.frames.iter().map(|f| (f.name.as_str(), f.is_leaf)).collect();
    assert_eq!(names, [("arm", false), ("tip", true)]);
    let tip = robot.frames[1].pose.translation.vector;
    near(tip.x, 0.3);
    near(tip.y, 1.0);
}

/// The order of elements does not matter, a missing `<inertial>` is no inertia, and what is not read is
/// listed.
#[test]
fn nothing_is_lost_in_silence() {
    let text = format!(
        r#"<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro"><xacro:macro name="m"/>
        <link name="base">{BODY}</link>
        <link name="foot"><inertial><mass value="1" unit="kg"/>
          <inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/><origin xyz="0 0 -0.5"/></inertial>
          <collision><geometry><box size="1 1 1"/></geometry><origin xyz="0 0 0.25"/></collision></link>
        <joint name="j" type="continuous"><limit effort="3" velocity="2"/><axis xyz="0 2 0"/>
          <parent link="base"/><child link="foot"/><dynamics damping="0.5" friction="0.25"/></joint>
        <gazebo/><gazebo reference="foot"><mu1>1</mu1></gazebo></robot>"#
    );
    let path = file("unread.urdf", &text);
    let options = Options { feet: vec!["foot".into()], ..Options::default() };
    let imported = import(&path, &options).expect("a robot");
    let link = &imported.robot.links[1];
    assert_eq!(link.inertial.center.z, -0.5);
    assert_eq!(link.joint.motion, RobotMotion::Continuous);
    assert_eq!(link.joint.axis.y, 1.0);
    let properties = link.joint.properties;
    assert_eq!((properties.damping, properties.friction), (0.5, 0.25));
    assert_eq!(
        (properties.effort, properties.rate, properties.range),
        (Some(3.0), Some(2.0), None)
    );
    let foot = &imported.robot.feet[0];
    assert!(foot.points.len() == 4 && foot.points.iter().all(|p| p.z == -0.25), "{foot:?}");
    let unread: Vec<(&str, usize)> =
        imported.unread.iter().map(|(tag, n)| (tag.as_str(), *n)).collect();
    assert_eq!(unread, [("mass@unit", 1), ("robot/gazebo", 2), ("robot/xacro:macro", 1)]);
}

/// A prefix that nobody declares is no reason to refuse a robot: files of Gazebo have it.
#[test]
fn undeclared_prefixes_are_passed_over() {
    let text = robot(&format!(r#"<link name="base">{BODY}</link><sensor:camera a:b="1"/>"#));
    let imported = read("prefix.urdf", &text).expect("a robot");
    assert_eq!(imported.unread.keys().collect::<Vec<_>>(), ["robot/sensor:camera"]);
}

/// A locked joint is a fixed one at its angle.
#[test]
fn joints_are_locked_where_the_user_says() {
    let text = robot(&format!(
        r#"<link name="world"/><link name="a">{BODY}</link><link name="b">{BODY}</link>
        <joint name="j" type="revolute"><parent link="world"/><child link="a"/><axis xyz="0 0 1"/>
          <origin xyz="0 0 1"/></joint>
        <joint name="k" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/>
          <origin xyz="2 0 0"/></joint>"#
    ));
    let path = file("locked.urdf", &text);
    let quarter = std::f64::consts::FRAC_PI_2;
    let locks = vec![("j".to_owned(), quarter)];
    let imported = import(&path, &Options { locks, ..Options::default() }).expect("a robot");
    assert_eq!(imported.locked, [("j".to_owned(), quarter)]);
    let robot = imported.robot;
    assert_eq!(robot.links.len(), 1);
    let at = robot.links[0].joint.origin.translation.vector;
    assert!((at - nalgebra::Vector3::new(0.0, 2.0, 1.0)).norm() < 1e-15, "{at}");
    let wrong = Options { locks: vec![("jj".into(), 0.0)], ..Options::default() };
    let message = import(&path, &wrong).expect_err("no such joint").to_string();
    assert!(message.contains("--lock jj") && message.contains("is j meant"), "{message}");
}

/// The base is the user's choice, unless its name says it.
#[test]
fn the_base_floats_or_not() {
    let text = robot(&format!(
        r#"<link name="torso">{BODY}</link><link name="a">{BODY}</link>
        <joint name="j" type="prismatic"><parent link="torso"/><child link="a"/></joint>"#
    ));
    let path = file("base.urdf", &text);
    let of = |base| import(&path, &Options { base, ..Options::default() }).expect("a robot").robot;
    assert_eq!(of(BaseChoice::Auto).degrees_of_freedom(), 7);
    assert_eq!(of(BaseChoice::Floating).degrees_of_freedom(), 7);
    let fixed = of(BaseChoice::Fixed);
    assert_eq!((fixed.degrees_of_freedom(), fixed.mass(), fixed.fixed_mass), (1, 1.0, 1.0));
}

/// Refused with the link and the inequality; within a lumped body that is sound, only noted.
#[test]
fn inertias_that_no_body_has_are_refused() {
    let of = |ixx: &str, fixed: &str| {
        robot(&format!(
            r#"<link name="base">{BODY}</link>
            <link name="plate"><inertial><mass value="0.1"/>
              <inertia ixx="{ixx}" iyy="0.01" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
            <joint name="j" type="{fixed}"><parent link="base"/><child link="plate"/></joint>"#
        ))
    };
    let message =
        read("bad-inertia.urdf", &of("0.04", "revolute")).expect_err("refused").to_string();
    for part in
        ["bad-inertia.urdf:3", "link plate", "4.0000e-2 ≤ 1.0000e-2 + 2.0000e-2 does not hold"]
    {
        assert!(message.contains(part), "{message}: no {part}");
    }
    let imported = read("bad-part.urdf", &of("0.04", "fixed")).expect("the whole is sound");
    assert!(imported.notes.iter().any(|note| note.contains("link plate")), "{:?}", imported.notes);
    // A plate: the largest moment is the sum of the others, to rounding.
    read("plate.urdf", &of("0.010000000001", "revolute")).expect("a plate");
}

/// A joint that carries no mass has no acceleration: refused by name. One inside a branch is no harm.
#[test]
fn joints_that_move_nothing_are_refused() {
    let chain = |last: &str| {
        robot(&format!(
            r#"<link name="base">{BODY}</link><link name="a"/><link name="b">{last}</link>
            <joint name="j" type="revolute"><parent link="base"/><child link="a"/></joint>
            <joint name="k" type="revolute"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>"#
        ))
    };
    let message = read("nothing.urdf", &chain("")).expect_err("refused").to_string();
    assert!(message.contains("link b on joint k") && message.contains("--lock k"), "{message}");
    assert_eq!(read("inside.urdf", &chain(BODY)).expect("a robot").robot.links.len(), 3);
}

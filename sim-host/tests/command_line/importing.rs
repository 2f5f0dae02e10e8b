//! `import` and `dynamics`: files, exit statuses, one JSON document.

use crate::program::{folder, said, surefoot};
use serde_json::Value;

/// A pendulum: 2 kg, 0.5 m below its hinge, 0.1 kg m² about its centre of mass.
const PENDULUM: &str = r#"<robot name="pendulum">
<link name="world"/>
<link name="bob"><inertial><origin xyz="0 0 -0.5"/><mass value="2"/>
  <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="revolute"><parent link="world"/><child link="bob"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="5" velocity="3"/></joint>
</robot>
"#;

const STATES: &str = r#"{ "base": "fixed", "joints": [{ "name": "hinge", "idx_q": 0, "nq": 1, "idx_v": 0, "nv": 1 }],
  "states": [{ "q": [0.5], "v": [1.0], "a": [2.0], "tau": [3.0] }] }"#;

fn document(stdout: &str) -> Value {
    serde_json::from_str(stdout).expect("one document")
}

#[test]
fn a_robot_is_imported_and_evaluated() {
    let folder = folder("importing");
    std::fs::write(folder.join("pendulum.urdf"), PENDULUM).expect("writable");
    std::fs::write(folder.join("states.json"), STATES).expect("writable");
    let (status, stdout, stderr) = said(&surefoot(&folder, &["import", "pendulum.urdf", "--json"]));
    assert_eq!(status, Some(0), "{stderr}");
    let imported = document(&stdout);
    assert_eq!(imported["degrees_of_freedom"], 1);
    assert_eq!(imported["mass_kg"], 2.0);
    let source = std::fs::read_to_string(folder.join("pendulum/robot.rs")).expect("written");
    assert!(source.contains("Tree<T, 1, 1, 1>"), "{source}");
    // I = 0.1 + 2·0.25 kg m², and the weight's moment is m g l sin q.
    let (inertia, moment) = (0.6, 2.0 * 9.81 * 0.5 * 0.5_f64.sin());
    for robot in ["pendulum.urdf", "pendulum/robot.toml"] {
        let arguments = ["dynamics", robot, "--states", "states.json", "--json"];
        let (status, stdout, stderr) = said(&surefoot(&folder, &arguments));
        assert_eq!(status, Some(0), "{stderr}");
        let state = &document(&stdout)["states"][0];
        for (found, expected) in [
            (&state["crba"][0][0], inertia),
            (&state["rnea"][0], 2.0 * inertia + moment),
            (&state["aba"][0], (3.0 - moment) / inertia),
        ] {
            let found = found.as_f64().expect("a number");
            assert!((found - expected).abs() < 1e-14, "{robot}: {found} is not {expected}");
        }
    }
    let (status, stdout, _) = said(&surefoot(&folder, &["import", "pendulum.urdf"]));
    assert!(status == Some(0) && stdout.contains("1 degrees of freedom"), "{stdout}");
}

#[test]
fn wrong_robots_options_and_states_are_refused() {
    let folder = folder("importing-refused");
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).expect("writable");
    write("good.urdf", PENDULUM);
    write("bad.urdf", &PENDULUM.replace("value=\"2\"", "value=\"NaN\""));
    write("good.json", STATES);
    write("short.json", &STATES.replace("[1.0]", "[]"));
    write("other.json", &STATES.replace("hinge", "hinges"));
    write("no.json", "{");
    let dynamics = |states| ["dynamics", "good.urdf", "--states", states];
    let cases: [(&[&str], &[&str]); 11] = [
        (&["import", "bad.urdf"], &["bad.urdf:3", "<mass>", "NaN"]),
        (&["import", "missing.urdf"], &["missing.urdf"]),
        (&["import", "good.urdf", "--lock", "hing"], &["--lock hing", "is hinge meant"]),
        (&["import", "good.urdf", "--lock", "hinge=x"], &["JOINT=ANGLE", "\"x\""]),
        (&["import", "good.urdf", "--feet", "bob"], &["foot bob", "no collision shape", "--sole"]),
        (&["import", "good.urdf", "--sole", "bob=1,0,0,1,0"], &["X_MIN", "low to high"]),
        (&["import", "good.urdf", "--lock", "hinge"], &["no link of it moves"]),
        (&dynamics("short.json"), &["short.json", "state 0", "1 finite numbers in v"]),
        (&dynamics("other.json"), &["other.json", "hinges", "is hinge meant"]),
        (&dynamics("no.json"), &["no.json", "line 1"]),
        (&["dynamics", "bad.urdf", "--states", "good.json"], &["bad.urdf:3"]),
    ];
    for (arguments, words) in cases {
        let (status, stdout, stderr) = said(&surefoot(&folder, arguments));
        assert_eq!(status, Some(2), "{arguments:?}: {stderr}");
        assert!(stdout.is_empty(), "{arguments:?} printed {stdout}");
        for word in words {
            assert!(stderr.contains(word), "{arguments:?} says {stderr:?}, without {word:?}");
        }
    }
    let (status, stdout, _) = said(&surefoot(&folder, &["import", "bad.urdf", "--json"]));
    assert_eq!(status, Some(2));
    let error = &document(&stdout)["error"];
    assert_eq!((&error["kind"], &error["line"]), (&"malformed".into(), &3.into()));
    // A folder that cannot be made is no fault of the input.
    write("file", "");
    let arguments = ["import", "good.urdf", "--out", "file/inside"];
    let (status, _, stderr) = said(&surefoot(&folder, &arguments));
    assert!(status == Some(1) && stderr.contains("file/inside"), "{stderr}");
}

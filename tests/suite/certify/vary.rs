//! Files of what varies: what is refused, and with which words.

use surefoot_host::certify::{Definition, Sampling, Study};

fn refused(scene: &str, vary: &str) -> String {
    let definition = Definition::new(scene, ("vary.toml", vary), 1, Sampling::Sobol);
    let study = definition.and_then(Study::new);
    study.map(|study| study.coordinates().len()).expect_err(vary).to_string()
}

#[test]
fn what_is_wrong_is_told_with_what_was_expected() {
    for (vary, expected) in [
        ("", "nothing varies: expected tables [vary.\"FIELD\"]"),
        ("a = 1", "vary.toml:1: a: expected `require`, [scene] and tables"),
        ("require = 'standing'", "expected `upright` or `settled`"),
        (
            "[vary.\"block.mass_kg\"]",
            "vary.toml:1: vary.\"block.mass_kg\": 0 distributions: expected one of",
        ),
        (
            "[vary.\"block.mass_kg\"]\nuniform = [1, 2]\nset = [1.0, 2.0]",
            "2 distributions: expected one of",
        ),
        ("\n\n[vary.\"block.mass_kg\"]\nuniform = [3, 2]", "vary.toml:3:"),
        (
            "[vary.\"block.mass_kg\"]\nuniform = [3, 2]",
            "uniform = [3, 2]: expected a smaller number, then a larger one",
        ),
        ("[vary.\"block.mass_kg\"]\nuniform = [nan, 2]", "expected a smaller number"),
        ("[vary.\"block.mass_kg\"]\nuniform = [1, 2, 3]", "3 numbers; expected two"),
        ("[vary.\"block.mass_kg\"]\nintegers = [1]", "1 numbers; expected two"),
        ("[vary.\"block.mass_kg\"]\nlog_uniform = [0, 2]", "expected numbers above 0"),
        (
            "[vary.\"block.mass_kg\"]\nnormal = [2, 0]",
            "expected a mean, then a standard deviation above 0",
        ),
        (
            "[vary.\"block.mass_kg\"]\nnormal = [2, 1]\nwithin = [90, 91]",
            "within six deviations of the mean",
        ),
        (
            "[vary.\"block.mass_kg\"]\nuniform = [1, 2]\nwithin = [1, 2]",
            "within: without effect here",
        ),
        ("[vary.\"block.mass_kg\"]\nnormal = [1.8, 0.4]", "at -0.3"),
        ("[vary.\"block.mass_kg\"]\nunifrom = [1, 2]", "unknown field `unifrom`, expected one of"),
        ("[vary.\"block.masskg\"]\nuniform = [1, 2]", "unknown field `masskg`, expected one of"),
        ("[vary.\"block..mass_kg\"]\nuniform = [1, 2]", "expected names with dots between them"),
        ("[vary.\"pushes[0].at_s\"]\nuniform = [1, 2]", "expected a list"),
        (
            "[vary.\"block.velocity_mps[3]\"]\nuniform = [1, 2]",
            "entry 3 of a list of 3; expected a number from 0 to 2",
        ),
        ("[vary.\"block.mass_kg\"]\nset = [1.8, \"heavy\"]", "expected f64"),
        ("[vary.\"block.mass_kg\"]\nset = [1.8]", "expected two values or more"),
        (
            "[vary.\"block.mass_kg\"]\ndirection = \"any\"",
            "expected `length`, or a vector that the scene file has",
        ),
        (
            "[vary.\"acting.delay_s\"]\nuniform = [0.5, 1.5]\nfactor = true",
            "expected a number or a list of numbers that the scene file has",
        ),
        ("[vary.\"feet.floor.static_friction\"]\nuniform = [-1, 1]", "feet.floor.static_friction"),
        ("[vary.\"sensing.encoder_counts\"]\nuniform = [1000, 2000]", "expected"),
        ("[vary.\"sensing.seed\"]\nseed = true", "0 coordinates vary: expected 1 to 256"),
        ("[vary.\"sensing.seed\"]\nseed = false", "expected true"),
        (
            "[vary.\"block.mass_kg\"]\nuniform = [1, 2]\n[vary.b]\nfields = [\"block.mass_kg\"]\nuniform = [1, 2]",
            "varied twice",
        ),
        (
            "[scene]\n\"block.mass\" = 1.0\n[vary.\"block.mass_kg\"]\nuniform = [1, 2]",
            "scene: block.mass: unknown field `mass`",
        ),
        ("[vary.x]\nfields = []\nuniform = [1, 2]", "expected at least one path"),
        (
            "[vary.\"set_point.position_m[0]\"]\ntime = [0, 9]",
            "expected times within the scene's 3 s",
        ),
    ] {
        let message = refused("experiment-2", vary);
        assert!(message.contains(expected), "{vary}\n  {message}\n  {expected}");
    }
    assert!(refused("chain", "[vary.duration_s]\nuniform = [1, 2]").contains("expected a robot"));
    assert!(refused("wlak", "").contains("did you mean 'walk'"));
}

/// Any field of any scene of a robot, also those that the file leaves out.
#[test]
fn any_field_varies() {
    for (scene, vary) in [
        ("stand", "[vary.\"plant.bodies.\\\"central body\\\".added_mass_kg\"]\nuniform = [0.1, 5]"),
        ("stand", "[vary.\"terrain.slope_deg\"]\nnormal = [0, 3]\nwithin = [-9, 9]"),
        ("stand", "[vary.\"controller.position_gain\"]\nlog_uniform = [0.5, 2]\nfactor = true"),
        (
            "stand-loaded",
            "[vary.\"sensing.encoder_counts\"]\nset = [4096, 65536]\n[vary.\"sensing.seed\"]\nseed = true",
        ),
        (
            "walk-pushed",
            "[vary.\"pushes[1].force_n\"]\ndirection = \"horizontal\"\nlength = [100, 500]",
        ),
        (
            "walk-pushed",
            "[vary.\"pushes[1].force_n\"]\ndirection = \"any\"\n[vary.\"pushes[0].at_s\"]\ntime = [2, 4]",
        ),
        ("walk", "[vary.\"walk[0].forward_mps\"]\nuniform = [0.1, 0.5]"),
        (
            "stand",
            "[scene]\npushes = [{ at_s = 1, duration_s = 0.1, force_n = [1, 0, 0] }]\n[vary.\"pushes[0].at_s\"]\ntime = [0, 2]",
        ),
        ("experiment-2", "[vary.\"feet.outline\"]\nset = [\"A\", \"M\"]"),
    ] {
        let definition = Definition::new(scene, ("vary.toml", vary), 1, Sampling::Sobol);
        let study = definition.and_then(Study::new).expect(vary);
        for sample in 0..3 {
            study.scene(sample, &study.point(sample)).expect(vary);
        }
    }
}

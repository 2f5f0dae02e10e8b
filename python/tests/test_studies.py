import pickle

import numpy as np
import pytest
import surefoot

SAMPLES = 12


def test_rows_do_not_depend_on_who_runs_them(short_scene, vary):
    study = surefoot.Study(short_scene, vary, seed=5)
    rows = study.run(range(SAMPLES), workers=1)
    again = pickle.loads(pickle.dumps(study))
    assert again.run(reversed(range(SAMPLES)), workers=2)[::-1] == rows
    assert len({row["bits"] for row in rows}) == SAMPLES
    assert surefoot.Study(short_scene, vary, seed=6).run([0]) != rows[:1]


def test_a_samples_scene_replays_to_the_same_bits(short_scene, vary):
    study = surefoot.Study(short_scene, vary)
    [row] = study.run([7])
    scene = study.scene(7)
    assert scene.run().bits == row["bits"]
    mass, friction = study.values([7])[0]
    assert f"mass_kg = {mass}" in scene.text
    assert f"static_friction = {friction}" in scene.text


def test_values_have_their_distributions(short_scene, vary):
    study = surefoot.Study(short_scene, vary)
    values = study.values(range(1024))
    assert study.coordinates == ["block.mass_kg", "friction"]
    # A scrambled Sobol sequence has one of 2^k points in each of 2^k intervals.
    counts, _ = np.histogram(values[:, 0], bins=64, range=(1.0, 12.0))
    assert counts.min() == counts.max() == 16


def test_a_certificate_wants_each_sample_once(short_scene, vary, tmp_path):
    study = surefoot.Study(short_scene, vary)
    rows = study.run(range(SAMPLES))
    failures = sum(row["failure"] != "" for row in rows)
    certificate = study.certificate(rows, samples=SAMPLES, confidence=0.95)
    probability = certificate["failure_probability"]
    assert certificate["failures"] == failures
    assert probability["estimate"] == failures / SAMPLES
    assert probability["low"] <= probability["estimate"] <= probability["high"]
    with pytest.raises(ValueError, match="sample 3 of 12 is missing"):
        study.certificate([row for row in rows if row["sample"] != 3], samples=SAMPLES)
    with pytest.raises(ValueError, match="sample 3 is there twice"):
        study.certificate([*rows, rows[3]], samples=SAMPLES)
    study.save(rows, tmp_path / "study", samples=SAMPLES)
    assert (tmp_path / "study" / "runs.csv").read_text().count("\n") == 1 + SAMPLES


def test_wrong_input_is_told(short_scene):
    def refused(text: str, what: str) -> None:
        with pytest.raises(ValueError, match=what):
            surefoot.Study(short_scene, text + "\n")

    refused('[vary."block.mass"]\nuniform = [1.0, 2.0]', "unknown field `mass`, expected one of")
    refused('[vary."block.mass_kg"]\nuniform = [2.0, 1.0]', "expected a smaller number, then a larger one")
    refused('[vary."block.mass_kg"]\nuniform = [-1.0, 1.0]', "block.mass_kg")
    refused('[vary."block.mass_kg"]\nset = ["a", "b"]', "expected f64")

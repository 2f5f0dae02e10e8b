import numpy as np
import pytest
import surefoot


def test_a_run_is_arrays():
    scene = surefoot.Scene("experiment-2")
    run = scene.run()
    ticks = run.time_s.size
    assert run.outcome in ("balanced", "completed")
    assert run.failure is None
    assert run.positions.shape == (ticks, 7 + len(scene.joints))
    assert run.velocities.shape == (ticks, 6 + len(scene.joints))
    assert run.torques.shape == (ticks, len(scene.joints))
    assert run.foot_forces.shape == (ticks, 2)
    assert run.time_s[-1] == pytest.approx(scene.duration_s, rel=1e-12)
    np.testing.assert_allclose(np.linalg.norm(run.positions[:, 3:7], axis=1), 1.0, rtol=1e-9)
    assert 0.0 < run.margins["tilt"] < 1.0
    assert run.bits == scene.run().bits != scene.run(scalar="f32").bits


def test_ticks_and_steps_are_the_run():
    scene = surefoot.Scene("experiment-2").replaced({"duration_s": 0.2})
    run = scene.run()
    sim = surefoot.Simulation(scene)
    for row in range(run.time_s.size - 1):
        np.testing.assert_array_equal(sim.positions, run.positions[row])
        torques = sim.tick()
        np.testing.assert_array_equal(torques, run.torques[row])
        sim.step(torques)
    np.testing.assert_array_equal(sim.velocities, run.velocities[-1])
    assert sim.time_s == run.time_s[-1]


def test_torques_of_ones_own():
    sim = surefoot.Simulation(surefoot.Scene("stand"))
    height = sim.positions[2]
    for _ in range(100):
        sim.step(np.zeros(12))
    assert sim.positions[2] < height - 0.05
    for wrong in ([0.0] * 11, [np.nan] * 12):
        with pytest.raises(ValueError, match="expected 12 finite numbers"):
            sim.step(wrong)


def test_wrong_input_is_told():
    with pytest.raises(ValueError, match="no scene is called 'walkk'.*did you mean 'walk'"):
        surefoot.Scene("walkk")
    with pytest.raises(ValueError, match="mass_kgg"):
        surefoot.Scene("experiment-2").replaced({"block.mass_kgg": 1.0})
    with pytest.raises(ValueError, match="f16: expected f32 or f64"):
        surefoot.Scene("stand").run(scalar="f16")
    with pytest.raises(ValueError, match="expected a robot"):
        surefoot.Scene("chain")

"""Balance control for legged robots: simulate, close the loop, certify.

    >>> import surefoot
    >>> run = surefoot.Scene("experiment-2").run()
    >>> run.outcome
    'balanced'
    >>> run.positions.shape            # a row a tick: position, quaternion (scalar first), joint angles
    (1501, 19)

Lengths are in metres, angles in radians, torques in newton metres, times in seconds. Wrong input raises ``ValueError``
with what was found and what was expected.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike, fspath
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _surefoot

__all__ = ["Robot", "Run", "Scene", "Simulation", "Study"]

Row = dict[str, Any]
"""A run of a sample: `sample`, `failure` (empty for none), `time_s`, `reserve`, `margins`, `bits`."""


class Robot:
    """A robot of a URDF, MJCF or ``robot.toml`` file, and its dynamics.

    `convention` says how a floating base is written: ``"mujoco"`` (quaternion w, x, y, z, linear velocity in the
    world's axes) or ``"pinocchio"`` (x, y, z, w, in its own axes).
    """

    def __init__(
        self,
        path: str | PathLike[str],
        *,
        lock: Mapping[str, float] | None = None,
        convention: str = "mujoco",
    ) -> None:
        self._robot = _surefoot.Robot(fspath(path), None if lock is None else dict(lock), convention)

    @property
    def name(self) -> str:
        """The file's name for it."""
        return self._robot.name

    @property
    def mass(self) -> float:
        """Of all that moves, kg."""
        return self._robot.mass

    @property
    def nq(self) -> int:
        """Coordinates of a state."""
        return self._robot.nq

    @property
    def nv(self) -> int:
        """Velocities of a state."""
        return self._robot.nv

    @property
    def joints(self) -> list[str]:
        """Names of the joints, in the order of coordinates."""
        return self._robot.joints

    @property
    def links(self) -> list[str]:
        """Names of the links that move, in the same order."""
        return self._robot.links

    def home(self) -> NDArray[np.float64]:
        """Coordinates with all joints at 0."""
        return self._robot.home()

    def dynamics(
        self,
        q: ArrayLike,
        v: ArrayLike | None = None,
        *,
        a: ArrayLike | None = None,
        tau: ArrayLike | None = None,
    ) -> dict[str, NDArray[np.float64]]:
        """Dynamics at a state, or at each row of states.

        Returns ``inverse`` (torques for the accelerations `a`), ``forward`` (accelerations under the torques `tau`),
        ``mass_matrix`` (nv × nv) and ``link_positions`` (links × 3, m); with a first axis where `q` has rows. What is
        left out is 0.
        """
        q = np.asarray(q, dtype=np.float64)
        rows = np.atleast_2d(q)
        zeros = np.zeros((rows.shape[0], self.nv))
        given = [zeros if x is None else np.atleast_2d(np.asarray(x, dtype=np.float64)) for x in (v, a, tau)]
        found = self._robot.dynamics(rows, *given)
        return found if q.ndim == 2 else {name: array[0] for name, array in found.items()}


class Run:
    """The record of a run: arrays with a row a tick."""

    def __init__(self, run: _surefoot.Run) -> None:
        self._run = run

    @property
    def outcome(self) -> str:
        """``balanced``, ``completed``, ``stopped``, ``fell`` or ``failed``."""
        return self._run.outcome

    @property
    def failure(self) -> dict[str, Any] | None:
        """Why it ended early: kind, time_s, where, advice."""
        return json.loads(self._run.failure_json)

    @property
    def margins(self) -> dict[str, float | None]:
        """The least of torque, friction, pressure_m, tilt and height; 1 is unloaded, 0 at the limit."""
        return json.loads(self._run.margins_json)

    @property
    def bits(self) -> str:
        """Digits that tell this motion from any that is not the same to the last bit."""
        return self._run.bits

    @property
    def time_s(self) -> NDArray[np.float64]:
        """Times of the ticks."""
        return self._run.time_s

    @property
    def positions(self) -> NDArray[np.float64]:
        """Position and quaternion (scalar first) of the central body, joint angles."""
        return self._run.positions

    @property
    def velocities(self) -> NDArray[np.float64]:
        """Body twist of the central body (linear, angular), joint rates."""
        return self._run.velocities

    @property
    def torques(self) -> NDArray[np.float64]:
        """Of the motors."""
        return self._run.torques

    @property
    def foot_forces(self) -> NDArray[np.float64]:
        """Vertical forces of the ground on the feet, N."""
        return self._run.foot_forces


class Scene:
    """A robot, where it starts, its controller, its ground, and what happens to it: a built-in scene by its name, or a
    file by its path."""

    def __init__(self, scene: str | PathLike[str]) -> None:
        self._scene = _surefoot.Scene(fspath(scene))

    @classmethod
    def parse(cls, text: str, name: str = "scene") -> Scene:
        """A scene from its TOML text."""
        return cls._of(_surefoot.Scene.parse(text, name))

    @classmethod
    def _of(cls, scene: _surefoot.Scene) -> Scene:
        made = cls.__new__(cls)
        made._scene = scene
        return made

    def replaced(self, values: Mapping[str, Any]) -> Scene:
        """The same scene with other values in fields, by their paths: ``{"block.mass_kg": 2.0}``."""
        scene = self._scene
        for path, value in values.items():
            scene = scene.with_json(path, json.dumps(value))
        return self._of(scene)

    @property
    def name(self) -> str:
        """The built-in's, or the file's."""
        return self._scene.name

    @property
    def description(self) -> str:
        """One line."""
        return self._scene.description

    @property
    def duration_s(self) -> float:
        """Simulated time."""
        return self._scene.duration_s

    @property
    def text(self) -> str:
        """TOML."""
        return self._scene.text

    @property
    def joints(self) -> list[str]:
        """Names of the joints in the order of torques."""
        return self._scene.joints

    def run(self, *, scalar: str = "f64", supervised: bool = True) -> Run:
        """Runs it under its controller, which computes in `scalar`: ``"f64"``, or ``"f32"`` as on the chip."""
        return Run(self._scene.run(scalar, supervised))


class Simulation:
    """A scene step by step, with torques of one's own or those of its controller. Sensors and motors are ideal.

    >>> sim = surefoot.Simulation(surefoot.Scene("stand"))
    >>> while sim.time_s < 0.1:
    ...     sim.step(sim.tick())
    """

    def __init__(self, scene: Scene, *, scalar: str = "f64") -> None:
        self._simulation = _surefoot.Simulation(scene._scene, scalar)

    @property
    def time_s(self) -> float:
        """Simulated time so far."""
        return self._simulation.time_s

    @property
    def positions(self) -> NDArray[np.float64]:
        """Position and quaternion (scalar first) of the central body, joint angles."""
        return self._simulation.positions

    @property
    def velocities(self) -> NDArray[np.float64]:
        """Body twist of the central body (linear, angular), joint rates."""
        return self._simulation.velocities

    @property
    def foot_forces(self) -> NDArray[np.float64]:
        """Vertical forces of the ground on the feet, N."""
        return self._simulation.foot_forces

    def tick(self) -> NDArray[np.float64]:
        """The controller's torques for the present state; it counts as one of its ticks."""
        return self._simulation.tick()

    def step(self, torques: ArrayLike) -> None:
        """Advances by one period of the controller under torques, one a joint."""
        self._simulation.step(np.ascontiguousarray(torques, dtype=np.float64))


class Study:
    """Samples of a scene in which something varies.

    `vary` is the path of a file, or its text. A sample is decided by the study and its number alone: whichever process
    or machine runs it, its row is the same. Studies can be pickled.
    """

    def __init__(
        self,
        scene: str | PathLike[str],
        vary: str | PathLike[str],
        *,
        seed: int = 1,
        sampling: str = "sobol",
        scalar: str = "f64",
    ) -> None:
        text, name = fspath(vary), "vary"
        if "\n" not in text:
            name = text
            with open(name, encoding="utf-8") as file:
                text = file.read()
        self._study = _surefoot.Study(fspath(scene), text, seed, sampling, scalar, name)

    @classmethod
    def _again(cls, definition: str, scalar: str) -> Study:
        made = cls.__new__(cls)
        made._study = _surefoot.Study.from_json(definition, scalar)
        return made

    def __reduce__(self) -> tuple[Any, ...]:
        return Study._again, (self._study.definition_json, self._study.scalar)

    @property
    def coordinates(self) -> list[str]:
        """Names of what varies."""
        return self._study.coordinates

    def values(self, samples: Iterable[int]) -> NDArray[np.float64]:
        """What samples have: a row a sample, a column a coordinate."""
        return self._study.values(list(samples))

    def scene(self, sample: int) -> Scene:
        """The scene of a sample."""
        return Scene.parse(self._study.scene_text(sample), f"sample-{sample}")

    def run(self, samples: Iterable[int], *, workers: int | None = None) -> list[Row]:
        """Runs samples by their numbers, on so many processors (all, unless said): a row each, in their order."""
        return json.loads(self._study.run_json(list(samples), workers))

    def certificate(self, rows: Sequence[Row], *, samples: int, confidence: float = 0.99) -> dict[str, Any]:
        """What the rows of samples 0 to `samples` − 1 come to: among others ``failure_probability`` with estimate, low
        and high. A sample that is missing or there twice is refused."""
        return json.loads(self._study.certificate_json(json.dumps(list(rows)), samples, confidence))

    def save(self, rows: Sequence[Row], folder: str | PathLike[str], *, samples: int) -> None:
        """Writes the rows as a folder of which ``surefoot certify merge FOLDER`` makes the report."""
        self._study.save_json(json.dumps(list(rows)), samples, fspath(folder))

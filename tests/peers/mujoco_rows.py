"""MuJoCo's side of `cargo xtask peers`: the models of a folder, timed; one JSON document on stdout."""

import json
import pathlib
import sys
import time

import mujoco
import numpy as np

INTEGRATORS = {
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}

# A motion that diverges is seen in its energy; without this a log of it is left where the command was given.
mujoco.set_mju_user_warning(lambda message: None)


def start(folder, name, integrator, h):
    model = mujoco.MjModel.from_xml_path(str(folder / f"{name}.xml"))
    model.opt.integrator = INTEGRATORS[integrator]
    model.opt.timestep = h
    # Joints' springs are implicit in `implicitfast` only where damping is; leave the rest as it comes.
    data = mujoco.MjData(model)
    state = json.loads((folder / f"{name}.json").read_text())
    data.qpos[:] = state["qpos"]
    data.qvel[:] = state["qvel"]
    mujoco.mj_forward(model, data)
    return model, data


def energy(model, data):
    mujoco.mj_forward(model, data)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_energyVel(model, data)
    return float(data.energy[0] + data.energy[1])


def step_time(folder, name, integrator):
    model, data = start(folder, name, integrator, 1e-3)
    if name == "biped-feet":
        mujoco.mj_step(model, data, 1000)
    steps = max(200_000 // model.nv, 1000)
    begun = time.perf_counter()
    mujoco.mj_step(model, data, steps)
    us = (time.perf_counter() - begun) * 1e6 / steps
    print(f"  {name}, {integrator}: {us:.2f} µs a step", file=sys.stderr)
    finite = bool(np.isfinite(data.qpos).all())
    return {
        "model": name,
        "integrator": integrator,
        "us_per_step": us,
        "contacts": int(data.ncon),
        "finite": finite,
    }


def long_run(folder, name, integrator, h, seconds):
    model, data = start(folder, name, integrator, h)
    first = energy(model, data)
    worst, computing = 0.0, 0.0
    for _ in range(200):
        begun = time.perf_counter()
        mujoco.mj_step(model, data, max(round(seconds / h / 200), 1))
        computing += time.perf_counter() - begun
        error = abs(energy(model, data) - first)
        worst = error if not error <= worst else worst
    print(f"  {name}, {integrator} at {h} s: {worst:.1e} J", file=sys.stderr)
    return {
        "model": name,
        "integrator": integrator,
        "step_s": h,
        "seconds": seconds,
        "energy_error_j": worst if np.isfinite(worst) else None,
        "computing_s_per_s": computing / seconds,
    }


def main():
    folder = pathlib.Path(sys.argv[1])
    ours = json.loads(pathlib.Path(sys.argv[2]).read_text())
    steps = [
        step_time(folder, row["model"], integrator)
        for row in ours["steps"]
        for integrator in INTEGRATORS
    ]
    # Each of our long runs against theirs over the same time, at steps down to a twentieth.
    energy_rows = []
    for row in ours["energy"]:
        seconds = row["step_s"] * 1e5
        for integrator in INTEGRATORS:
            for share in [1.0, 0.5, 0.2, 0.1, 0.05]:
                h = row["step_s"] * share
                if seconds / h > 5e5 or h < 2e-4:
                    continue
                energy_rows.append(long_run(folder, row["model"], integrator, h, seconds))
    print(json.dumps({"version": mujoco.__version__, "steps": steps, "energy": energy_rows}))


main()

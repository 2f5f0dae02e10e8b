"""MuJoCo's side of `surefoot chart work-precision --peers`: a request a line on stdin, an answer a line on stdout."""

import json
import signal
import sys
import time

import mujoco
import numpy as np

INTEGRATORS = {
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}
# A request that takes longer, in seconds, ends the process.
LIMIT = 120
# Energy is looked at in so many steps at most.
ENERGIES = 2000

models = {}


def start(request):
    xml = request["model"]["xml"]
    if xml not in models:
        model = mujoco.MjModel.from_xml_string(xml)
        models[xml] = (model, mujoco.MjData(model))
    model, data = models[xml]
    model.opt.integrator = INTEGRATORS[request["integrator"]]
    model.opt.timestep = request["step_s"]
    mujoco.mj_resetData(model, data)
    data.qpos[:] = request["model"]["qpos"]
    data.qvel[:] = request["model"]["qvel"]
    mujoco.mj_forward(model, data)
    return model, data


def is_sound(data):
    # MuJoCo begins anew where a motion has diverged, and says so in its warnings.
    return bool(np.isfinite(data.qpos).all()) and not any(w.number for w in data.warning)


def energy(model, data):
    copy = mujoco.MjData(model)
    copy.qpos[:], copy.qvel[:] = data.qpos, data.qvel
    mujoco.mj_forward(model, copy)
    mujoco.mj_energyPos(model, copy)
    mujoco.mj_energyVel(model, copy)
    return float(copy.energy[0] + copy.energy[1])


def states(model, data):
    copy = mujoco.MjData(model)
    copy.qpos[:] = data.qpos
    mujoco.mj_kinematics(model, copy)
    bodies = [copy.body(f"b{k}") for k in range(model.nbody - 1)]
    return [[*map(float, body.xpos), *map(float, body.xquat)] for body in bodies]


def play(request):
    model, data = start(request)
    steps = request["samples"] * request["divisions"]
    every = -(-steps // ENERGIES)
    places, energies = [], [[0.0, energy(model, data)]]
    for step in range(1, steps + 1):
        mujoco.mj_step(model, data)
        if not is_sound(data):
            return {"places": places, "energies": energies, "failed_at_s": step * request["step_s"]}
        if step % every == 0:
            energies.append([step * request["step_s"], energy(model, data)])
        if step % request["divisions"] == 0:
            places.append(states(model, data))
    return {"places": places, "energies": energies, "failed_at_s": None}


def timed(request):
    model, data = start(request)
    begun = time.thread_time()
    mujoco.mj_step(model, data, request["samples"] * request["divisions"])
    seconds = time.thread_time() - begun
    return {"seconds": seconds if is_sound(data) else None}


print(json.dumps({"version": mujoco.__version__}), flush=True)
for line in sys.stdin:
    signal.alarm(LIMIT)
    request = json.loads(line)
    print(json.dumps(timed(request) if request["is_timed"] else play(request)), flush=True)
    signal.alarm(0)

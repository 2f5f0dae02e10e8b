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

# Warnings are looked at in the data; on their own they would go to the terminal and into a file.
mujoco.set_mju_user_warning(lambda message: None)

models = {}


def start(request):
    xml = request["model"]["xml"]
    if xml not in models:
        model = mujoco.MjModel.from_xml_string(xml)
        # The second is for what is asked about a state, so that asking changes nothing.
        models[xml] = (model, mujoco.MjData(model), mujoco.MjData(model))
    model, data, scratch = models[xml]
    model.opt.integrator = INTEGRATORS[request["integrator"]]
    model.opt.timestep = request["step_s"]
    mujoco.mj_resetData(model, data)
    data.qpos[:] = request["model"]["qpos"]
    data.qvel[:] = request["model"]["qvel"]
    mujoco.mj_forward(model, data)
    return model, data, scratch


def is_sound(data):
    # MuJoCo begins anew where a motion has diverged, and says so in its warnings.
    return bool(np.isfinite(data.qpos).all()) and not any(w.number for w in data.warning)


def energy(model, data, scratch):
    scratch.qpos[:], scratch.qvel[:] = data.qpos, data.qvel
    mujoco.mj_fwdPosition(model, scratch)
    mujoco.mj_energyPos(model, scratch)
    mujoco.mj_energyVel(model, scratch)
    return float(scratch.energy[0] + scratch.energy[1])


def states(model, data, scratch):
    scratch.qpos[:] = data.qpos
    mujoco.mj_kinematics(model, scratch)
    bodies = [scratch.body(f"b{k}") for k in range(model.nbody - 1)]
    return [[*map(float, body.xpos), *map(float, body.xquat)] for body in bodies]


def play(request):
    model, data, scratch = start(request)
    steps = request["samples"] * request["divisions"]
    every = -(-steps // ENERGIES)
    places, energies = [], [[0.0, energy(model, data, scratch)]]
    for step in range(1, steps + 1):
        mujoco.mj_step(model, data)
        is_place = step % request["divisions"] == 0
        if (is_place or step % every == 0) and not is_sound(data):
            return {"places": places, "energies": energies, "failed_at_s": step * request["step_s"]}
        if step % every == 0:
            energies.append([step * request["step_s"], energy(model, data, scratch)])
        if is_place:
            places.append(states(model, data, scratch))
    return {"places": places, "energies": energies, "failed_at_s": None}


def timed(request):
    model, data, _ = start(request)
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

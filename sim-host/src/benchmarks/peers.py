"""Plays a scene in MuJoCo: a scene's bodies and steps on stdin, states on stdout, both JSON.

What MuJoCo has no equal for is refused: rolling without slip. Loops are its soft equality constraints."""
import json
import sys
import time

import mujoco
import numpy as np


def text(values):
    return " ".join(repr(float(value)) for value in values)


def turned(q, v):
    out = np.zeros(3)
    mujoco.mju_rotVecQuat(out, np.asarray(v, float), np.asarray(q, float))
    return out


def back(q, v):
    return turned([q[0], -q[1], -q[2], -q[3]], v)


def product(a, b):
    out = np.zeros(4)
    mujoco.mju_mulQuat(out, np.asarray(a, float), np.asarray(b, float))
    return out


def model(scene, step):
    bodies = scene["bodies"]
    index = {body["name"]: k for k, body in enumerate(bodies)}
    children = {k: [] for k in range(-1, len(bodies))}
    for k, body in enumerate(bodies):
        children[index.get(body.get("inboard"), -1)].append(k)
    sites = {k: [] for k in range(-1, len(bodies))}
    tendons, equalities = "", ""
    for n, spring in enumerate(scene.get("springs", [])):
        ends = [index[name] for name in spring["between"]] + [-1]
        for end, point in zip(ends, spring["points_m"]):
            sites[end].append((f"s{n}_{len(sites[end])}_{end}", point))
        names = [sites[end][-1][0] for end in ends[:2]]
        tendons += (
            f'<spatial stiffness="{spring["stiffness_n_m"]}" damping="{spring["damping_n_s_m"]}" '
            f'springlength="{spring["rest_m"]}">' + "".join(f'<site site="{s}"/>' for s in names) + "</spatial>"
        )
    for loop in scene.get("loops", []):
        (kind, joint), = loop["joint"].items()
        points = [np.array(joint["point_m"])]
        if kind == "revolute":
            points.append(points[0] + np.array(joint["axis"]) / np.linalg.norm(joint["axis"]))
        elif kind != "spherical":
            raise SystemExit(f"no {kind} joint that closes a loop")
        first = bodies[index[loop["between"][0]]]
        second = f'body2="b{index[loop["between"][1]]}"' if len(loop["between"]) > 1 else ""
        for point in points:
            anchor = back(first["orientation"], point - np.array(first["center_m"]))
            equalities += f'<connect body1="b{index[first["name"]]}" {second} anchor="{text(anchor)}" solref="{2 * step} 1"/>'

    def written(k, parent):
        body = bodies[k]
        q, center = np.array(body["orientation"]), np.array(body["center_m"])
        q /= np.linalg.norm(q)
        at = lambda v: text(back(q, np.asarray(v, float)))
        (kind, joint), = body["joint"].items()
        point = at(np.array(joint.get("point_m", center)) - center)
        if kind == "floating":
            joints = "<freejoint/>"
        elif kind == "revolute":
            joints = f'<joint type="hinge" pos="{point}" axis="{at(joint["axis"])}"/>'
        elif kind == "prismatic":
            joints = f'<joint type="slide" axis="{at(joint["axis"])}"/>'
        elif kind == "universal":
            joints = "".join(f'<joint type="hinge" pos="{point}" axis="{at(a)}"/>' for a in joint["axes"])
        elif kind == "spherical":
            joints = f'<joint type="ball" pos="{point}"/>'
        else:
            joints = ""
        p_center, p_q = (np.zeros(3), np.array([1.0, 0, 0, 0]))
        if parent >= 0:
            p_center, p_q = np.array(bodies[parent]["center_m"]), np.array(bodies[parent]["orientation"])
        here = back(p_q, center - p_center)
        turn = product([p_q[0], -p_q[1], -p_q[2], -p_q[3]], q)
        inertia = list(body["inertia_kg_m2"]) + list(body.get("products_kg_m2", [0, 0, 0]))
        own = "".join(f'<site name="{s}" pos="{text(back(q, np.array(p) - center))}"/>' for s, p in sites[k])
        return (
            f'<body name="b{k}" pos="{text(here)}" quat="{text(turn)}">'
            f'<inertial pos="0 0 0" mass="{body["mass_kg"]!r}" fullinertia="{text(inertia)}"/>'
            + joints + own + "".join(written(c, k) for c in children[k]) + "</body>"
        )

    world = "".join(f'<site name="{s}" pos="{text(p)}"/>' for s, p in sites[-1])
    world += "".join(written(k, -1) for k in children[-1])
    xml = (
        f'<mujoco><compiler balanceinertia="true" boundmass="0" autolimits="true"/>'
        f'<option timestep="{step!r}" integrator="RK4" gravity="0 0 {-scene["gravity_m_s2"]!r}" tolerance="1e-15" '
        f'iterations="100"><flag energy="enable" contact="disable"/></option>'
        f"<worldbody>{world}</worldbody><tendon>{tendons}</tendon><equality>{equalities}</equality></mujoco>"
    )
    return mujoco.MjModel.from_xml_string(xml)


def start(m, d, scene):
    for k, body in enumerate(scene["bodies"]):
        (kind, joint), = body["joint"].items()
        first = m.body_dofadr[m.body(f"b{k}").id]
        q = np.array(body["orientation"])
        if kind == "revolute":
            d.qvel[first] = joint["rate_rad_s"]
        elif kind == "prismatic":
            d.qvel[first] = joint["rate_m_s"]
        elif kind == "universal":
            d.qvel[first:first + 2] = joint["rates_rad_s"]
        elif kind == "spherical":
            d.qvel[first:first + 3] = back(q, joint["angular_velocity_rad_s"])
        elif kind == "floating":
            d.qvel[first:first + 3] = joint["velocity_m_s"]
            d.qvel[first + 3:first + 6] = back(q, joint["angular_velocity_rad_s"])
        if body.get("torque"):
            d.qfrc_applied[first] = body["torque"]


def trace(m, d, count):
    # Of the state as it is: a step leaves poses of the one before.
    mujoco.mj_forward(m, d)
    configuration, velocity = [], []
    for k in range(count):
        b = m.body(f"b{k}").id
        both = np.zeros(6)
        mujoco.mj_objectVelocity(m, d, mujoco.mjtObj.mjOBJ_BODY, b, both, 0)
        q = d.xquat[b]
        configuration += [*d.xpos[b], *q]
        velocity += [*both[3:], *(0.5 * product([0.0, *both[:3]], q))]
    return {
        "time_s": d.time,
        "configuration": [float(x) for x in configuration],
        "velocity": [float(x) for x in velocity],
        "energy": float(d.energy[0] + d.energy[1]),
    }


def main():
    asked = json.load(sys.stdin)
    scene, step, kept = asked["scene"], asked["step_s"], asked["steps"]
    if scene.get("rolling"):
        raise SystemExit("MuJoCo has no rolling without slip")
    m = model(scene, step)
    d = mujoco.MjData(m)
    start(m, d, scene)
    traces, wall = [], 0.0
    made = 0
    for step_number in kept:
        begun = time.perf_counter()
        while made < step_number:
            mujoco.mj_step(m, d)
            made += 1
        wall += time.perf_counter() - begun
        traces.append(trace(m, d, len(scene["bodies"])))
    json.dump({"version": mujoco.__version__, "wall_s": wall, "traces": traces}, sys.stdout)


main()

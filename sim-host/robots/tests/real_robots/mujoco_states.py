"""Random states of MJCF models, with what MuJoCo gives for them, in the layout of `surefoot dynamics`.

    python mujoco_states.py FOLDER MODEL.xml…

writes FOLDER/NAME.json for each model: mass matrix with armature, M a + bias, M⁻¹ (tau − bias), and poses of
bodies that carry none. Joints and bodies without a name get the one that surefoot gives them.
"""

import json
import pathlib
import sys

import mujoco
import numpy as np

STATES = 5
SEED = 20250101


def names(model, kind, count, default):
    found = [mujoco.mj_id2name(model, kind, i) for i in range(count)]
    return [name or default(i) for i, name in enumerate(found)]


def joint_names(model, bodies):
    def default(joint):
        body = model.jnt_bodyid[joint]
        return f"{bodies[body]}_joint_{joint - model.body_jntadr[body]}"

    return names(model, mujoco.mjtObj.mjOBJ_JOINT, model.njnt, default)


def sizes(kind):
    return {0: (7, 6), 1: (4, 3), 2: (1, 1), 3: (1, 1)}[int(kind)]


def state(model, data, random):
    q = random.uniform(-1.0, 1.0, model.nq)
    for joint in range(model.njnt):
        start = model.jnt_qposadr[joint] + (3 if model.jnt_type[joint] == 0 else 0)
        if model.jnt_type[joint] <= 1:
            q[start : start + 4] /= np.linalg.norm(q[start : start + 4])
    v, a, tau = (random.uniform(-1.0, 1.0, model.nv) for _ in range(3))
    data.qpos[:], data.qvel[:] = q, v
    mujoco.mj_forward(model, data)
    mass = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, mass)
    bias = data.qfrc_bias.copy()
    return q, v, a, tau, mass, bias


def evaluate(path):
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    random = np.random.default_rng(SEED)
    bodies = names(model, mujoco.mjtObj.mjOBJ_BODY, model.nbody, lambda i: f"body_{i}")
    joints = []
    for joint, name in enumerate(joint_names(model, bodies)):
        nq, nv = sizes(model.jnt_type[joint])
        starts = {"idx_q": int(model.jnt_qposadr[joint]), "idx_v": int(model.jnt_dofadr[joint])}
        joints.append({"name": name, "nq": nq, "nv": nv, **starts})
    leaves = [i for i in range(1, model.nbody) if i not in model.body_parentid]
    states = []
    for _ in range(STATES):
        q, v, a, tau, mass, bias = state(model, data, random)
        frames = {
            bodies[i]: {"rotation": data.xmat[i].reshape(3, 3).tolist(), "translation": data.xpos[i].tolist()}
            for i in leaves
        }
        states.append(
            {
                "q": q.tolist(),
                "v": v.tolist(),
                "a": a.tolist(),
                "tau": tau.tolist(),
                "leaf_frames": frames,
                "rnea": (mass @ a + bias).tolist(),
                "crba": mass.tolist(),
                "aba": np.linalg.solve(mass, tau - bias).tolist(),
                "condition_of_mass_matrix": float(np.linalg.cond(mass)),
            }
        )
    armature = int((model.dof_armature > 0).sum())
    return {"joints": joints, "armature": armature, "nv": model.nv, "states": states}


def main(folder, paths):
    out = pathlib.Path(folder)
    out.mkdir(parents=True, exist_ok=True)
    for path in map(pathlib.Path, paths):
        name = "-".join(path.with_suffix("").parts[-3:])
        (out / f"{name}.json").write_text(json.dumps(evaluate(path)))
        print(name)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])

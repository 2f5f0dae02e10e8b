"""Makes rotor_vectors.json: the arm of core's `model/robots/arm.rs` with rotor inertias (armature), in MuJoCo.

    pip install mujoco==4.0.0 numpy
    python rotor_vectors.py > rotor_vectors.json

Axes at home are the world's, as in the arm's description: each body's frame is at its joint's point.
"""
import json

import mujoco
import numpy as np

# Joint: kind, axis, point; body: mass, tensor xx yy zz yz zx xy or principal moments, centre, quaternion.
LINKS = [
    ("hinge", (0, 0, 1), (0, 0, 0.10), 4.0, (0.03, 0.03, 0.02), (0, 0, 0.20), None),
    ("hinge", (0, 1, 0), (0, 0, 0.30), 3.5, (0.06, 0.06, 0.01), (0, 0.03, 0.50), None),
    ("hinge", (0, 1, 0), (0, 0, 0.70), 2.5, (0.02, 0.03, 0.02), (0.15, 0, 0.70), None),
    ("hinge", (1, 0, 0), (0.30, 0, 0.70), 1.5, (0.003, 0.008, 0.008), (0.38, 0, 0.71), None),
    ("hinge", (0, 1, 1), (0.45, 0, 0.70), 1.0, (0.002, 0.003, 0.003, 0.0004, 0.0002, -0.0003), (0.48, 0.01, 0.70), None),
    ("hinge", (1, 0, 0), (0.50, 0, 0.70), 0.6, (0.0006, 0.0009, 0.0009), (0.55, 0, 0.70), (0.8, 0, 0.6, 0)),
    ("slide", (1, 0, 0), (0.60, 0.02, 0.70), 0.2, (0.0001, 0.0001, 0.0001), (0.60, 0.02, 0.70), None),
]
# kg m², and kg for the slide.
ROTORS = [0.4, 0.3, 0.2, 0.05, 0.02, 0.01, 0.7]


def text(numbers):
    return " ".join(repr(float(x)) for x in numbers)


def model():
    xml, at = "", np.zeros(3)
    for (kind, axis, point, mass, inertia, center, quaternion), rotor in zip(LINKS, ROTORS):
        point, center = np.array(point, float), np.array(center, float)
        if len(inertia) == 6:
            xx, yy, zz, yz, zx, xy = inertia
            tensor = f'fullinertia="{text((xx, yy, zz, xy, zx, yz))}"'
        else:
            tensor = f'diaginertia="{text(inertia)}"' + (f' quat="{text(quaternion)}"' if quaternion else "")
        xml += (
            f'<body pos="{text(point - at)}"><joint type="{kind}" axis="{text(axis)}" armature="{rotor}"/>'
            f'<inertial pos="{text(center - point)}" mass="{mass}" {tensor}/>'
        )
        at = point
    xml += "</body>" * len(LINKS)
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option gravity="0 0 -9.81"><flag contact="disable"/></option>'
        f"<worldbody>{xml}</worldbody></mujoco>"
    )


def main():
    arm = model()
    data = mujoco.MjData(arm)
    rng = np.random.default_rng(1)
    states = []
    for _ in range(8):
        data.qpos, data.qvel, data.qfrc_applied = (rng.uniform(-1, 1, 7) * s for s in (1.5, 2.0, 5.0))
        mujoco.mj_forward(arm, data)
        mass = np.zeros((7, 7))
        for column, unit in zip(mass, np.eye(7)):
            mujoco.mj_mulM(arm, data, column, unit)
        states.append(
            {
                "q": data.qpos.tolist(),
                "v": data.qvel.tolist(),
                "tau": data.qfrc_applied.tolist(),
                "mass_matrix": mass.tolist(),
                "bias": data.qfrc_bias.tolist(),
                "acceleration": data.qacc.tolist(),
            }
        )
    print(json.dumps({"made_with": f"MuJoCo {mujoco.__version__}", "rotors": ROTORS, "states": states}))


main()

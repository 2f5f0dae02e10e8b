"""The controller behind its C interface, closed with MuJoCo as plant: `mujoco_loop.py LIBRARY MODEL.json`.

Prints one JSON document: the largest push of each direction that is survived with all below it. The contact is MuJoCo's
own: elliptic cones, stiff points, no friction or damping in joints, true state, torques held between ticks.
"""

import ctypes
import json
import sys

import mujoco
import numpy as np

STEP = 0.0005  # s
SOLREF = (0.004, 1.0)
SOLIMP = (0.95, 0.99, 0.001, 0.5, 2.0)
IMPRATIO = 10
FAR, TILTED = 0.05, np.radians(5.0)  # of a robot that has survived, at the end


class Controller:
    """The library's structures, sized by its robot."""

    def __init__(self, path, model, as_built=False):
        """With the model's settings within limits, or as the library was built: the robot's file, each millisecond."""
        library = self.library = ctypes.CDLL(path)
        joints = ctypes.c_size_t.in_dll(library, "surefoot_joints").value
        legs = ctypes.c_size_t.in_dll(library, "surefoot_legs").value
        size = ctypes.c_size_t.in_dll(library, "surefoot_controller_bytes").value
        three, real = ctypes.c_float * 3, ctypes.c_float

        class Settings(ctypes.Structure):
            _fields_ = [
                ("period", real),
                ("position_gain", three),
                ("velocity_gain", three),
                ("orientation_gain", three),
                ("angular_velocity_gain", three),
                ("is_limited", ctypes.c_bool),
                ("friction", real),
                ("least_force", real),
                ("greatest_force", real),
                ("sole_share", real),
            ]

        class Measurement(ctypes.Structure):
            _fields_ = [
                ("position", three),
                ("orientation", real * 4),
                ("velocity", real * 6),
                ("joint_angles", real * joints),
                ("joint_rates", real * joints),
                ("feet_touch", ctypes.c_bool * legs),
            ]

        class Command(ctypes.Structure):
            _fields_ = [
                ("torques", real * joints),
                ("mode", ctypes.c_int),
                ("stop", ctypes.c_int),
                ("stop_joint", ctypes.c_uint8),
                ("limit", ctypes.c_int),
                ("limit_leg", ctypes.c_uint8),
                ("limit_joint", ctypes.c_uint8),
                ("limit_relief", real),
                ("is_unfinished", ctypes.c_bool),
                ("cut_torques", ctypes.c_uint32),
            ]

        class Memory(ctypes.Structure):
            _fields_ = [("words", ctypes.c_uint64 * ((size + 7) // 8))]

        self.memory, self.measurement, self.command = Memory(), Measurement(), Command()
        settings = Settings()
        self.check(library.surefoot_default_settings(ctypes.byref(settings)))
        if not as_built:
            settings.period = model["period"]
            gains = ("position_gain", "velocity_gain", "orientation_gain", "angular_velocity_gain")
            for name, values in zip(gains, model["gains"]):
                setattr(settings, name, three(*values))
            settings.is_limited = True
            # As the project's own loop counts on the floor.
            settings.friction = 0.8 * model["friction"]
        self.check(library.surefoot_init(ctypes.byref(self.memory), ctypes.byref(settings)))
        if not as_built:
            pose = model["set_point"]
            position, orientation = three(*pose["position"]), (real * 4)(*pose["orientation"])
            self.check(library.surefoot_set_pose(ctypes.byref(self.memory), position, orientation))
        self.check(library.surefoot_arm(ctypes.byref(self.memory)))

    @staticmethod
    def check(status):
        if status != 0:
            raise RuntimeError(f"the library says {status}")

    def tick(self, position, orientation, velocity, angles, rates, touch):
        measured = self.measurement
        measured.position[:] = position
        measured.orientation[:] = orientation
        measured.velocity[:] = velocity
        measured.joint_angles[:] = angles
        measured.joint_rates[:] = rates
        measured.feet_touch[:] = touch
        references = (ctypes.byref(x) for x in (self.memory, measured, self.command))
        self.check(self.library.surefoot_tick(*references))
        return np.array(self.command.torques), self.command.mode


class Plant:
    """The robot in MuJoCo, with the central body's frame in its link's."""

    def __init__(self, model):
        self.model = mujoco.MjModel.from_xml_string(model["xml"])
        m = self.model
        m.opt.timestep, m.opt.impratio = STEP, IMPRATIO
        m.opt.cone, m.opt.integrator = mujoco.mjtCone.mjCONE_ELLIPTIC, mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        m.geom_solref[:], m.geom_solimp[:] = SOLREF, SOLIMP
        self.data = mujoco.MjData(m)
        self.start = np.array(model["qpos"])
        joint = [m.body(f"b{link}").jntadr[0] for link in model["joints"]]
        self.angles = np.array([m.jnt_qposadr[j] for j in joint])
        self.rates = np.array([m.jnt_dofadr[j] for j in joint])
        central = model["central"]
        self.link = m.body(f"b{central['link']}").id
        self.arm, self.turn = np.array(central["position"]), np.array(central["orientation"])
        # The foot of a leg is the last of its joints' bodies that has points.
        with_points = sorted({int(b) for b, t in zip(m.geom_bodyid, m.geom_type) if t == mujoco.mjtGeom.mjGEOM_SPHERE})
        self.feet = with_points

    def reset(self):
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:] = self.start
        mujoco.mj_forward(self.model, self.data)

    def touches(self):
        touching = set()
        for k in range(self.data.ncon):
            contact = self.data.contact[k]
            if contact.efc_address >= 0 and self.data.efc_force[contact.efc_address] > 0.0:
                touching |= {int(self.model.geom_bodyid[g]) for g in contact.geom}
        return [foot in touching for foot in self.feet]

    def state(self):
        d = self.data
        q_link, rotation = d.qpos[3:7], d.xmat[self.link].reshape(3, 3)
        orientation = np.zeros(4)
        mujoco.mju_mulQuat(orientation, q_link, self.turn)
        arm = rotation @ self.arm
        # A free joint's velocities: of its origin in the world, and angular in the body.
        omega = rotation @ d.qvel[3:6]
        velocity = d.qvel[:3] + np.cross(omega, arm)
        to_body = np.zeros(9)
        mujoco.mju_quat2Mat(to_body, orientation)
        to_body = to_body.reshape(3, 3).T
        twist = np.concatenate((to_body @ velocity, to_body @ omega))
        return d.qpos[:3] + arm, orientation, twist, d.qpos[self.angles], d.qvel[self.rates]


def survives(plant, path, model, force):
    controller, push, goal = Controller(path, model), model["push"], model["set_point"]
    plant.reset()
    d, per_tick = plant.data, round(model["period"] / STEP)
    for step in range(round(model["duration"] / STEP)):
        if step % per_tick == 0:
            torques, mode = controller.tick(*plant.state(), plant.touches())
            if mode != 1:
                return False
            d.qfrc_applied[plant.rates] = torques
        time = step * STEP
        is_pushed = push["at"] - 1e-9 <= time < push["at"] + push["lasts"] - 1e-9
        d.xfrc_applied[plant.link, :3] = force if is_pushed else 0.0
        mujoco.mj_step(plant.model, d)
    position, orientation, *_ = plant.state()
    turned = abs(float(np.dot(orientation, goal["orientation"])))
    angle = 2.0 * np.arccos(min(1.0, turned))
    return bool(np.linalg.norm(position - goal["position"]) < FAR and angle < TILTED)


def largest(plant, path, model, degrees):
    push, impulse = model["push"], 0.0
    direction = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), 0.0])
    while impulse + push["step"] <= push["most"]:
        if not survives(plant, path, model, (impulse + push["step"]) / push["lasts"] * direction):
            break
        impulse += push["step"]
    print(f"  MuJoCo, {degrees:.0f}°: {impulse:.0f} N·s", file=sys.stderr, flush=True)
    return impulse


def main(path, file):
    with open(file, encoding="utf-8") as text:
        model = json.load(text)
    plant = Plant(model)
    directions = [row["degrees"] for row in model["ours"]]
    rows = [{"degrees": d, "impulse": largest(plant, path, model, d)} for d in directions]
    print(json.dumps({"version": mujoco.__version__, "rows": rows}))


if __name__ == "__main__":
    main(*sys.argv[1:])

"""Makes motion_vectors.json: the biped's feet press or swing, by a quadratic program in all unknowns at once.

    pip install mujoco==4.0.0 numpy daqp
    python motion_vectors.py > motion_vectors.json

MuJoCo gives mass matrix, bias, the soles' Jacobians and the momentum; unknowns are all accelerations, torques
and wrenches, and the equations of motion are constraints, of which numpy finds the null space. Nothing is
eliminated by hand, as core does. Where rows bind they are hard, by DAQP.
"""
import json

import daqp
import mujoco
import numpy as np

G = 9.81
SMALL = (0.343, (0.00028,) * 3)
# Of the left leg at home, in the world: axis, joint's point; mass, moments, centre (core's model/robots/biped.rs).
LEG = [
    ((1, 0, 0), (0, -0.15, 0.96), *SMALL, (0, -0.15, 0.96)),
    ((0, 1, 0), (0, -0.15, 0.96), *SMALL, (0, -0.15, 0.96)),
    ((0, 0, 1), (0, -0.15, 0.96), 7.5, (0.163, 0.171, 0.0198), (0, -0.15, 0.73)),
    ((0, 1, 0), (0, -0.15, 0.50), 4.79, (0.0961, 0.0959, 0.00784), (0, -0.15, 0.28)),
    ((1, 0, 0), (0, -0.15, 0.06), *SMALL, (0, -0.15, 0.06)),
    ((0, 1, 0), (0, -0.15, 0.06), 1.455, (0.00189, 0.00608, 0.00662), (-0.05325, -0.15, 0.03473)),
]
TILT = np.radians(-8.547)
FOOT_QUATERNION = (np.cos(TILT / 2), 0, np.sin(TILT / 2), 0)
CENTRAL = np.array([0, 0, 1.23])
# From the ankle to the middle of the sole, and half its sides.
SOLE = np.array([-0.076, 0, -0.06])
HALF = np.array([0.12, 0.045])
MU = 0.4  # of the pyramid's sides
LEAST = 5.0
LINEAR, ANGULAR, SWING, REST, PER_LENGTH = 1.0, 0.01, (0.05, 0.005), 20.0, 11.9
FORCE, MOMENT = 1e-6, 1e-4  # costs of N² and (N m)²


def text(numbers):
    return " ".join(repr(float(x)) for x in numbers)


def leg(side):
    xml, at = "", CENTRAL
    for k, (axis, point, mass, moments, center) in enumerate(LEG):
        point, center = (np.array(p) * (1, side, 1) for p in (point, center))
        tilted = f' quat="{text(FOOT_QUATERNION)}"' if k == 5 else ""
        xml += (
            f'<body name="{side}_{k}" pos="{text(point - at)}"><joint type="hinge" axis="{text(axis)}"/>'
            f'<inertial pos="{text(center - point)}" mass="{mass}" diaginertia="{text(moments)}"{tilted}/>'
        )
        at = point
    return xml + "</body>" * len(LEG)


def biped():
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option gravity="0 0 -{G}"><flag contact="disable"/></option><worldbody>'
        f'<body name="central" pos="{text(CENTRAL)}"><freejoint/>'
        f'<inertial pos="0 0 0" mass="45" diaginertia="1.67 1.58 0.581"/>{leg(1)}{leg(-1)}</body></worldbody></mujoco>'
    )


def rows_of_sole():
    """Wrenches (sole axes, about its middle) that forces at its corners can make: C w <= c."""
    (x, y), rows = HALF, []
    for s in (1, -1):
        rows += [[s, 0, -MU, 0, 0, 0], [0, s, -MU, 0, 0, 0], [0, 0, -y, s, 0, 0], [0, 0, -x, 0, s, 0]]
        for t in (1, -1):
            rows.append([s * y, t * x, -MU * (x + y), -s * MU, -t * MU, -1])
            rows.append([s * y, t * x, -MU * (x + y), s * MU, t * MU, 1])
    rows.append([0, 0, -1, 0, 0, 0])
    return np.array(rows, float), np.array([0.0] * 16 + [-LEAST])


class Robot:
    def __init__(self):
        self.m = biped()
        self.d = mujoco.MjData(self.m)
        self.feet = [self.m.body(f"{side}_5").id for side in (1, -1)]
        self.mass = self.m.body_mass.sum()

    def update(self, q, v):
        m, d = self.m, self.d
        d.qpos[:], d.qvel[:] = q, v
        mujoco.mj_forward(m, d)
        mujoco.mj_subtreeVel(m, d)
        self.M = np.zeros((18, 18))
        mujoco.mj_fullM(m, self.M, d.qM) if mujoco.__version__ < "4" else mujoco.mj_fullM(m, d, self.M)
        self.R = d.xmat[1].reshape(3, 3).copy()
        self.c, self.momentum = d.subtree_com[1].copy(), d.subtree_angmom[1].copy()
        self.Jc, self.J, self.bias, self.points, self.axes = np.zeros((3, 18)), [], [], [], []
        mujoco.mj_jacSubtreeCom(m, d, self.Jc, 1)
        for body in self.feet:
            axes = d.xmat[body].reshape(3, 3).copy()
            point, J, Jd = d.xpos[body] + axes @ SOLE, np.zeros((6, 18)), np.zeros((6, 18))
            mujoco.mj_jac(m, d, J[:3], J[3:], point, body)
            mujoco.mj_jacDot(m, d, Jd[:3], Jd[3:], point, body)
            self.J.append(J), self.bias.append(Jd @ v), self.points.append(point), self.axes.append(axes)

    def solve(self, pressing, task, wanted, limit):
        """z = (accelerations 18, torques 12, wrenches 12: world axes, about the points)."""
        d, n = self.d, 42
        A, b = [np.hstack([self.M, -np.eye(18)[:, 6:], -self.J[0].T, -self.J[1].T])], [-d.qfrc_bias]
        rows, goals, weights = [], [], []
        for k in (0, 1):
            foot, wrench = np.zeros((6, n)), np.zeros((6, n))
            foot[:, :18], wrench[:, 30 + 6 * k : 36 + 6 * k] = self.J[k], np.eye(6)
            if pressing[k]:
                A.append(foot), b.append(-REST * (self.J[k] @ d.qvel) - self.bias[k])
                rows.append(wrench), goals.append(np.zeros(6)), weights.append([FORCE] * 3 + [MOMENT] * 3)
            else:
                A.append(wrench), b.append(np.zeros(6))
                rows.append(foot), goals.append(wanted[k] - self.bias[k])
                weights.append([SWING[0]] * 3 + [SWING[1]] * 3)
        turn = np.zeros((3, n))
        turn[:, 3:6] = self.R
        rows.append(turn), goals.append(task["angular"]), weights.append([ANGULAR] * 3)
        if any(pressing):
            move, goal = np.zeros((3, n)), np.array(task["linear"], float) + [0, 0, G]
            for k in (0, 1):
                move[:, 30 + 6 * k : 33 + 6 * k] = np.eye(3) / self.mass
            if task["kind"] == "pressure":
                move[:2], goal[:2] = 0, 0
                for k in (0, 1):
                    if not pressing[k]:
                        continue
                    x, y = self.points[k][:2] - task["linear"][:2]
                    scale, at = PER_LENGTH / (self.mass * G), 30 + 6 * k
                    move[0, at : at + 6] = scale * np.array([0, 0, -x, 0, 1, 0])
                    move[1, at : at + 6] = scale * np.array([0, 0, -y, -1, 0, 0])
            rows.append(move), goals.append(goal), weights.append([LINEAR] * 3)
        A, b = np.vstack(A), np.concatenate(b)
        T, t, W = np.vstack(rows), np.concatenate(goals), np.concatenate(weights)
        start = np.linalg.lstsq(A, b, rcond=None)[0]
        null = np.linalg.svd(A)[2][np.linalg.matrix_rank(A) :].T
        H = null.T @ T.T @ (W[:, None] * (T @ null))
        f = null.T @ T.T @ (W * (T @ start - t))
        x, bound = np.linalg.solve(H, -f), 0
        if limit is not None:
            C, c = [np.eye(n)[18:30], -np.eye(n)[18:30]], [limit, limit]
            sole, most = rows_of_sole()
            for k in (0, 1):
                if pressing[k]:
                    row = np.zeros((len(most), n))
                    row[:, 30 + 6 * k : 33 + 6 * k] = sole[:, :3] @ self.axes[k].T
                    row[:, 33 + 6 * k : 36 + 6 * k] = sole[:, 3:] @ self.axes[k].T
                    C.append(row), c.append(most)
            C, c = np.vstack(C), np.concatenate(c)
            upper, none = c - C @ start, np.full(len(c), -1e30)
            x, _, flag, info = daqp.solve(H, f, np.ascontiguousarray(C @ null), upper, none, np.zeros(len(c), np.int32))
            if flag != 1:
                return None, 0
            bound = int((np.abs(info["lam"]) > 1e-9).sum())
        return start + null @ x, bound


def main():
    robot, rng, cases = Robot(), np.random.default_rng(5), []
    while len(cases) < 32:
        k = len(cases)
        q, v = np.zeros(19), 0.3 * rng.normal(size=18)
        q[:3], q[3] = 0.5 * rng.normal(size=3), 1
        q[4:7] = 0.07 * rng.normal(size=3)
        q[3:7] /= np.linalg.norm(q[3:7])
        q[7:] = np.tile([0, 0.698, 0, -1.352, 0, 0.654], 2) + 0.12 * rng.normal(size=12)
        robot.update(q, v)
        pressing = [[True, True], [True, False], [False, True], [False, False]][k % 4]
        task = {"kind": "mass" if k // 4 % 2 else "pressure", "linear": 0.5 * rng.normal(size=3), "angular": rng.normal(size=3)}
        if task["kind"] == "pressure":
            feet = [p[:2] for p, presses in zip(robot.points, pressing) if presses]
            task["linear"][:2] = np.mean(feet or [robot.c[:2]], 0) + 0.02 * rng.normal(size=2)
        wanted = [np.concatenate((3 * rng.normal(size=3), 5 * rng.normal(size=3))) for _ in (0, 1)]
        z, bound = robot.solve(pressing, task, wanted, None)
        limit = None
        if k >= 16:
            # A tenth less than the largest torque, and soles that are not asked to pull.
            limit = np.full(12, 1e4)
            most = np.argmax(np.abs(z[18:30]))
            limit[most] = 0.9 * abs(z[18 + most])
            task["angular"] *= 4
            z, bound = robot.solve(pressing, task, wanted, limit)
            if z is None or bound == 0:
                continue
        elif any(presses and z[32 + 6 * i] < 0 for i, presses in enumerate(pressing)):
            continue
        cases.append(
            {
                "position": q[:3], "quaternion": q[3:7], "angles": q[7:], "velocity": v[:3], "body_rate": v[3:6], "rates": v[6:],
                "pressing": pressing, "task": task["kind"], "linear": task["linear"], "angular": task["angular"], "feet": wanted,
                "limit": limit, "bound": bound,
                "center": robot.c, "center_velocity": robot.Jc @ v, "momentum": robot.momentum,
                "points": robot.points, "point_velocities": [J @ v for J in robot.J],
                "accelerations": z[6:18], "central_angular": robot.R @ z[3:6], "torques": z[18:30], "wrenches": [z[30:36], z[36:42]],
            }
        )  # fmt: skip
    plain = lambda x: [plain(y) for y in x] if isinstance(x, (list, np.ndarray)) else x if isinstance(x, (str, bool, int)) or x is None else float(f"{x:.13g}")
    lines = (json.dumps({key: plain(x) for key, x in case.items()}) for case in cases)
    print("[" + ",\n".join(lines) + "]")


main()

"""Makes estimate_vectors.json: an independent error-state Kalman filter (numpy, dense covariance, one scalar row after
the other, orientation as matrices) over 10 s of a motion in closed form, which `tests/suite/estimate/motion.rs` makes
again number by number.

    pip install mujoco==4.0.0 numpy daqp
    python estimate_vectors.py ORACLE > estimate_vectors.json

`ORACLE` is the folder of the reference's `est.py` (estimation.md, section b). One equation of it is put right here: where
a foot touches down after another one has been measured in the same tick, errors found so far belong to the new foot too
(`born`). What that changes is in the file as `unmodified`.
"""
import json
import os
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
sys.path.insert(0, os.path.join(sys.argv[1], "../walking"))
from est import Eskf, G9, R2quat, log3, sk, so3  # noqa: E402

H, TICKS = 0.002, 5000
BIAS_F, BIAS_W = np.array([0.1, -0.1, 0.1]), np.array([0.01, -0.01, 0.01])
TAU = 2 * np.pi
X, Y, Z = np.eye(3)


def noise(k, channel):
    """Three numbers between -1 and 1 that look random: the sine of a square."""
    return np.array([np.sin((0.37 + 0.11 * channel + 0.017 * axis) * float(k) * float(k)) for axis in range(3)])


def wave(t, amplitude, frequency):
    """At rest at t = 0, and its rate."""
    w = TAU * frequency
    return amplitude * (1 - np.cos(w * t)), amplitude * w * np.sin(w * t)


def place(t):
    x, y, z = wave(t, 0.08, 0.1), wave(t, 0.02, 0.9), wave(t, -0.01, 1.7)
    return np.array([x[0], y[0], 0.9 + z[0]]), np.array([x[1], y[1], z[1]])


def turned(t):
    yaw, pitch, roll = wave(t, 0.1, 0.23)[0], wave(t, 0.03, 1.1)[0], wave(t, -0.04, 0.8)[0]
    return so3(yaw * Z) @ so3(pitch * Y) @ so3(roll * X)


def stance(k, foot):
    """Which stance a foot is in at a tick (from 0), and whether it stands: both for 1 s, then in steps of 0.5 s, of which
    a foot swings for 0.4 s."""
    if k < 500:
        return 0, True
    step, tick = divmod(k - 500, 250)
    swings = step % 2 == foot
    steps_made = (step + 2 - foot) // 2 if tick >= 200 or not swings else (step - foot) // 2
    return steps_made, not (swings and tick < 200)


def stood(number, foot):
    side = 0.1 if foot == 0 else -0.1
    p = np.array([0.02 * number, side + 0.003 * number, 0.001 * number])
    return p, so3(0.02 * number * Z) @ so3((0.01 + 0.002 * number) * Y + 0.005 * X)


def reading(k):
    t = k * H
    r, v = place(t)
    R = turned(t)
    r0, v0 = place(t - H)
    gyro = log3(turned(t - H).T @ R) / H + BIAS_W + 2e-3 * noise(k, 0)
    acc = turned(t - 0.5 * H).T @ ((v - v0) / H + G9 * Z) + BIAS_F + 0.02 * noise(k, 1)
    if k == 0:
        gyro, acc = BIAS_W + 0 * Z, R.T @ (G9 * Z) + BIAS_F
    legs, contact = [], []
    for foot in (0, 1):
        number, stands = stance(k, foot)
        p, phi = stood(number, foot)
        s = R.T @ (p - r) + 2e-4 * noise(k, 2 + foot)
        legs.append((s, R.T @ phi @ so3(1e-3 * noise(k, 4 + foot)), None))
        contact.append(stands)
    return dict(gyro=gyro, acc=acc, th=np.array([k]), thd=np.zeros(12)), legs, np.array(contact), R


class Filter(Eskf):
    """The oracle's, with that equation put right unless `modified` is false."""

    modified = True

    def born(s, i, p, Rf):
        super().born(i, p, Rf)
        if s.modified and hasattr(s, "dx"):
            s.dx[15 + 3 * i : 18 + 3 * i] = s.dx[0:3] - s.R @ sk(p) @ s.dx[6:9]
            if s.flat:
                s.dx[21 + 3 * i : 24 + 3 * i] = s.R @ s.dx[6:9]


def run(every, alt=False, modified=True, forces=False, **options):
    e = Filter(H, np.float64, **options)
    e.legs, e.alt, e.modified = (lambda th: reading(int(th[0]))[1]), alt, modified
    states, smooth = [], None
    for k in range(TICKS):
        z, _, contact, R = reading(k)
        smooth = z["acc"] if smooth is None else smooth
        if forces and contact.all() and k < 500:
            smooth = smooth + 25.0 * H * (z["acc"] - smooth)
            F = 700.0 * R.T @ (Z + np.array([2e-3, -1e-3, 0.0]))
            e.weight = (smooth - np.linalg.norm(smooth) * F / np.linalg.norm(F))[:2]
        else:
            smooth = z["acc"]
        q, v = e.step(z, contact)
        if (k + 1) % every == 0:
            body = e.R.T @ v[:3]
            states.append([k + 1, *q[:7], *body, *v[3:6], *e.bf, *e.bw, *np.sqrt(np.diag(e.P)[:15])])
    return np.array(states)


def main():
    cases = dict(
        soles=run(250),
        points=run(500, flat=False),
        in_turn=run(500, alt=True),
        level=run(500, level=1.0, floor=True),
        forces=run(500, forces=True),
    )
    plain = run(250, modified=False)
    print(json.dumps(dict(
        unmodified=float(abs(plain - cases["soles"])[:, 1:4].max()),
        **{name: [[float(f"{x:.10g}") for x in row] for row in rows] for name, rows in cases.items()},
    )).replace("], [", "],\n["))


main()

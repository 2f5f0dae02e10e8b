"""Makes walk_vectors.json: steps and tasks of a walking planner in Python, an independent program of the same
equations (its folder holds planner.py and, for robots, wbc.py), which is imported with a stub for dynamics.

    pip install numpy mujoco daqp
    python walk_vectors.py FOLDER > walk_vectors.json

`steps`: single choices of a step. `walk`: a walk of a point mass that falls as an inverted pendulum from the wanted
centre of pressure, its feet where they are asked to be, seen by the planner tick by tick: start, walk, turn, a push,
stop.
"""
import json
import sys

import numpy as np

sys.path.insert(0, sys.argv[1])
sys.dont_write_bytecode = True
import planner as oracle  # noqa: E402

G = 9.81


class Stub:
    """What the planner reads of a robot: two soles, or four points in diagonal pairs."""

    def __init__(self, points):
        self.mass, self.nv = 40.0, 18
        if points:
            self.c_dim, self.groups, self.X, self.Y = 3, ((0, 3), (1, 2)), 0.0, 0.0
            self.z, self.h0, self.Ls, self.width = 0.31, 0.32, 0.43, 0.0
            at = [(0.2, 0.12), (0.2, -0.12), (-0.2, 0.12), (-0.2, -0.12)]
        else:
            self.c_dim, self.groups, self.X, self.Y = 6, ((0,), (1,)), 0.1, 0.045
            self.z, self.h0, self.Ls, self.width = 0.7, 0.66, 0.72, 0.2
            at = [(0.0, 0.1), (0.0, -0.1)]
        self.n = len(at)
        self.pf = [np.array([x, y, 0.0]) for x, y in at]
        self.vf = [np.zeros(6) for _ in at]
        self.off = [np.zeros(2)] * self.n
        for group in self.groups:
            mean = np.mean([self.pf[i][:2] for i in group], 0)
            for i in group:
                self.off[i] = self.pf[i][:2] - mean
        self.yaw, self.yawf = 0.0, [0.0] * self.n
        self.c, self.cd, self.Lc, self.w = np.array([0, 0, self.z]), np.zeros(3), np.zeros(3), np.zeros(3)
        self.turn()

    def turn(self):
        def about_z(a):
            return np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])

        self.R1, self.Rf = about_z(self.yaw), [about_z(a) for a in self.yawf]

    def update(self, q, v):
        return self

    def hipankle(self, i):
        hip = self.c + np.array([*(self.off[i] if self.c_dim == 3 else (0, 0.1 * (1 - 2 * i))), self.h0 - self.z])
        return hip - self.pf[i]


class Keep:
    """In the place of the quadratic program: keeps what it is asked for."""

    def solve(self, af, stance, acc, ang, lin, cap, gain):
        self.asked = dict(af=af, stance=stance, acc=acc, ang=ang, lin=lin, cap=cap or {})


class Walker(oracle.Walker):
    """Where a foot lifts out of double support, its first step is in its reach like all others."""

    def choose(self, xi, side, v, te, sw):
        if sw is None and self.mode == 'ss':
            sw = self.H.T @ (np.mean([self.ref[j][0][:2] for j in self.ref], 0) - self.at(side)[:2])
        return super().choose(xi, side, v, te, sw)


def rounded(x, digits=5):
    return np.round(np.array(x, float), digits).tolist()


def steps(random):
    rows = []
    for points in (False, True):
        d = Stub(points)
        g = oracle.Gait(d)
        s = oracle.Walker(d, None, g)
        for k in range(40):
            side = 1 if k % 2 else -1
            v = random.uniform(-0.3, 0.8, 2) * np.sqrt(G * d.z) * np.array([1, 0.3])
            te = random.uniform(0, 1.2) * g.Ts
            b0 = s.nominal(side, v)[2]
            # near the periodic gait, and pushed off it
            a_nominal = s.nominal(side, v)[1] * np.exp(-s.om * max(g.Ts - te, 0.1 / s.om))
            xi = a_nominal + random.normal(size=2) * d.z * (0.002 if k % 4 == 0 else 0.12)
            sw = random.uniform(-0.3, 0.3, 2) * d.z + np.array([0, -side * g.width])
            xi, v, te, sw = (np.array(rounded(x)) for x in (xi, v, te, sw))
            left, u, miss = s.choose(xi, side, v, float(te), sw)
            u0, a0, b0, kap, ed = s.nominal(side, v)
            rows.append(dict(points=points, side=side, offset=xi.tolist(), velocity=v.tolist(), elapsed=float(te),
                             swinging=sw.tolist(), left=left, step=list(u), miss=list(miss),
                             nominal=[*u0, *a0, *b0, kap, ed]))
    return rows


def walk(points, seconds, dt, command, push):
    d, keep = Stub(points), Keep()
    g = oracle.Gait(d)
    s = Walker(d, keep, g, command)
    s.dt = dt
    ticks = []
    height = d.z
    for k in range(round(seconds / dt)):
        t = k * dt
        # What the planner sees is what is written down.
        d.c, d.cd, d.Lc, d.w = (np.array(rounded(x)) for x in (d.c, d.cd, d.Lc, d.w))
        d.pf = [np.array(rounded(x)) for x in d.pf]
        d.vf = [np.array(rounded(x)) for x in d.vf]
        d.yaw, d.yawf = round(d.yaw, 5), [round(a, 5) for a in d.yawf]
        d.turn()
        fz = np.zeros(d.n)
        for i in range(d.n):
            swings = s.mode == 'ss' and i in s.ref
            fz[i] = 0.0 if swings and d.pf[i][2] > 0 else d.mass * G / d.n
        legs = [rounded(-d.hipankle(i)) for i in range(d.n)]
        hip = d.hipankle
        d.hipankle = lambda i: -np.array(legs[i])
        s.tick(t, None, None, fz)
        d.hipankle = hip
        a = keep.asked
        want = command(t)
        swing = {str(i): rounded(a['af'][i], 7) for i in range(d.n) if i not in a['stance']}
        ticks.append(dict(
            com=[*d.c, *d.cd], momentum=d.Lc.tolist(), yaw=d.yaw, rate=d.w.tolist(), yaw_feet=list(d.yawf),
            feet=[[*d.pf[i], *d.vf[i]] for i in range(d.n)], legs=legs, forces=rounded(fz), command=want,
            mode=s.mode, left=round(s.t_rem, 7) if s.mode == 'ss' else 0, step=rounded(s.u, 7) if s.mode == 'ss' else [0, 0],
            lin=a['lin'], acc=rounded(a['acc'], 7), ang=rounded(a['ang'], 7), swing=swing,
            cap={str(i): round(f, 6) for i, f in a['cap'].items()}))
        # The pendulum about the wanted centre of pressure, kept inside the soles by the planner itself.
        cop = a['acc'][:2] if a['lin'] == 'cop' else d.c[:2] - a['acc'][:2] * height / G
        acc = np.array([*((d.c[:2] - cop) * G / height), a['acc'][2]])
        for at, impulse in push:
            if at <= t < at + 0.1 - 1e-9:
                acc[:2] += np.array(impulse) / (0.1 * d.mass)
        d.c = d.c + d.cd * dt + acc * dt * dt / 2
        d.cd = d.cd + acc * dt
        d.w = np.array([0, 0, s.cmd[2]])
        d.yaw += s.cmd[2] * dt
        d.Lc = np.array([0.2 * np.sin(7 * t), 0.3 * np.cos(5 * t), 0.1])
        for i in range(d.n):
            if i in a['stance']:
                d.vf[i] = np.zeros(6)
                d.pf[i] = np.array([*d.pf[i][:2], 0.0])
            else:
                lin, ang = a['af'][i][:3], a['af'][i][3:]
                d.pf[i] = d.pf[i] + d.vf[i][:3] * dt + lin * dt * dt / 2
                d.yawf[i] += d.vf[i][5] * dt + (ang[2] if len(ang) else 0) * dt * dt / 2
                d.vf[i] = d.vf[i] + np.concatenate((lin, [0, 0, ang[2]])) * dt
                if d.pf[i][2] < 0:
                    d.pf[i][2] = -1e-5
    return dict(points=points, dt=dt, ticks=ticks)


def biped_command(t):
    if t < 0.1 or t > 2.4:
        return None
    return (0.6, 0.0, 0.0) if t < 1.5 else (0.6, 0.1, 0.4)


def pair_command(t):
    return None if t < 0.05 or t > 1.6 else (0.8, 0.0, 0.3)


def main():
    random = np.random.default_rng(7)
    robots = {}
    for points in (False, True):
        d = Stub(points)
        robots['pairs' if points else 'soles'] = dict(
            mass=d.mass, z=d.z, h0=d.h0, leg=d.Ls, width=d.width, X=d.X, Y=d.Y, feet=[p.tolist() for p in d.pf])
    walks = [walk(False, 4.0, 0.016, biped_command, [(1.9, (6.0, -5.0))]),
             walk(False, 1.6, 0.016, lambda t: None, [(0.1, (10.0, 40.0))]),
             walk(True, 2.0, 0.012, pair_command, [(1.0, (8.0, 6.0))])]
    print(json.dumps(dict(robots=robots, steps=steps(random), walks=walks), separators=(',', ':')))


main()

"""The firmware in QEMU, stepped by MuJoCo over the link: `lock_step.py QEMU IMAGE LIBRARY MODEL.json`.

Python's standard library, numpy and MuJoCo are all it needs. Each millisecond of MuJoCo's time one measurement goes to the
firmware, which answers with the torques of one tick; the firmware's time stands still in between. Beside it the host's
library (docs/c.md) computes the same ticks, and every torque must have the same bits. Prints one JSON document.

`Firmware` is all that another simulator needs: copy it. docs/lock-step.md has the recipe.
"""

import json
import os
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np

from mujoco_loop import Controller, Plant, STEP, mujoco

VERSION = 5  # of the messages (link/src/frame.rs)
# Numbers of the messages that are used here, in the order of link/src/message.rs.
ARM, DISARM, SENSORS = 9, 10, 11
IDENTITY, ACKNOWLEDGED, TORQUES = 0, 1, 2
LOCK_STEP_PERIOD = 0.001  # s, of a firmware that nobody has configured
ACTIVE = 1


def varint(number):
    """postcard's unsigned integers: seven bits a byte, the lowest first."""
    out = bytearray()
    while number >= 0x80:
        out.append(number & 0x7F | 0x80)
        number >>= 7
    return bytes(out) + bytes([number])


def cobs(data):
    """Consistent overhead byte stuffing: no zero byte is left."""
    out = bytearray()
    for block in data.split(b"\0"):
        while len(block) >= 254:
            out += b"\xff" + block[:254]
            block = block[254:]
        out += bytes([len(block) + 1]) + block
    return bytes(out)


def uncobs(data):
    out, at = bytearray(), 0
    while at < len(data):
        code = data[at]
        out += data[at + 1 : at + code]
        at += code
        if code < 0xFF and at < len(data):
            out.append(0)
    return bytes(out)


class Reader:
    """A message, from its beginning."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def byte(self):
        self.at += 1
        return self.data[self.at - 1]

    def varint(self):
        number, shift = 0, 0
        while True:
            byte = self.byte()
            number |= (byte & 0x7F) << shift
            if byte < 0x80:
                return number
            shift += 7

    def floats(self, count):
        self.at += 4 * count
        return np.frombuffer(self.data, "<f4", count, self.at - 4 * count)


class Firmware:
    """An image in QEMU, whose link is two pipes in the emulator's folder."""

    def __init__(self, qemu, image):
        self.folder = tempfile.TemporaryDirectory()
        paths = [os.path.join(self.folder.name, name) for name in ("to-target", "to-host")]
        for path in paths:
            os.mkfifo(path)
        machine = ["-machine", "netduinoplus2", "-icount", "shift=4", "-nographic", "-monitor", "none"]
        more = ["-serial", "none", "-semihosting-config", "enable=on,target=native", "-kernel"]
        self.emulator = subprocess.Popen(
            [os.path.abspath(qemu), *machine, *more, os.path.abspath(image)],
            cwd=self.folder.name,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
        )
        # Open for both directions, a pipe does not wait for its other end.
        self.to_target, self.from_target = (os.open(path, os.O_RDWR) for path in paths)
        self.session, self.sequence, self.bytes = os.urandom(4), 0, b""
        identity = self.receive(IDENTITY)
        begin = identity.at
        self.joints = identity.byte()
        identity.varint()  # the robot's fingerprint
        self.robot = identity.data[begin : identity.at]

    def send(self, message):
        plain = bytes([VERSION]) + self.session + varint(self.sequence) + message
        plain += struct.pack("<I", zlib.crc32(plain))
        self.sequence += 1
        os.write(self.to_target, cobs(plain) + b"\0")

    def receive(self, kind):
        while b"\0" not in self.bytes:
            self.bytes += os.read(self.from_target, 4096)
        frame, self.bytes = self.bytes.split(b"\0", 1)
        plain = uncobs(frame)
        body, (checksum,) = plain[:-4], struct.unpack("<I", plain[-4:])
        if zlib.crc32(body) != checksum or body[0] != VERSION:
            raise RuntimeError(f"a frame of version {body[0]} and not {VERSION}, or one that is broken")
        message = Reader(body)
        message.at = 5
        message.varint()  # its number
        found = message.byte()
        if found != kind:
            raise RuntimeError(f"the firmware answers with message {found}, and {kind} was expected")
        return message

    def order(self, message):
        self.send(message)
        answer = self.receive(ACKNOWLEDGED).byte()
        if answer != 0:
            raise RuntimeError(f"the firmware refuses order {message[0]}: {answer}")

    def arm(self):
        self.order(bytes([DISARM]))
        self.order(bytes([ARM]) + self.robot)

    def tick(self, position, orientation, velocity, angles, rates, touch):
        """One tick: torques in N·m, what the supervisor does, and what the tick has cost in instructions."""
        floats = lambda values: struct.pack(f"<{len(values)}f", *values)
        joints = lambda values: varint(len(values)) + floats(values)
        feet = sum(1 << foot for foot, touches in enumerate(touch) if touches)
        state = floats(position) + floats(orientation) + floats(velocity)
        # At time 0, which nobody reads in lock step; without forces on the feet.
        self.send(bytes([SENSORS]) + varint(0) + state + joints(angles) + joints(rates) + bytes([feet, 0]))
        answer = self.receive(TORQUES)
        answer.varint()  # the tick's number
        torques = answer.floats(answer.varint())
        answer.floats(6)  # the desired wrench
        return torques, answer.varint()

    def close(self):
        self.emulator.kill()
        self.emulator.wait()
        self.folder.cleanup()


def main(qemu, image, library, file):
    with open(file, encoding="utf-8") as text:
        model = json.load(text)
    plant, firmware = Plant(model), Firmware(qemu, image)
    host = Controller(library, model, as_built=True)
    plant.reset()
    firmware.arm()
    data, per_tick, ticks = plant.data, round(LOCK_STEP_PERIOD / STEP), 0
    try:
        for step in range(round(model["duration"] / STEP)):
            if step % per_tick == 0:
                measured = (*plant.state(), plant.touches())
                torques, mode = firmware.tick(*measured)
                expected, _ = host.tick(*measured)
                if torques.tobytes() != expected.astype("<f4").tobytes():
                    raise RuntimeError(f"tick {ticks}: {torques} on the target, {expected} on the host")
                if mode != ACTIVE:
                    raise RuntimeError(f"tick {ticks}: the supervisor has stopped the robot, mode {mode}")
                data.qfrc_applied[plant.rates] = torques
                ticks += 1
            time = step * STEP
            # 3 N·s ahead.
            data.xfrc_applied[plant.link, 0] = 30.0 if 0.7 <= time < 0.8 else 0.0
            mujoco.mj_step(plant.model, data)
    finally:
        firmware.close()
    off = float(np.linalg.norm(plant.state()[0] - np.array(model["set_point"]["position"])))
    print(json.dumps({"mujoco": mujoco.__version__, "ticks": ticks, "bits_equal": True, "off_m": off}))


if __name__ == "__main__":
    main(*sys.argv[1:])

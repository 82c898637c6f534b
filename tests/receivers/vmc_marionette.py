"""A marionette of VMC: reads the bundles of a dance that is played, and compares it with the same dance as BVH.

Usage: vmc_marionette.py RAKS MUSIC [OPTION...]    options for raks play and raks dance, such as --avatar X.vrm
Prints one line of JSON: frames, packets, the longest packet, gaps between frames, what the thread costs, how far
joints are from those of the BVH at the best shift in time, and what was told at the end.
"""
import json
import math
import os
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

SO_TIMESTAMPNS = 35
TIME_OF_BVH = 1.0 / 240.0
THUMBS = {"ThumbIntermediate": "ThumbProximal", "ThumbProximal": "ThumbMetacarpal"}


def read_text(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), (end + 4) & ~3


def read_message(data):
    address, at = read_text(data, 0)
    types, at = read_text(data, at)
    values = []
    for kind in types[1:]:
        if kind == "s":
            value, at = read_text(data, at)
        else:
            (value,), at = struct.unpack_from(">i" if kind == "i" else ">f", data, at), at + 4
        values.append(value)
    return address, types[1:], values


def read_bundle(data):
    assert data.startswith(b"#bundle\0"), "no bundle"
    at, messages = 16, []
    while at < len(data):
        (size,) = struct.unpack_from(">i", data, at)
        messages.append(read_message(data[at + 4:at + 4 + size]))
        at += 4 + size
    return messages


def product(a, b):
    (aw, ax, ay, az), (bw, bx, by, bz) = a, b
    return (aw * bw - ax * bx - ay * by - az * bz, aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx, aw * bz + ax * by - ay * bx + az * bw)


def turned(q, v):
    w, x, y, z = q
    vx, vy, vz = v
    tx, ty, tz = 2 * (y * vz - z * vy), 2 * (z * vx - x * vz), 2 * (x * vy - y * vx)
    return (vx + w * tx + y * tz - z * ty, vy + w * ty + z * tx - x * tz, vz + w * tz + x * ty - y * tx)


def plus(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


class Bvh:
    """A file of raks dance: joints in the order of the file, each with its parent, in metres."""

    def __init__(self, path):
        with open(path, encoding="ascii") as file:
            lines = [line.split() for line in file]
        self.names, self.parents, self.offsets, above, self.rows, self.known = [], [], [], [], [], {}
        for at, words in enumerate(lines):
            if words[0] in ("ROOT", "JOINT"):
                self.names.append(words[1])
                self.parents.append(above[-1] if above else -1)
                above.append(len(self.names) - 1)
            elif words[0] == "End":
                above.append(None)
            elif words[0] == "OFFSET" and above[-1] is not None:
                self.offsets.append(tuple(map(float, words[1:])))
            elif words[0] == "}":
                above.pop()
            elif words[0] == "MOTION":
                self.rows = [list(map(float, row)) for row in lines[at + 3:]]
                break

    def places(self, row):
        """Places of all joints in one row, by name."""
        if row in self.known:
            return self.known[row]
        numbers, turns, places = self.rows[row], [], []
        for joint, above in enumerate(self.parents):
            z, x, y = (math.radians(0.5 * angle) for angle in numbers[3 + 3 * joint:6 + 3 * joint])
            turn = product(product((math.cos(z), 0, 0, math.sin(z)), (math.cos(x), math.sin(x), 0, 0)),
                           (math.cos(y), 0, math.sin(y), 0))
            turns.append(turn if above < 0 else product(turns[above], turn))
            places.append(tuple(numbers[:3]) if above < 0 else
                          plus(places[above], turned(turns[above], self.offsets[joint])))
        self.known[row] = dict(zip(self.names, places))
        return self.known[row]

    def places_at(self, seconds):
        row = max(0.0, min(seconds / TIME_OF_BVH, len(self.rows) - 1.001))
        share = row - int(row)
        before, after = self.places(int(row)), self.places(int(row) + 1)
        return {name: tuple(b + share * (a - b) for b, a in zip(before[name], after[name])) for name in before}


def unity_name(name):
    for unity, vrm in THUMBS.items():
        if name.endswith(vrm):
            name = name.replace(vrm, unity)
            break
    return name[0].upper() + name[1:]


def places_of(bones, bvh):
    """Places of the joints of one frame, with the axes turned back, on the humanoid's own parents."""
    turns, places = [], []
    for name, above in zip(bvh.names, bvh.parents):
        px, py, pz, qx, qy, qz, qw = bones[unity_name(name)]
        turn, offset = (qw, qx, -qy, -qz), (-px, py, pz)
        turns.append(turn if above < 0 else product(turns[above], turn))
        places.append(offset if above < 0 else plus(places[above], turned(turns[above], offset)))
    return dict(zip(bvh.names, places))


def worst_of(places, seconds, bvh):
    expected = bvh.places_at(seconds)
    return max(math.dist(place, expected[name]) for name, place in places.items())


def best_shift(frames, bvh):
    """Seconds to add to a frame's time so that it is the BVH's: first by the hips alone, then by all joints."""
    last = TIME_OF_BVH * (len(bvh.rows) - 1)
    some = frames[len(frames) // 4::max(1, len(frames) // 60)]
    def hips_off(shift):
        rows = [bvh.rows[min(len(bvh.rows) - 1, max(0, round((seconds + shift) / TIME_OF_BVH)))] for seconds, _ in some]
        return sum(math.dist(row[:3], places["hips"]) for row, (_, places) in zip(rows, some))
    shift = min((TIME_OF_BVH * step for step in range(-240, round(last / TIME_OF_BVH))), key=hips_off)
    few, width = some[::4], 2 * TIME_OF_BVH
    def joints_off(shift):
        return sum(worst_of(places, seconds + shift, bvh) for seconds, places in few)
    while width > 1e-5:
        shift = min((shift + step * width for step in (-1, -0.5, 0, 0.5, 1)), key=joints_off)
        width *= 0.5
    return shift


class Listener(threading.Thread):
    """Keeps all packets with the times at which the system got them."""

    def __init__(self):
        super().__init__(daemon=True)
        self.socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 22)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        self.socket.bind(("127.0.0.1", 0))
        self.port = self.socket.getsockname()[1]
        self.packets = []

    def run(self):
        while True:
            data, extra, _, _ = self.socket.recvmsg(4096, 64)
            seconds, nanos = struct.unpack("qq", extra[0][2][:16])
            self.packets.append((seconds + 1e-9 * nanos, data))


def outputs_thread(process):
    for task in os.listdir(f"/proc/{process}/task"):
        with open(f"/proc/{process}/task/{task}/comm", encoding="ascii") as file:
            if file.read().strip() == "raks-outputs":
                return f"/proc/{process}/task/{task}/schedstat"
    return None


def cpu_seconds(path):
    with open(path, encoding="ascii") as file:
        return 1e-9 * int(file.read().split()[0])


def play(raks, music, options, listener):
    """Plays; returns which share of a core the outputs' thread took while frames came."""
    player = subprocess.Popen([raks, "play", "--no-sound", "--headless", "--quit", "--as-live", music, "--vmc",
                               f"127.0.0.1:{listener.port},lead=-200", *options], stderr=subprocess.DEVNULL)
    path, share, first = None, None, None
    while player.poll() is None:
        time.sleep(0.2)
        try:
            path = path or outputs_thread(player.pid)
            if path and listener.packets:
                now = time.monotonic(), cpu_seconds(path)
                first = first or now
                share = (now[1] - first[1]) / (now[0] - first[0]) if now[0] > first[0] + 1 else share
        except OSError:
            pass
    assert player.returncode == 0, "raks play failed"
    return share


def frames_of(packets):
    """Frames as (seconds, bones), when each came, what was told at the end, and whether all of it was right."""
    frames, came, bones, face, end, is_right = [], [], {}, {}, {}, True
    for arrival, data in packets:
        values = {}
        for address, types, arguments in read_bundle(data):
            if address == "/VMC/Ext/Bone/Pos":
                bones[arguments[0]] = arguments[1:]
                is_right &= types == "sfffffff" and any(abs(number) > 1e-3 for number in arguments[1:4])
            elif address == "/VMC/Ext/Blend/Val":
                values[arguments[0]] = arguments[1]
            elif address == "/VMC/Ext/Blend/Apply":
                face = values
            elif address == "/VMC/Ext/OK":
                end = {"ok": arguments[0], "faces": sum(face.values())}
            elif address == "/VMC/Ext/T":
                if bones:
                    frames.append((arguments[0], bones))
                    came.append(arrival)
                bones = {}
    return frames, came, end, is_right


def main():
    raks, music, *options = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "dance.bvh")
        subprocess.run([raks, "dance", music, "--as-live", "--fps", "240", "-o", path, *options], check=True,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        bvh = Bvh(path)
    listener = Listener()
    listener.start()
    share = play(raks, music, options, listener)
    time.sleep(0.2)
    frames, came, end, is_right = frames_of(listener.packets)
    gaps = sorted(1e3 * (after - before) for before, after in zip(came, came[1:]))
    # Before the dance begins and behind the end of the file both stand still.
    placed = [(seconds, places_of(bones, bvh)) for seconds, bones in frames[::2]]
    placed = placed[len(placed) // 10:-len(placed) // 10]
    shift = best_shift(placed, bvh)
    off = sorted(1e3 * worst_of(places, seconds + shift, bvh) for seconds, places in placed)
    at = lambda values, share: round(values[int(share * (len(values) - 1))], 3)
    print(json.dumps({
        "frames": len(frames), "packets": len(listener.packets), "bones": len(frames[-1][1]), "right": is_right,
        "longest": max(len(data) for _, data in listener.packets),
        "gaps_ms": {"p50": at(gaps, 0.5), "p99": at(gaps, 0.99), "worst": at(gaps, 1)},
        "cpu_percent": share and round(100 * share, 2), "shift_ms": round(1e3 * shift, 1),
        "joints_mm": {"p50": at(off, 0.5), "p99": at(off, 0.99), "worst": at(off, 1)}, "end": end}), flush=True)


main()

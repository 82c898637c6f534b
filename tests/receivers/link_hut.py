#!/usr/bin/env python3
"""Follows LinkHut (Debian: ableton-link-utils) with a raks that was built with Ableton Link.

    unshare -n sh -c 'ip link set lo up; ip route add 224.0.0.0/4 dev lo; tests/receivers/link_hut.py RAKS'

Nothing is sent beyond that namespace. Starts a JACK server of its own, which both need, listens to its
silence, and changes LinkHut's tempo. Prints, as JSON, the tempo that Raks told beats at before and after, how far
its beats were from LinkHut's (milliseconds), the peers that it said, and the session's tempo when it had gone.
"""
import json
import os
import pty
import re
import select
import subprocess
import sys
import threading
import time

SERVER = {"JACK_DEFAULT_SERVER": f"raks-link-{os.getpid()}", "JACK_NO_START_SERVER": "1"}
ENVIRONMENT = dict(os.environ, **SERVER)


class LinkHut:
    """LinkHut at a terminal of its own; what it shows is read as (seconds, tempo, beats)."""

    def __init__(self):
        self.process, self.terminal = pty.fork()
        if self.process == 0:
            os.execvpe("LinkHut", ["LinkHut"], ENVIRONMENT)
        self.shown = []
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        while True:
            select.select([self.terminal], [], [])
            now = time.monotonic()
            try:
                text = os.read(self.terminal, 65536).decode(errors="replace")
            except OSError:
                return
            found = re.findall(r"\|\s*(\d+\.\d+)\s*\|\s*(-?\d+\.\d+)\s*\|", text)
            if found:
                self.shown.append((now, float(found[-1][0]), float(found[-1][1])))

    def press(self, keys):
        for key in keys:
            os.write(self.terminal, key.encode())
            time.sleep(0.3)

    def beats_at(self, moment):
        """By the line through what was shown around then; what is shown is cut off at hundredths."""
        near = [s for s in list(self.shown) if abs(s[0] - moment) < 1.0]
        middle = sum(s[0] for s in near) / len(near)
        mean = sum(s[2] for s in near) / len(near)
        rate = near[-1][1] / 60.0
        return mean + 0.005 + rate * (moment - middle)


def main():
    raks = sys.argv[1]
    jack = subprocess.Popen(
        ["jackd", "-R", "-P70", "-n", SERVER["JACK_DEFAULT_SERVER"], "-d", "dummy", "-r", "48000", "-p", "256"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env=ENVIRONMENT)
    time.sleep(2)
    hut = LinkHut()
    time.sleep(1)
    hut.press("aeee")
    listener = subprocess.Popen(
        [raks, "live", "--no-avatar", "--device", "system", "--link", "--lines", "-", "--duration", "20"],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
    beats = []

    def read_beats():
        for line in listener.stdout:
            now = time.monotonic()
            beat = json.loads(line)
            if beat["do"] == "beat":
                beats.append((now + beat["in_ms"] / 1000.0, beat["bpm"], beat["count"]))

    reader = threading.Thread(target=read_beats)
    reader.start()
    start = time.monotonic()
    time.sleep(10)
    hut.press("wwwww")
    changed = time.monotonic()
    said = listener.stderr.read()
    reader.join()
    time.sleep(1)
    off = []
    counts = []
    for moment, bpm, count in beats:
        if start + 4 < moment < changed - 2 or moment > changed + 3:
            position = hut.beats_at(moment)
            off.append(1000.0 * (position - round(position)) * 60.0 / bpm)
            counts.append((round(position) - (count - 1)) % 4)
    before = [bpm for moment, bpm, _ in beats if start + 4 < moment < changed - 2]
    print(json.dumps({
        "tempo_before": before[-1], "tempo_after": beats[-1][1], "tempo_when_gone": hut.shown[-1][1],
        "beats": len(off), "off_mean_ms": sum(off) / len(off), "off_worst_ms": max(map(abs, off)),
        "counts_that_differ": sum(1 for c in counts if c), "said": [s for s in said.splitlines() if "--link" in s]}))
    hut.press("q")
    jack.terminate()
    jack.wait()


main()

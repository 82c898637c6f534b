"""Events as they are sent against those that the analysis finds, in music that Raks wrote itself.

Usage: count_events.py RAKS SEED...    plays the song of each seed twice, known ahead and as live, all at the same time
Prints a line of JSON a song and way: events that `raks analyze` finds, whether the same ones were sent in the same
order, how far from when they were due (ms, the worst), how many of those that the music has were sent within one beat,
and whether /next counted down without a gap (OSC; songs that are known ahead).
"""
import json
import os
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time


def read_table(path):
    with open(path) as lines:
        return [line.split() for line in lines if line.strip() and not line.startswith("#")]


def hear_next(receiver, said):
    while True:
        packet = receiver.recv(2048)
        at = packet.find(b"/raks/next\0")
        if packet.startswith(b"#bundle") and at > 0:
            rest = packet[at + 12 + 4:]
            name, _, tail = rest.partition(b"\0")
            size = (len(name) // 4 + 1) * 4
            said.append((name.decode(), struct.unpack(">f", rest[size:size + 4])[0]))
        elif packet.startswith(b"/raks/goodbye"):
            return


def gaps_in(said):
    """Countdowns in which a beat is missing: the next number is more than 1.5 below the one before."""
    return sum(before[0] == after[0] and before[1] - after[1] > 1.5 for before, after in zip(said, said[1:]))


def play(raks, folder, seed, is_known):
    music = os.path.join(folder, f"{seed}.wav")
    beats = [float(row[0]) for row in read_table(os.path.join(folder, f"{seed}.beats"))]
    true = [(float(row[0]), row[1]) for row in read_table(os.path.join(folder, f"{seed}.events"))
            if row[1] in ("stop", "entry", "breakdown", "build-up", "drop", "end")]
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", 0))
    said = []
    threading.Thread(target=hear_next, args=(receiver, said), daemon=True).start()
    program = subprocess.Popen([raks, "play", "--no-sound", "--headless", "--quit", music, "--lines", "-", "--osc",
                                f"127.0.0.1:{receiver.getsockname()[1]}"] + ([] if is_known else ["--as-live"]),
                               stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    told = [(time.monotonic(), json.loads(line)["do"]) for line in program.stdout]
    sent = [(when, what) for when, what in told if what != "beat"]
    found = json.loads(subprocess.run([raks, "analyze", "-q", "--json", music] + (["--whole"] if is_known else []),
                                      capture_output=True, text=True, check=True).stdout)["events"]
    # Live an event is told when it is known.
    due = [max(each["time"], each["told"]) for each in found]
    is_same = [each["event"] for each in found] == [what for _, what in sent]
    late = [when - at for (when, _), at in zip(sent, due)]
    origin = statistics.median(late) if late else 0.0
    period = statistics.median(after - before for before, after in zip(beats, beats[1:]))
    near = sum(any(what == kind and abs(when - origin - at) <= period for when, what in sent) for at, kind in true)
    print(json.dumps({"seed": seed, "known": is_known, "found": len(found), "sent": len(sent), "same": is_same,
                      "worst_ms": round(1e3 * max((abs(one - origin) for one in late), default=0.0), 1) if is_same else None,
                      "in_the_music": len(true), "within_a_beat": near,
                      "next": len(said), "next_gaps": gaps_in(said)}), flush=True)


def main():
    raks, seeds = sys.argv[1], sys.argv[2:]
    with tempfile.TemporaryDirectory() as folder:
        trials = []
        for seed in seeds:
            subprocess.run([raks, "synth", "-q", "--seed", seed, "--form", "song", "--duration", "90",
                            "-o", f"{folder}/{seed}.wav", "--beats", f"{folder}/{seed}.beats",
                            "--events", f"{folder}/{seed}.events"], check=True)
            trials += [threading.Thread(target=play, args=(raks, folder, seed, is_known)) for is_known in (True, False)]
        for trial in trials:
            trial.start()
        for trial in trials:
            trial.join()


main()

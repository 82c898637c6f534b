"""Beats sent against beats heard: plays music of one tempo and counts what comes by OSC, OS2L, WLED and lines.

Usage: count_beats.py RAKS MUSIC.wav BPM
       count_beats.py --listen BPM OSC_PORT WLED_PORT OS2L_PORT VMC_PORT    counts what anybody sends, until it is ended
Prints one line of JSON: for each target the beats that came, those that are in the time from the first to the last
one, and how many came twice (less than half a beat behind another) or were left out; of VMC the frames that came.
"""
import json
import signal
import socket
import subprocess
import sys
import threading
import time


def listen(kind, port=0):
    receiver = socket.socket(socket.AF_INET, kind)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind(("127.0.0.1", port))
    return receiver, receiver.getsockname()[1]


def hear_osc(receiver, beats):
    while True:
        packet = receiver.recv(2048)
        if packet.startswith(b"/raks/trigger/beat\0"):
            beats.append(time.monotonic())


def hear_wled(receiver, beats):
    was_peak = 0
    while True:
        peak = receiver.recv(2048)[16]
        if peak and not was_peak:
            beats.append(time.monotonic())
        was_peak = peak


def hear_os2l(server, beats):
    connection = server.accept()[0]
    while data := connection.recv(4096):
        if json.loads(data)["evt"] == "beat":
            beats.append(time.monotonic())


def hear_vmc(receiver, frames):
    while True:
        if b"/VMC/Ext/OK\0" in receiver.recv(2048):
            frames.append(time.monotonic())


def summary(beats, period):
    gaps = [after - before for before, after in zip(beats, beats[1:])]
    return {"came": len(beats), "expected": round((beats[-1] - beats[0]) / period) + 1 if beats else 0,
            "twice": sum(gap < 0.5 * period for gap in gaps),
            "left_out": sum(round(gap / period) - 1 for gap in gaps if gap > 1.5 * period)}


def main():
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM} if sys.argv[1] == "--listen" else set())
    ports = [int(port) for port in sys.argv[3:7]] if sys.argv[1] == "--listen" else [0, 0, 0, 0]
    osc, osc_port = listen(socket.SOCK_DGRAM, ports[0])
    wled, wled_port = listen(socket.SOCK_DGRAM, ports[1])
    os2l, os2l_port = listen(socket.SOCK_STREAM, ports[2])
    os2l.listen()
    vmc, _ = listen(socket.SOCK_DGRAM, ports[3])
    frames = []
    threading.Thread(target=hear_vmc, args=(vmc, frames), daemon=True).start()
    beats = {"osc": [], "os2l": [], "wled": [], "lines": []}
    for hear, receiver, name in ((hear_osc, osc, "osc"), (hear_wled, wled, "wled"), (hear_os2l, os2l, "os2l")):
        threading.Thread(target=hear, args=(receiver, beats[name]), daemon=True).start()
    if sys.argv[1] == "--listen":
        signal.sigwait({signal.SIGTERM, signal.SIGINT})
        counted = {name: summary(all_of, 60 / float(sys.argv[2])) for name, all_of in beats.items() if name != "lines"}
        print(json.dumps({**counted, "vmc_frames": len(frames)}), flush=True)
        return
    raks, music, bpm = sys.argv[1:4]
    program = subprocess.Popen(
        [raks, "play", "--no-sound", "--headless", "--quit", "--as-live", music, "--lines", "-",
         "--osc", f"127.0.0.1:{osc_port}", "--wled", f"127.0.0.1:{wled_port}", "--os2l", f"127.0.0.1:{os2l_port}"],
        stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    for line in program.stdout:
        if json.loads(line)["do"] == "beat":
            beats["lines"].append(time.monotonic())
    program.wait()
    time.sleep(0.2)
    print(json.dumps({"bpm": float(bpm), **{name: summary(all_of, 60 / float(bpm)) for name, all_of in beats.items()}}))


main()

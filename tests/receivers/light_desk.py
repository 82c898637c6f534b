"""QLC+ obeys beats by OS2L and by OSC: what DMX it makes of them, and when.

Usage: light_desk.py RAKS MUSIC.wav [LEAD_MS]. Run it in a network namespace of its own (unshare -n) with DISPLAY set.
Prints one line of JSON: the beats that Raks told, and for each protocol how many of them changed a DMX channel,
and after how many milliseconds (5th, 50th and 95th percentile).
"""
import json
import os
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

HERE = os.path.dirname(os.path.abspath(__file__))


def qt_checksum(text):
    """CRC-16 of ISO 3309, by which QLC+ numbers the OSC addresses that it knows."""
    crc = 0xFFFF
    for byte in text.encode():
        crc ^= byte
        for _ in range(8):
            crc = (crc >> 1) ^ 0x8408 if crc & 1 else crc >> 1
    return ~crc & 0xFFFF


def watch_dmx(changes, ready):
    """Notes when channels 1 and 2 change, as E1.31 tells them on lo."""
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    receiver.bind(("", 5568))
    for group in ("239.255.0.1",):
        receiver.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                            struct.pack("4s4s", socket.inet_aton(group), socket.inet_aton("127.0.0.1")))
    before = {}
    while True:
        packet = receiver.recv(2048)
        now = time.monotonic()
        ready.set()
        for channel in (1, 2):
            value = packet[125 + channel]
            if channel in before and before[channel] != value:
                changes[channel].append(now)
            before[channel] = value


def percentile(values, share):
    return round(1e3 * sorted(values)[min(len(values) - 1, int(share * len(values)))], 1) if values else None


def obeyed(beats, changes):
    """Changes from 50 ms before a beat to 150 ms behind it, each beat once."""
    delays = []
    for beat in beats:
        after = [change - beat for change in changes if -0.05 <= change - beat < 0.15]
        delays += after[:1]
    return {"obeyed": len(delays), "p5_ms": percentile(delays, 0.05), "p50_ms": percentile(delays, 0.5),
            "p95_ms": percentile(delays, 0.95), "changes": len(changes)}


def main():
    raks, music = sys.argv[1:3]
    lead = ",lead=" + (sys.argv[3] if len(sys.argv) > 3 else "0")
    subprocess.run("ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo",
                   shell=True, check=True)
    changes, ready = {1: [], 2: []}, threading.Event()
    threading.Thread(target=watch_dmx, args=(changes, ready), daemon=True).start()
    with tempfile.TemporaryDirectory() as folder:
        show = os.path.join(folder, "show.qxw")
        with open(os.path.join(HERE, "light_desk.qxw")) as template, open(show, "w") as out:
            out.write(template.read().replace("@OSC_BEAT@", str(qt_checksum("/raks/trigger/beat"))))
        desk = subprocess.Popen(["qlcplus", "-p", "-o", show, "-m"], env={**os.environ, "HOME": folder},
                                stdout=open(os.path.join(folder, "log"), "w"), stderr=subprocess.STDOUT)
        try:
            if not ready.wait(60):
                print(open(os.path.join(folder, "log")).read(), file=sys.stderr)
                sys.exit("QLC+ sends no DMX")
            time.sleep(2)
            lines = subprocess.Popen(
                [raks, "play", "--no-sound", "--headless", "--quit", music, "--lines", "-",
                 "--os2l", "127.0.0.1" + lead, "--osc", "127.0.0.1:7701" + lead],
                stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
            beats = []
            for line in lines.stdout:
                now = time.monotonic()
                if json.loads(line)["do"] == "beat":
                    beats.append(now)
            lines.wait()
            time.sleep(0.3)
        finally:
            desk.kill()
            desk.wait()
    print(json.dumps({"beats": len(beats), "os2l": obeyed(beats, changes[1]), "osc": obeyed(beats, changes[2])}))


main()

"""What the audio and motion threads cost while everybody whom Raks tells, or who asks it, is dead, slow or flooding.

Usage: bad_peers.py RAKS MUSIC.wav [SECONDS] [OPTION...]
Plays the music headless, in turns without outputs and with all of them, three times each, for so many seconds (30).
The peers: a UDP port where nobody listens, a host that does not exist, a TCP peer that accepts and never reads, one
that talks back without an end, and senders that flood OSC in and HTTP. OPTION: further options of the second kind of
run, as --midi-clock beats. Prints one line of JSON: for each thread the milliseconds of processor time a second
without and with outputs, the ratio of their medians, and the complaints of the program.
"""
import json
import pathlib
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

SETTLED = 8.0
THREADS = ("raks-audio", "raks-motion")


def thread_seconds(pid):
    seconds = {}
    for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
        name = (task / "comm").read_text().strip()
        spent = int((task / "schedstat").read_text().split()[0]) / 1e9
        seconds[name] = seconds.get(name, 0.0) + spent
    return seconds


def tcp_server(serve):
    server = socket.create_server(("127.0.0.1", 0))

    def accept():
        while True:
            connection = server.accept()[0]
            threading.Thread(target=serve, args=(connection,), daemon=True).start()
    threading.Thread(target=accept, daemon=True).start()
    return server.getsockname()[1]


def never_read(connection):
    while True:
        time.sleep(3600)
        connection.fileno()


def talk_back(connection):
    try:
        while True:
            connection.sendall(b'{"evt":"feedback"}\n' * 50)
    except OSError:
        pass


def closed_port():
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver:
        receiver.bind(("127.0.0.1", 0))
        return receiver.getsockname()[1]


class Flood:
    """Sends 2,000 OSC messages and 200 HTTP requests a second, of which most are nonsense."""

    def __init__(self, osc_port, http_port):
        self.ended = threading.Event()
        threading.Thread(target=self.flood_osc, args=(osc_port,), daemon=True).start()
        threading.Thread(target=self.flood_http, args=(http_port,), daemon=True).start()

    def flood_osc(self, port):
        sender = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        packets = (b"/raks/do/no_such_action\0,\0\0\0", b"\xff" * 900, b"#bundle\0" + b"\0" * 40)
        while not self.ended.wait(0.01):
            for index in range(20):
                try:
                    sender.sendto(packets[index % 3], ("127.0.0.1", port))
                except OSError:
                    pass

    def flood_http(self, port):
        while not self.ended.wait(0.005):
            try:
                with socket.create_connection(("127.0.0.1", port), 1) as peer:
                    peer.sendall(b"POST /do/no_such_action HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1\r\n\r\n1")
                    peer.recv(64)
            except OSError:
                pass


def run(raks, music, seconds, options, flooded_ports, errors):
    show = subprocess.Popen([raks, "play", "--no-sound", "--headless", "--repeat", music, *options],
                            stdout=subprocess.DEVNULL, stderr=errors)
    flood = Flood(*flooded_ports) if flooded_ports else None
    try:
        time.sleep(SETTLED)
        before, begin = thread_seconds(show.pid), time.monotonic()
        time.sleep(seconds)
        after, passed = thread_seconds(show.pid), time.monotonic() - begin
    finally:
        if flood:
            flood.ended.set()
        show.send_signal(signal.SIGINT)
        show.wait()
    return {name: 1e3 * (after[name] - before[name]) / passed for name in THREADS}


def main():
    raks, music = sys.argv[1:3]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 30.0
    osc_in, http = closed_port(), closed_port()
    options = ["--osc", f"127.0.0.1:{closed_port()},rate=50", "--osc", "no-such-host.invalid:9000",
               "--os2l", f"127.0.0.1:{tcp_server(never_read)}", "--os2l", f"127.0.0.1:{tcp_server(talk_back)}",
               "--os2l", "127.0.0.1:1", "--wled", f"127.0.0.1:{closed_port()}", "--vmc", f"127.0.0.1:{closed_port()}",
               "--lines", "/dev/full", "--osc-in", str(osc_in), "--remote", "--remote-address", f"127.0.0.1:{http}",
               *sys.argv[4:]]
    without, with_all = [], []
    with tempfile.TemporaryFile() as errors:
        for _ in range(3):
            without.append(run(raks, music, seconds, [], None, subprocess.DEVNULL))
            with_all.append(run(raks, music, seconds, options, (osc_in, http), errors))
        errors.seek(0)
        complaints = [line for line in errors.read().decode().splitlines() if "127.0.0.1" in line or "invalid" in line]
    report = {}
    for name in THREADS:
        first, second = (statistics.median(turn[name] for turn in turns) for turns in (without, with_all))
        report[name] = {"without": round(first, 2), "with": round(second, 2), "ratio": round(second / first, 3)}
    print(json.dumps({**report, "complaints": len(complaints) // 3}))


main()

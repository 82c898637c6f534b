"""OSC's beats against the clicks that come out of a sink, and out of one that is 300 ms late, on PulseAudio.

Usage: late_sink.py RAKS CLICKS.wav [SECONDS]
       late_sink.py --running SINK OSC_PORT SECONDS    of a program that plays clicks on a sink already
Starts two PulseAudio servers, plays the clicks on a sink of the first, then on one that sends to the second, and
records both from their monitors. A monitor gives a sample some milliseconds after it sounds, the same for both:
so what counts is by how much the two means differ. Prints one line of JSON, in milliseconds.
"""
import array
import json
import os
import signal
import socket
import statistics
import subprocess
import sys
import tempfile
import threading
import time

RATE = 48000
SETTLED = 10.0


def start_server(folder, name, sink):
    path = os.path.join(folder, name)
    server = subprocess.Popen(
        ["pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1", "--realtime=no", "--high-priority=no",
         "--disable-shm=yes", "--use-pid-file=no", "-L", f"module-native-protocol-unix socket={path}",
         "-L", f"module-null-sink sink_name={sink} rate={RATE}"], stderr=subprocess.DEVNULL)
    while subprocess.call(["pactl", "--server", f"unix:{path}", "info"],
                          stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL):
        time.sleep(0.1)
    return server, f"unix:{path}"


class Monitor:
    """The clicks of a sink's monitor, by this machine's clock."""

    def __init__(self, server, sink):
        self.recorder = subprocess.Popen(
            ["parec", "--server", server, "-d", f"{sink}.monitor", "--latency-msec=5", "--raw", "--format=s16le",
             f"--rate={RATE}", "--channels=1"], stdout=subprocess.PIPE)
        self.samples = array.array("h")
        self.begins = []  # Of the recording, as each read tells it: none is too early.
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        while data := os.read(self.recorder.stdout.fileno(), 4096):
            self.samples.frombytes(data[:len(data) // 2 * 2])
            self.begins.append(time.monotonic() - len(self.samples) / RATE)

    def clicks(self):
        begin = statistics.quantiles(self.begins, n=20)[0]
        threshold = 0.3 * max(map(abs, self.samples))
        found, last = [], -RATE
        for index, sample in enumerate(self.samples):
            if abs(sample) > threshold:
                if index - last > RATE // 8:
                    found.append(begin + index / RATE)
                last = index
        return found


def hear(receiver, beats):
    while True:
        if receiver.recv(2048).startswith(b"/raks/trigger/beat\0"):
            beats.append(time.monotonic())


def listen(port=0):
    receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    receiver.bind(("127.0.0.1", port))
    beats = []
    threading.Thread(target=hear, args=(receiver, beats), daemon=True).start()
    return receiver, beats


def deviation(beats, monitor, settling):
    monitor.recorder.kill()
    clicks = monitor.clicks()
    settled = [beat for beat in beats[:-1] if beat > beats[0] + settling]
    late = [min((beat - click for click in clicks), key=abs) for beat in settled]
    mean = statistics.mean(late)
    off = sorted(abs(value - mean) for value in late)
    return {"beats": len(late), "mean_ms": round(1e3 * mean, 1),
            "deviation_p99_ms": round(1e3 * off[int(0.99 * (len(off) - 1))], 1)}


def measure(raks, music, server, monitor, seconds):
    receiver, beats = listen()
    show = subprocess.Popen([raks, "play", "--headless", "--repeat", music, "--audio-system", "pulse",
                             "--osc", f"127.0.0.1:{receiver.getsockname()[1]}"],
                            env={**os.environ, "PULSE_SERVER": server, "JACK_NO_START_SERVER": "1"},
                            stderr=subprocess.DEVNULL)
    time.sleep(SETTLED + seconds)
    show.send_signal(signal.SIGINT)
    show.wait()
    return deviation(beats, monitor, SETTLED)


def main():
    if sys.argv[1] == "--running":
        _, beats = listen(int(sys.argv[3]))
        monitor = Monitor(os.environ["PULSE_SERVER"], sys.argv[2])
        time.sleep(1)
        beats.clear()  # The monitor has begun.
        time.sleep(float(sys.argv[4]))
        heard = list(beats)
        time.sleep(0.5)
        print(json.dumps(deviation(heard, monitor, 0)))
        return
    raks, music = sys.argv[1:3]
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 30.0
    with tempfile.TemporaryDirectory() as folder:
        os.environ["XDG_RUNTIME_DIR"] = folder
        near, near_address = start_server(folder, "near", "speakers")
        far, far_address = start_server(folder, "far", "far")
        try:
            direct = measure(raks, music, near_address, Monitor(near_address, "speakers"), seconds)
            subprocess.check_call(["pactl", "--server", near_address, "load-module", "module-tunnel-sink",
                                   f"server={far_address}", "sink=far", "sink_name=late", "latency_msec=300"],
                                  stdout=subprocess.DEVNULL)
            subprocess.check_call(["pactl", "--server", near_address, "set-default-sink", "late"])
            late = measure(raks, music, near_address, Monitor(far_address, "far"), seconds)
        finally:
            near.kill()
            far.kill()
            near.wait()
            far.wait()
    print(json.dumps({"direct": direct, "late": late,
                      "apart_ms": round(late["mean_ms"] - direct["mean_ms"], 1)}))


main()

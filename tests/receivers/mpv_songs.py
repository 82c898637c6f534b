"""Songs that mpv plays one behind the other, danced to by what mpv says on the session bus, and by ears alone.

Usage: mpv_songs.py RAKS PAIRS [SEED]
       mpv_songs.py RAKS hands            playerctl pauses, goes on, seeks and goes to the next song
Needs dbus-daemon, pulseaudio, mpv with mpv-mpris, playerctl, ffmpeg. Draws styles and tempi, writes the songs with
`raks synth` and a genre into their tags, and plays them into a null sink whose monitor two beat servers hear at once:
one with --now-playing and one without. A pair of songs is right where, from the third bar of the second song on, a
bar's beats are told within a fifth of a beat of where they sound, with their counts, in a tempo within 4 %.
Prints one line of JSON.
"""
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
import time

STYLES = {"montuno": ("Salsa", 180), "maqsum": ("Belly Dance", 110), "four-on-the-floor": ("House", 124),
          "backbeat": ("Rock", 130), "boom-bap": ("Hip-Hop", 94), "oom-pah-pah": ("Waltz", 150)}
SONG_SECONDS = 11.0
CPUS = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
MPRIS = next((path for path in ("/usr/lib/mpv-mpris/mpris.so", "/etc/mpv/scripts/mpris.so") if os.path.exists(path)), "")


class Stage:
    """A session bus, a sound server and a folder of their own; everything ends with it."""

    def __init__(self):
        self.folder = tempfile.mkdtemp()
        self.programs = []
        self.environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for name in ("XDG_RUNTIME_DIR", "HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_STATE_HOME", "PULSE_RUNTIME_PATH"):
            self.environment[name] = self.folder
        self.environment.update(DBUS_SESSION_BUS_ADDRESS=f"unix:path={self.folder}/bus",
                                PULSE_SERVER=f"unix:{self.folder}/native", JACK_NO_START_SERVER="1")
        self.start(["dbus-daemon", "--session", "--nofork", f"--address=unix:path={self.folder}/bus"])
        self.start(["pulseaudio", "-n", "--daemonize=no", "--exit-idle-time=-1", "--use-pid-file=no", "--disable-shm=yes",
                    "-L", f"module-native-protocol-unix auth-anonymous=1 socket={self.folder}/native",
                    "-L", "module-null-sink sink_name=null rate=48000 channels=2"])
        self.wait_for(lambda: self.run(["pactl", "info"]).returncode == 0)

    def start(self, command, **how):
        program = subprocess.Popen(command, env=self.environment, **{**CPUS, **how})
        self.programs.append(program)
        return program

    def run(self, command):
        return subprocess.run(command, env=self.environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)

    @staticmethod
    def wait_for(is_so, seconds=20.0):
        end = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > end:
                raise RuntimeError("waited in vain")
            time.sleep(0.02)

    def end(self):
        for program in reversed(self.programs):
            program.kill()
            program.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


class Server:
    """A beat server and the moments that it told, each with when it is heard."""

    def __init__(self, stage, raks, more):
        self.told = []
        self.program = stage.start([raks, "live", "--no-avatar", "--lines", "-", *more], stdout=subprocess.PIPE, text=True)
        threading.Thread(target=self.hear, daemon=True).start()

    def hear(self):
        for line in self.program.stdout:
            said = json.loads(line)
            said["came"] = time.monotonic()
            said["at"] = said["came"] + said.get("in_ms", 0) / 1e3
            self.told.append(said)

    def cpu_seconds(self):
        with open(f"/proc/{self.program.pid}/stat", encoding="ascii") as stat:
            fields = stat.read().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Mpv:
    """mpv with its own door for questions, by which the place in the song is known."""

    def __init__(self, stage, songs, more=()):
        door = f"{stage.folder}/mpv"
        self.program = stage.start(["mpv", "--no-config", "--no-video", "--ao=pulse", "--audio-display=no",
                                    f"--scripts={MPRIS}", f"--input-ipc-server={door}", *more, *songs])
        stage.wait_for(lambda: os.path.exists(door))
        self.socket = socket.socket(socket.AF_UNIX)
        stage.wait_for(lambda: self.socket.connect_ex(door) == 0)
        self.lines = self.socket.makefile("r")

    def ask(self, name):
        try:
            self.socket.sendall(json.dumps({"command": ["get_property", name], "request_id": 1}).encode() + b"\n")
            for line in self.lines:
                answer = json.loads(line)
                if "error" in answer:
                    return answer.get("data")
        except OSError:
            pass  # it has ended
        return None

    def watch(self, starts):
        """Notes when each song's first sample is heard, as often as mpv knows it."""
        while self.program.poll() is None:
            number, place = self.ask("playlist-pos"), self.ask("audio-pts")
            now = time.monotonic()
            if number is not None and number >= 0 and place is not None and self.ask("playlist-pos") == number and place > 0.3:
                starts.setdefault(number, []).append(now - place)
            time.sleep(0.05)


def write_song(raks, folder, number, draw, seconds=SONG_SECONDS):
    style = draw.choice(sorted(STYLES))
    genre, usual = STYLES[style]
    bpm = round(usual * draw.uniform(0.88, 1.12), 1)
    base = f"{folder}/{number}"
    subprocess.run([raks, "synth", style, "--bpm", str(bpm), "--seed", str(draw.randrange(10**6)), "--duration", str(seconds),
                    "--beats", base + ".beats", "-o", base + ".wav"], check=True, **CPUS)
    subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", base + ".wav", "-metadata", f"title=Song {number}",
                    "-metadata", "artist=Raks", "-metadata", f"genre={genre}", base + ".flac"], check=True, **CPUS)
    with open(base + ".beats", encoding="ascii") as lines:
        beats = [(float(words[0]), int(words[1])) for words in (line.split() for line in lines) if len(words) > 1]
    return {"file": base + ".flac", "style": style, "bpm": bpm, "beats": beats}


def is_right(song, start, told):
    """Whether some bar within the third and fourth is told: by then the first two have been heard."""
    period = 60 / song["bpm"]
    bars = max(count for _, count in song["beats"])
    firsts = [i for i, (_, count) in enumerate(song["beats"]) if count == 1]
    first = firsts[2]
    for when, count in song["beats"][first:first + bars]:
        near = [beat for beat in told if abs(beat["at"] - start - when) < 0.2 * period]
        if not near or near[0]["count"] != count or abs(near[0]["bpm"] / song["bpm"] - 1) > 0.04:
            return False
    return True


def pairs(raks, number, seed):
    draw = random.Random(seed)
    stage = Stage()
    try:
        songs = [write_song(raks, stage.folder, i, draw) for i in range(number + 1)]
        servers = {"mpris": Server(stage, raks, ["--now-playing"]), "ears": Server(stage, raks, ["--no-now-playing"])}
        time.sleep(1.0)
        begun = time.monotonic()
        spent = {name: server.cpu_seconds() for name, server in servers.items()}
        starts = {}
        Mpv(stage, [song["file"] for song in songs]).watch(starts)
        took = time.monotonic() - begun
        spent = {name: server.cpu_seconds() - spent[name] for name, server in servers.items()}
        result = {"pairs": number, "seed": seed}
        for name, server in servers.items():
            beats = [said for said in server.told if said["do"] == "beat"]
            right = [is_right(songs[i], sorted(starts[i])[len(starts[i]) // 2], beats) for i in range(1, number + 1) if i in starts]
            result[name] = {"right": sum(right), "of": len(right), "wrong": [
                f"{songs[i + 1]['style']} {songs[i + 1]['bpm']}" for i, is_it in enumerate(right) if not is_it],
                "core_percent": round(100 * spent[name] / took, 2)}
        told = {said["title"]: said["came"] for said in servers["mpris"].told if said["do"] == "now"}
        late = sorted(1e3 * (told[f"Song {i}"] - sorted(starts[i])[len(starts[i]) // 2])
                      for i in range(1, number + 1) if i in starts and f"Song {i}" in told)
        result["now_after_ms"] = [round(late[0]), round(late[len(late) // 2]), round(late[-1])] if late else []
        return result
    finally:
        stage.end()


def hands(raks):
    stage = Stage()
    try:
        draw = random.Random(1)
        songs = [write_song(raks, stage.folder, i, draw, 40.0) for i in range(2)]
        server = Server(stage, raks, ["--now-playing"])
        time.sleep(1.0)
        Mpv(stage, [song["file"] for song in songs])

        def said(word, since):
            return [line for line in server.told if line["do"] == word and line["came"] > since]

        def does(command, word):
            """How long after the command of playerctl it is told, in ms."""
            now = time.monotonic()
            stage.run(["playerctl", *command])
            stage.wait_for(lambda: said(word, now), 10.0)
            return round(1e3 * (said(word, now)[0]["came"] - now))

        stage.wait_for(lambda: len(said("beat", 0)) > 8)
        result = {"titles": None, "pause": does(["pause"], "stop"), "play": does(["play"], "entry")}
        stage.wait_for(lambda: said("beat", time.monotonic() - 0.5), 10.0)
        stage.run(["playerctl", "position", "10+"])
        time.sleep(2.0)
        result["next"] = does(["next"], "now")
        stage.wait_for(lambda: said("beat", time.monotonic() - 0.5), 10.0)
        # mpv names a file by its own name until it has read its tags.
        stage.wait_for(lambda: said("now", 0)[-1]["title"] == "Song 1", 10.0)
        result["titles"] = [line["title"] for line in said("now", 0)]
        stage.run(["playerctl", "stop"])
        return result
    finally:
        stage.end()


def main():
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    raks, what = sys.argv[1:3]
    seed = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    print(json.dumps(hands(raks) if what == "hands" else pairs(raks, int(what), seed)))


main()

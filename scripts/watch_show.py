#!/usr/bin/env python3
"""Measures what a running show costs: processor time of each thread, and how its memory grows.

    scripts/watch_show.py [--after 8] SECONDS COMMAND...
    scripts/watch_show.py 60 build/release/bin/raks play song.wav --repeat --video-out pipewire

Starts the command, waits until it has settled, watches it for so many seconds and ends it with
Ctrl+C. Prints the milliseconds of processor time a second by the names of the threads, and the
slope of the resident memory by least squares. Needs Linux and Python 3.9, nothing else."""

import argparse
import collections
import pathlib
import signal
import subprocess
import sys
import time


def thread_seconds(pid):
    """Seconds of processor time by the names of the threads."""
    seconds = collections.Counter()
    for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
        try:
            name = (task / "comm").read_text().strip()
            seconds[name] += int((task / "schedstat").read_text().split()[0]) / 1e9
        except OSError:  # The thread ended meanwhile.
            pass
    return seconds


def resident_megabytes(pid):
    pages = int(pathlib.Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * 4096 / 1e6


def slope_an_hour(samples):
    """Least squares of (seconds, megabytes)."""
    mean_x = sum(x for x, _ in samples) / len(samples)
    mean_y = sum(y for _, y in samples) / len(samples)
    spread = sum((x - mean_x) ** 2 for x, _ in samples)
    return 3600 * sum((x - mean_x) * (y - mean_y) for x, y in samples) / spread if spread else 0.0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--after", type=float, default=8, help="seconds until it has settled")
    parser.add_argument("seconds", type=float)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    if not arguments.command:
        parser.error("no command")
    show = subprocess.Popen(arguments.command)
    time.sleep(arguments.after)
    memory = []
    begin = time.monotonic()
    try:
        before = thread_seconds(show.pid)
        while (passed := time.monotonic() - begin) < arguments.seconds and show.poll() is None:
            memory.append((passed, resident_megabytes(show.pid)))
            time.sleep(min(10, max(0.1, arguments.seconds - passed)))
        spent = thread_seconds(show.pid) - before
    except OSError:
        sys.exit("the command ended before it was watched to the end")
    passed = time.monotonic() - begin
    show.send_signal(signal.SIGINT)
    code = show.wait()
    print(f"{passed:.1f} s, {1e3 * sum(spent.values()) / passed:.0f} ms a second in all")
    for name, seconds in spent.most_common():
        if seconds > 0.0005 * passed:
            print(f"  {name:16} {1e3 * seconds / passed:7.2f}")
    print(f"memory {memory[-1][1]:.1f} MB, {slope_an_hour(memory):+.2f} MB an hour; exit code {code}")


if __name__ == "__main__":
    main()

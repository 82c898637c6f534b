"""A light of WLED without the light: reads Sound Sync packets and prints one line of JSON.

Usage: wled_light.py PORT SECONDS
"""
import json
import socket
import struct
import sys
import time

receiver = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
receiver.bind(("127.0.0.1", int(sys.argv[1])))
receiver.settimeout(0.1)
print("ready", flush=True)
packets, wrong, peaks, loudest, was_peak = 0, 0, 0, 0, False
end = time.monotonic() + float(sys.argv[2])
while time.monotonic() < end:
    try:
        packet = receiver.recv(1024)
    except TimeoutError:
        continue
    packets += 1
    try:
        header, _, raw, smooth, peak, _, bands, _, magnitude, hertz = struct.unpack("<6s2sffBB16sHff", packet)
        is_sound = header == b"00002\0" and 0 <= raw <= 255 and 0 <= smooth <= 255 and peak in (0, 1)
        wrong += not (is_sound and magnitude >= 0 and 0 <= hertz < 16000)
        loudest = max(loudest, *bands)
        peaks += peak == 1 and not was_peak
        was_peak = peak == 1
    except struct.error:
        wrong += 1
print(json.dumps({"packets": packets, "wrong": wrong, "peaks": peaks, "loudest": loudest}), flush=True)

# SPDX-License-Identifier: BSD-3-Clause
"""Writes a tile of made lidar in the order of the scan, as .laz or .las: laz_tile.py FORMAT POINTS OUTPUT [SEED]

An aeroplane flies strips 500 m wide, with its scanner going from side to side. A pulse has 1 to 5 returns: those above
the last one are in trees, which stand on rolling ground. Coordinates are whole centimetres or, in formats from 6 on,
millimetres. Needs laspy with lazrs for .laz.
"""
import pathlib
import sys

import laspy
import numpy as np

PULSES_A_SECOND, SCANS_A_SECOND, SPEED, WIDTH = 300_000, 100, 60.0, 500.0
BLOCK = 1 << 19  # pulses
CLASSES = {"ground": 2, "low": 3, "medium": 4, "high": 5}


def ground(x, y):
    return 300 + 25 * np.sin(x / 310) * np.cos(y / 270) + 4 * np.sin(x / 37 + y / 51)


def pulses(first, count, strip_pulses, random):
    """x, y and time of pulses, numbered along all strips; the flight's direction; the scan's angle in degrees."""
    number = np.arange(first, first + count)
    strip, along = np.divmod(number, strip_pulses)
    seconds = along / PULSES_A_SECOND
    phase = (seconds * SCANS_A_SECOND) % 1
    side = np.where(phase < 0.5, 4 * phase - 1, 3 - 4 * phase)  # from -1 to 1 and back
    distance = np.where(strip % 2 == 0, seconds, strip_pulses / PULSES_A_SECOND - seconds) * SPEED
    x = strip * WIDTH * 0.8 + (side + 1) * WIDTH / 2 + random.normal(0, 0.02, count)
    y = distance + random.normal(0, 0.02, count)
    return x, y, seconds + strip * 600 + 3.2e8, phase < 0.5, side * 20, strip


def returns_of(x, y, random):
    """The number of returns of each pulse: more among trees."""
    trees = np.sin(x / 61) * np.sin(y / 73) + 0.3 * np.sin(x / 7) * np.sin(y / 5)
    most = np.where(trees > 0.25, random.integers(1, 6, len(x)), 1)
    return np.where(random.random(len(x)) < 0.02, 2, most), trees


def points_of(header, first, count, strip_pulses, random):
    x, y, time, forward, angle, strip = pulses(first, count, strip_pulses, random)
    total, trees = returns_of(x, y, random)
    pulse = np.repeat(np.arange(count), total)
    number = np.arange(len(pulse)) - np.repeat(np.cumsum(total) - total, total) + 1
    above = (total[pulse] - number) * random.gamma(3, 1.2, len(pulse)) * (0.5 + np.clip(trees[pulse], 0, 1))
    record = laspy.ScaleAwarePointRecord.zeros(len(pulse), header=header)
    lean = above * np.tan(np.radians(angle[pulse])) * -1
    record.x, record.y = x[pulse] + lean, y[pulse]
    record.z = ground(x, y)[pulse] + above + random.normal(0, 0.03, len(pulse))
    record.intensity = np.clip(random.normal(900, 250, len(pulse)) / total[pulse], 0, 65535).astype(np.uint16)
    record.return_number, record.number_of_returns = number, total[pulse]
    height = np.digitize(above, [0.2, 1, 3])
    record.classification = np.array(list(CLASSES.values()), np.uint8)[height]
    record.gps_time = time[pulse]
    record.scan_direction_flag = forward[pulse]
    if header.point_format.id >= 6:
        record.scan_angle = np.round(angle[pulse] / 0.006).astype(np.int16)
    else:
        record.scan_angle_rank = np.round(angle[pulse]).astype(np.int8)
    record.point_source_id = strip[pulse] + 1
    if "red" in header.point_format.dimension_names:
        for i, name in enumerate(("red", "green", "blue")):
            record[name] = np.clip(20000 + 9000 * height + 3000 * i + random.normal(0, 2500, len(pulse)), 0, 65535)
    return record


def main():
    number, points, output = int(sys.argv[1]), int(sys.argv[2]), pathlib.Path(sys.argv[3])
    random = np.random.default_rng(int(sys.argv[4]) if len(sys.argv) > 4 else 1)
    header = laspy.LasHeader(version="1.4" if number >= 6 else "1.2", point_format=number)
    header.scales = [0.001] * 3 if number >= 6 else [0.01] * 3
    header.offsets = [0.0, 0.0, 0.0]
    # Strips whose tile is about square: strips * 0.8 * WIDTH = SPEED * seconds of a strip.
    seconds = points / 1.6 / PULSES_A_SECOND
    strips = max(1, round((seconds * SPEED / (0.8 * WIDTH)) ** 0.5))
    strip_pulses = int(seconds / strips * PULSES_A_SECOND) + 1
    unfinished = output.with_suffix(".unfinished" + output.suffix)
    left, first = points, 0
    with laspy.open(unfinished, "w", header=header, laz_backend=laspy.LazBackend.LazrsParallel) as writer:
        while left > 0:
            record = points_of(header, first, BLOCK, strip_pulses, random)[:left]
            writer.write_points(record)
            left -= len(record)
            first += BLOCK
    unfinished.rename(output)


if __name__ == "__main__":
    main()

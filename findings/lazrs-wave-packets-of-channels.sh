#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# lazrs 0.8.2, the decoder that laspy takes first, does not give back the wave packets of LAZ files of point formats 9
# and 10 if the points have several scanner channels: of 1,000 points that it wrote itself, it reads 997 (two channels)
# or 995 (four) with another offset into the waveform data and another location. One channel is right, and so is all
# that LASzip writes and reads. Expected: the values that were written, as LAZ is lossless.
# Consequence: waveforms of multi-channel scanners are looked up at wrong places, without an error or a warning.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" -q install laspy==2.7.0 lazrs==0.8.2 laszip==0.3.0 numpy==2.2.6
"$folder/venv/bin/python" - <<'PYTHON' | tee "$folder/seen"
import importlib.metadata
import io

import laspy
import numpy

COUNT = 1000


def made(point_format, channels):
    header = laspy.LasHeader(version="1.4", point_format=point_format)
    header.scales = [0.01, 0.01, 0.01]
    las = laspy.LasData(header)
    number = numpy.arange(COUNT)
    las.x = las.y = las.z = number * 0.1
    las.return_number = las.number_of_returns = numpy.ones(COUNT, int)
    las.scanner_channel = number % channels
    las.wavepacket_index = numpy.ones(COUNT, int)
    las.wavepacket_offset = 60 + 200 * number
    las.wavepacket_size = numpy.full(COUNT, 200)
    las.return_point_wave_location = number.astype(numpy.float32)
    return las


def changed(las, backend):
    file = io.BytesIO()
    las.write(file, do_compress=True, laz_backend=backend)
    file.seek(0)
    back = laspy.read(file, laz_backend=backend)
    differences = {}
    for name in las.point_format.dimension_names:
        count = int((numpy.asarray(las[name]) != numpy.asarray(back[name])).sum())
        if count:
            differences[name] = count
    return differences


print(*(f"{name} {importlib.metadata.version(name)}" for name in ("laspy", "lazrs", "laszip")))
for backend in (laspy.LazBackend.Lazrs, laspy.LazBackend.Laszip):
    for point_format in (9, 10):
        for channels in (1, 2, 4):
            found = changed(made(point_format, channels), backend)
            print(f"{backend.name}, format {point_format}, {channels} channels: {found or 'as written'}")
PYTHON
cat > "$folder/expected" <<'TEXT'
laspy 2.7.0 lazrs 0.8.2 laszip 0.3.0
Lazrs, format 9, 1 channels: as written
Lazrs, format 9, 2 channels: {'wavepacket_offset': 997, 'return_point_wave_location': 997}
Lazrs, format 9, 4 channels: {'wavepacket_offset': 995, 'return_point_wave_location': 995}
Lazrs, format 10, 1 channels: as written
Lazrs, format 10, 2 channels: {'wavepacket_offset': 997, 'return_point_wave_location': 997}
Lazrs, format 10, 4 channels: {'wavepacket_offset': 995, 'return_point_wave_location': 995}
Laszip, format 9, 1 channels: as written
Laszip, format 9, 2 channels: as written
Laszip, format 9, 4 channels: as written
Laszip, format 10, 1 channels: as written
Laszip, format 10, 2 channels: as written
Laszip, format 10, 4 channels: as written
TEXT
diff "$folder/expected" "$folder/seen" && echo "As described."

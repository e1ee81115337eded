# SPDX-License-Identifier: BSD-3-Clause
# usecases
#   Makes grids from scattered points and from a mesh, compared with scipy, gdal_grid, VTK and matplotlib
#   if these are installed (python3-scipy, gdal-bin, python3-matplotlib), with the data of
#   Documentation/UseCases.md.
[ $# -eq 0 ] || usage
[ -d "$data" ] || {
  echo "benchmark.sh: there is no $data; name the data by TIPP_SHARED_DATA." >&2
  exit 1
}
sh Utilities/build.sh default --target tipp --target tipp_python
/usr/bin/python3 - "$data" "$inputs" << 'EOF'
import lzma, sys
import numpy as np
data, inputs = sys.argv[1:]
np.save(inputs + "/autzen-xyz.npy", np.loadtxt(data + "/lidar/autzen_trim.xyz")[:, :3])
with lzma.open(data + "/points/osborne-magnetic.csv.xz", "rt") as file:
    names = file.readline().strip().split(",")
    columns = [names.index(name) for name in ("longitude", "latitude", "total_field_anomaly_nt")]
    np.save(inputs + "/osborne-xyz.npy", np.loadtxt(file, delimiter=",", usecols=columns))
EOF
[ -d "$inputs/surge" ] || build/bin/tipp flatten "$data/adcirc/ec95d/ec95d.grd" -o "$inputs/surge" \
  --values "$data/adcirc/ec95d/maxele.63"
PYTHONPATH="$top/build/lib/python3/dist-packages" /usr/bin/python3 Testing/Benchmarks/use_cases.py \
  build/bin/tipp "autzen=$inputs/autzen-xyz.npy:1000" "osborne=$inputs/osborne-xyz.npy:2000" \
  "surge=$inputs/surge:2000"

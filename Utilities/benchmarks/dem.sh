# SPDX-License-Identifier: BSD-3-Clause
# dem [--tile N] [--points N] [--memory M] [--repeat R] [--slow]
#   --tile N    points of a synthetic lidar tile, copies with jitter of the data's (15000000), made a
#               raster of 1.5 pixels a point beside gdal_grid, startinpy and scipy, as far as they are
#               installed for $TIPP_PEERS_PYTHON (/usr/bin/python3), with laspy and rasterio
#   --points N  of LAS files for a run with --memory (20000000), beside `tipp delaunay --sink count`
#   --memory M  of that run (512M)
#   --repeat R  runs of each of ours; the fastest counts (2)
#   --slow      gdal_grid and scipy, too, which take minutes
tile=15000000
points=20000000
memory=512M
repeat=2
slow=

while [ $# -gt 0 ]; do
  case $1 in
    --slow) slow=--slow; shift; continue ;;
  esac
  [ $# -gt 1 ] || usage
  case $1 in
    --tile) tile=$2 ;;
    --points) points=$2 ;;
    --memory) memory=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done
[ -d "$data" ] || {
  echo "benchmark.sh: there is no $data; name the data by TIPP_SHARED_DATA." >&2
  exit 1
}

build_targets tipp
export OMP_NUM_THREADS=2
"${TIPP_PEERS_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/dem_peers.py "$build/bin/tipp" \
  "$data/lidar/autzen_trim.las" "$inputs" --tile "$tile" --points "$points" --memory "$memory" \
  --repeat "$repeat" $slow

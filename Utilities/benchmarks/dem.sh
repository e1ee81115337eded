# SPDX-License-Identifier: BSD-3-Clause
# dem [--part PART]... [--tile N] [--small N] [--large N] [--repeat R]
#   --part PART  peers, read, same or large; without: all four (more than once)
#                peers: a synthetic lidar tile, copies with jitter of the data's, made a raster of 1.5 pixels a point
#                       beside startinpy, gdal_grid and scipy, as far as they are installed for $TIPP_PEERS_PYTHON
#                       (/usr/bin/python3), with laspy and rasterio, and on the PATH
#                read:  LAS files decoded, on one thread and on two
#                same:  LAS files in 128 MB: the same pixels as in 4 GB
#                large: LAS files in 512 MB, beside `tipp delaunay --sink count`
#   --tile N     points of the tile (15000000)
#   --small N    points of the same pixels (100000000)
#   --large N    points of the large run (500000000)
#   --repeat R   runs of each of ours on the tile; the fastest counts (2)
# The inputs are kept in $TIPP_DEM_INPUTS (the build's inputs), 20 bytes a point.
tile=15000000
small=100000000
large=500000000
repeat=2
parts=

while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || usage
  case $1 in
    --part) parts="$parts --part $2" ;;
    --tile) tile=$2 ;;
    --small) small=$2 ;;
    --large) large=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done
[ -d "$data" ] || {
  echo "benchmark.sh: there is no $data; name the data by TIPP_SHARED_DATA." >&2
  exit 1
}

build_targets tipp benchmarkIo
export OMP_NUM_THREADS=2
"${TIPP_PEERS_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/dem_peers.py "$build/bin" "$data/lidar/autzen_trim.las" \
  "${TIPP_DEM_INPUTS:-$inputs}" --tile "$tile" --small "$small" --large "$large" --repeat "$repeat" $parts

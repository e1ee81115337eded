# SPDX-License-Identifier: BSD-3-Clause
# dem [--part PART]... [--tile N] [--small N] [--large N] [--repeat R]
#   --part PART  peers, read, same or large; may be given several times (default: all four)
#                peers: a raster of 1.5 pixels per point from a synthetic lidar tile (jittered copies of the data's tile),
#                       compared with startinpy, gdal_grid and scipy, if they are installed for $TIPP_PEERS_PYTHON
#                       (/usr/bin/python3; also needs laspy and rasterio) or are on the PATH
#                read:  decoding of LAS files, with one thread and with two
#                same:  LAS files with 128 MB: must give the same pixels as with 4 GB
#                large: LAS files with 512 MB, compared with `tipp delaunay --sink count`
#   --tile N     points of the tile (15000000)
#   --small N    points of the same pixels (100000000)
#   --large N    points of the large run (500000000)
#   --repeat R   runs of each of our programs on the tile; the fastest counts (2)
# The inputs are kept in $TIPP_DEM_INPUTS (default: the build's folder for inputs), 20 bytes per point.
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

# SPDX-License-Identifier: BSD-3-Clause
# laz [--part PART]... [--tile N] [--large N] [--repeat R]
#   --part PART  decode, threads, peers or large; may be given several times (default: all four)
#                decode:  points per processor second, beside lazrs and LASzip, of a made tile of format 6 and one of 3
#                threads: the same, two threads beside one
#                peers:   from a tenth of the tile to a raster, beside laspy with startinpy or scipy, and rasterio
#                large:   a raster of as many pixels as points with 512 MB, from LAZ and from LAS: the tile side by side
#   --tile N     points of a tile (20000000)
#   --large N    points of the large run (500000000; 30 GB of disk)
#   --repeat R   runs of each program, by turns; the median counts (5)
# The inputs are kept in $TIPP_DEM_INPUTS (default: the build's folder for inputs). $TIPP_PEERS_PYTHON (/usr/bin/python3)
# needs laspy and lazrs; laszip, startinpy, scipy and rasterio are left out if they are not installed.
tile=20000000
large=500000000
repeat=5
parts=

while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || usage
  case $1 in
    --part) parts="$parts --part $2" ;;
    --tile) tile=$2 ;;
    --large) large=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done

build_targets tipp benchmarkIo
"${TIPP_PEERS_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/laz_peers.py "$build/bin" "${TIPP_DEM_INPUTS:-$inputs}" \
  --tile "$tile" --large "$large" --repeat "$repeat" $parts

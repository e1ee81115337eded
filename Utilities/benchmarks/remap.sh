# SPDX-License-Identifier: BSD-3-Clause
# remap [--triangles N] [--pixels N] [--repeat R]
#   --triangles N  triangles of each of two meshes (10000000)
#   --pixels N     pixels along each axis (4096)
#   --repeat R     runs of each; the fastest counts (3)
#   Also xugrid on a tenth of the triangles, in the interpreter that TIPP_XUGRID_PYTHON names (/usr/bin/python3)
triangles=10000000
pixels=4096
repeat=3

while [ $# -gt 0 ]; do
  case $1 in
    --triangles) [ $# -gt 1 ] || usage; triangles=$2; shift 2 ;;
    --pixels) [ $# -gt 1 ] || usage; pixels=$2; shift 2 ;;
    --repeat) [ $# -gt 1 ] || usage; repeat=$2; shift 2 ;;
    *) usage ;;
  esac
done

build_targets benchmarkRemap
"$build/bin/benchmarkRemap" "$triangles" "$pixels" "$repeat"
echo
"$build/bin/benchmarkRemap" "$((triangles / 10))" "$pixels" "$repeat"
"${TIPP_XUGRID_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/remap_peers.py "$((triangles / 10))"

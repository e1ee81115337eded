# SPDX-License-Identifier: BSD-3-Clause
# series [--side N] [--steps N] [--samples N]
#   --side N     nodes along each axis of the mesh (1000)
#   --steps N    time steps (100)
#   --samples N  samples along each axis (2048)
#   Needs netCDF4; compares with scipy, xugrid and VTK, in the interpreter that TIPP_XUGRID_PYTHON names
#   (/usr/bin/python3)
side=1000
steps=100
samples=2048

while [ $# -gt 0 ]; do
  case $1 in
    --side) [ $# -gt 1 ] || usage; side=$2; shift 2 ;;
    --steps) [ $# -gt 1 ] || usage; steps=$2; shift 2 ;;
    --samples) [ $# -gt 1 ] || usage; samples=$2; shift 2 ;;
    *) usage ;;
  esac
done

build_targets tipp
"${TIPP_XUGRID_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/series_peers.py \
  "$build/bin/tipp" "$inputs/series" "$side" "$steps" "$samples"

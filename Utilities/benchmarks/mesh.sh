# SPDX-License-Identifier: BSD-3-Clause
# mesh [--coast] [--angle A] [--area A]... [--slow-area A] [--repeat R] [FILE]
#   Refined meshes of the lines in FILE (the border of EC95d), beside Triangle, CGAL's Mesh_2 and Gmsh.
#   --coast        instead: a mesh of 36 million nodes for a model, with sizes from the shores and from a raster (6.5 GB)
#   --angle A      the smallest angle (30)
#   --area A       the largest area; may be given several times (0.002, 0.0004 and 0.0001: 0.6M, 3.2M and 13M triangles)
#   --slow-area A  the largest area of the meshes that CGAL and Gmsh make, too (0.02)
#   --repeat R     runs of each program, by turns; the fastest counts (5)
# $TIPP_PEERS_PYTHON (/usr/bin/python3) needs numpy; triangle and gmsh are left out if they are not installed.
file=$data/adcirc/ec95d/ec95d.grd
options=
coast=

while [ $# -gt 0 ]; do
  case $1 in
    --angle | --area | --slow-area | --repeat)
      [ $# -gt 1 ] || usage
      options="$options $1 $2"
      shift 2
      ;;
    --coast)
      coast=yes
      shift
      ;;
    -*) usage ;;
    *)
      file=$1
      shift
      ;;
  esac
done

if [ -n "$coast" ]; then
  build_targets tipp
  mkdir -p "$inputs/mesh"
  "${TIPP_PEERS_PYTHON:-/usr/bin/python3}" - "$inputs/mesh/sizes.csv" <<'PYTHON'
import sys
import numpy
x, y = numpy.meshgrid(numpy.arange(-99, -59, .1), numpy.arange(7, 47, .1))
size = .0029 + .006 * (1 + numpy.sin(x / 2) * numpy.cos(y / 3))
numpy.savetxt(sys.argv[1], numpy.c_[x.ravel(), y.ravel(), size.ravel()], delimiter=",", header="x,y,z", comments="")
PYTHON
  "$build/bin/tipp" dem "$inputs/mesh/sizes.csv" -o "$inputs/mesh/sizes.tif" --resolution 0.1
  start=$(date +%s)
  "$build/bin/tipp" mesh "$file" -o "$inputs/mesh/coast.14" --size "$inputs/mesh/sizes.tif" --min-size 0.0032 --dis 0.01 \
    --max-size 0.04 --g 0.1
  echo "$(($(date +%s) - start)) s in all"
  return 0
fi
build_targets benchmarkMesh
"${TIPP_PEERS_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/mesh_peers.py "$build/bin/benchmarkMesh" "$file" "$inputs/mesh" $options

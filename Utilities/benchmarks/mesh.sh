# SPDX-License-Identifier: BSD-3-Clause
# mesh [--angle A] [--area A]... [--slow-area A] [--repeat R] [FILE]
#   Refined meshes of the lines in FILE (the border of EC95d), beside Triangle, CGAL's Mesh_2 and Gmsh.
#   --angle A      the smallest angle (30)
#   --area A       the largest area; may be given several times (0.002, 0.0004 and 0.0001: 0.6M, 3.2M and 13M triangles)
#   --slow-area A  the largest area of the meshes that CGAL and Gmsh make, too (0.02)
#   --repeat R     runs of each program, by turns; the fastest counts (5)
# $TIPP_PEERS_PYTHON (/usr/bin/python3) needs numpy; triangle and gmsh are left out if they are not installed.
file=$data/adcirc/ec95d/ec95d.grd
options=

while [ $# -gt 0 ]; do
  case $1 in
    --angle | --area | --slow-area | --repeat)
      [ $# -gt 1 ] || usage
      options="$options $1 $2"
      shift 2
      ;;
    -*) usage ;;
    *)
      file=$1
      shift
      ;;
  esac
done

build_targets benchmarkMesh
"${TIPP_PEERS_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/mesh_peers.py "$build/bin/benchmarkMesh" "$file" "$inputs/mesh" $options

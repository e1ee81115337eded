# SPDX-License-Identifier: BSD-3-Clause
# delaunay3d [--repeat R] [--large]
#   --repeat R  runs of each; the fastest counts (3)
#   --large     also ten million points
repeat=3
large=no

while [ $# -gt 0 ]; do
  case $1 in
    --large) large=yes ;;
    --repeat)
      [ $# -gt 1 ] || usage
      repeat=$2
      shift
      ;;
    *) usage ;;
  esac
  shift
done

build_targets benchmarkDelaunay3D
row() { "$build/bin/benchmarkDelaunay3D" "$@" "$repeat"; }

row uniform 1e6
row clustered 1e6
row surface 1e6
row sphere 1e6
row lattice 2.2e6
row jittered 1e6
row body-centred 1e6
if [ "$large" = yes ]; then
  row uniform 1e7
fi

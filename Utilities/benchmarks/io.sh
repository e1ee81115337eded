# SPDX-License-Identifier: BSD-3-Clause
# io [--points N] [--repeat R]
#   --points N  of the mesh (5000000)
#   --repeat R  runs of each loader; the fastest counts (3; the LRU cache runs once)
points=5000000
repeat=3

while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || usage
  case $1 in
    --points) points=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done

build_targets benchmarkIo tipp
tipp=$build/bin/tipp

# Flat meshes, each made once; an unfinished one never counts as made.
make_mesh() { # NAME COMMAND-THAT-WRITES-POINTS...
  mesh=$inputs/$1-$points
  shift
  [ -d "$mesh" ] && return
  rm -rf "$inputs/unfinished"
  mkdir "$inputs/unfinished"
  "$@" "$inputs/unfinished/points.npy"
  "$tipp" delaunay "$inputs/unfinished/points.npy" -o "$inputs/unfinished/cells.npy"
  mv "$inputs/unfinished" "$mesh"
}
make_mesh random "$tipp" points --distribution uniform --count "$points" --seed 1 -o
make_mesh local /usr/bin/python3 Testing/Benchmarks/hilbert-order.py "$inputs/random-$points/points.npy"

echo "== Loading vertices: loaders over M and chunk size"
"$build/bin/benchmarkIo" loaders --repeat "$repeat" \
  "$inputs/random-$points" "$inputs/local-$points"

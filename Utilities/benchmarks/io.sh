# SPDX-License-Identifier: BSD-3-Clause
# io [--points N] [--repeat R]
#   --points N  points of the mesh (5000000)
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

# Makes a flat mesh unless it exists. An unfinished one has another name.
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

echo "== Classification of cells: OpenMP threads and OpenCL"
"$build/bin/benchmarkIo" classify --repeat "$repeat" "$inputs/random-$points"

mesh=$inputs/random-$points
vtu=$inputs/random-$points.vtu
[ -f "$vtu" ] || /usr/bin/python3 Testing/Benchmarks/flat-to-vtu.py "$mesh" "$vtu"

echo "== Partitioning 4x4, duplicated borrowers, 512 MB, 2 threads"
for run in $(seq "$repeat"); do
  "$tipp" partition "$mesh" -o "$inputs/copied.tipp" --tiling grid:4x4 --borrowers duplicate \
    --memory 512M --threads 2
done
sh Utilities/paraview.sh "$build/paraview"
PYTHONPATH="$build/paraview/python3-paraview/usr/lib/python3/dist-packages" \
  pvbatch Testing/Benchmarks/redistribute.py "$vtu" 16

echo "== Borrowed cells by reference and duplicated, 4x4"
"$tipp" partition "$mesh" -o "$inputs/lent.tipp" --tiling grid:4x4 --threads 2
"$build/bin/benchmarkIo" borrowing --repeat "$repeat" "$inputs/lent.tipp" "$inputs/copied.tipp"

echo "== Reading 16x16 pieces"
"$tipp" partition "$mesh" -o "$inputs/fine.tipp" --tiling grid:16x16 --threads 2
"$build/bin/benchmarkIo" reading --repeat "$repeat" "$vtu" "$inputs/fine.tipp"
rm -rf "$inputs/lent.tipp" "$inputs/copied.tipp" "$inputs/fine.tipp"

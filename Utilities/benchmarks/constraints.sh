# SPDX-License-Identifier: BSD-3-Clause
# constraints [--repeat R] [--large] [--part short|one|shores|vtk|out-of-core]
#   --repeat R  runs of each; the fastest counts (3)
#   --part P    only these rows
#   --large     also 500 million points and 5 million segments out of core; triangles are only counted, because the points
#               alone take 15 GB on disk
repeat=3
large=no
part=all

while [ $# -gt 0 ]; do
  case $1 in
    --large) large=yes ;;
    --repeat | --part)
      [ $# -gt 1 ] || usage
      [ "$1" = --part ] && part=$2 || repeat=$2
      shift
      ;;
    *) usage ;;
  esac
  shift
done
case $part in all | short | one | shores | vtk | out-of-core) ;; *) usage ;; esac
wants() { [ "$part" = all ] || [ "$part" = "$1" ]; }

build_targets benchmarkConstraints tipp
constraints() { "$build/bin/benchmarkConstraints" "$@"; }

if wants short; then
  echo "== Short segments among uniform points"
  constraints 1e6 124000 "$repeat"
  constraints 1e7 1e6 "$repeat"
fi
if wants one; then
  echo "== One segment across all"
  constraints 1e7 1 "$repeat"
fi
if wants shores; then
  echo "== Shorelines, all points on them"
  if [ ! -f "$inputs/shores.npy" ]; then
    /usr/bin/python3 Testing/Benchmarks/gshhg-to-npy.py \
      /usr/share/gmt-gshhg/binned_GSHHS_f.nc "$inputs/unfinished.npy" "$inputs/shore-edges.npy"
    mv "$inputs/unfinished.npy" "$inputs/shores.npy"
  fi
  constraints "$inputs/shores.npy" "$inputs/shore-edges.npy" "$repeat"
fi
if wants vtk; then
  echo "== vtkDelaunay2D"
  timeout 150 "$build/bin/benchmarkConstraints" 5000 200 1 vtk ||
    echo "vtkDelaunay2D gave no result in 150 s."
fi

# Each segment is in a cell of a square grid by itself, and is short compared to the cell.
make_segments() { # COUNT
  [ -f "$inputs/segments-$1.csv" ] && return
  /usr/bin/python3 - "$1" "$inputs/unfinished.csv" << 'END'
import sys
import numpy as np
count = int(sys.argv[1])
side = int(np.ceil(np.sqrt(count)))
cell = np.arange(count)
random = np.random.default_rng(1)
corner = np.column_stack([cell % side, cell // side])
ends = (np.hstack([corner, corner]) + 0.05 + 0.9 * random.random((count, 4))) / side
with open(sys.argv[2], "w") as file:
    file.write("x1,y1,x2,y2\n")
    for part in np.array_split(ends, 100):
        np.savetxt(file, part, fmt="%.17g", delimiter=",")
END
  mv "$inputs/unfinished.csv" "$inputs/segments-$1.csv"
}

out_of_core() { # POINTS SEGMENTS MEMORY
  make_segments "$2"
  for with in "" "--constraints $inputs/segments-$2.csv"; do
    for run in $(seq "$repeat"); do
      # shellcheck disable=SC2086 # no option, or two words
      "$build/bin/tipp" delaunay "uniform:$1" -o "$inputs/out.tipp" --sink count --memory "$3" \
        --threads 2 $with --stats "$inputs/run-$run.json" > /dev/null
    done
    /usr/bin/python3 Testing/Benchmarks/run_row.py "$1 points${with:+, $2 segments} in $3" \
      "$inputs"/run-*.json
    rm -f "$inputs"/run-*.json
  done
}
if wants out-of-core; then
  echo "== Out of core, counted"
  out_of_core 10000000 100000 256M
  if [ $large = yes ]; then
    repeat=1
    out_of_core 500000000 5000000 4G
  fi
fi

# SPDX-License-Identifier: BSD-3-Clause
# query [--points N] [--queries N] [--repeat R] [--rows NAME,...]
#   --points N  points of the mesh (5000000: 10 million triangles)
#   --queries N points at which the mesh is queried (10000000)
#   --repeat R  runs of each; the fastest counts (3)
#   --rows      the rows to measure (default: all but stored):
#               probe     scattered points, one thread, compared with vtkProbeFilter
#               order     points in rows, compared with resampling
#               rings     a million rings
#               contours  twice as many points, compared with vtkContourFilter
#               scipy     a hundredth of the points, one thread, compared with scipy's LinearNDInterpolator, in the
#                         interpreter that TIPP_SCIPY_PYTHON names (/usr/bin/python3)
#               ranks     tipp query, and rings of points in memory, on 1 to 8 ranks of one thread each
#               stored    a partitioned mesh of 200 million triangles in 256 MB; needs 25 GB of disk. It is made, and kept,
#                         in the folder that TIPP_QUERY_STORE names; without this, it is removed afterwards
points=5000000
queries=10000000
repeat=3
rows=probe,order,rings,contours,scipy,ranks

while [ $# -gt 0 ]; do
  case $1 in
    --points) [ $# -gt 1 ] || usage; points=$2; shift 2 ;;
    --queries) [ $# -gt 1 ] || usage; queries=$2; shift 2 ;;
    --repeat) [ $# -gt 1 ] || usage; repeat=$2; shift 2 ;;
    --rows) [ $# -gt 1 ] || usage; rows=$2; shift 2 ;;
    *) usage ;;
  esac
done

for name in $(echo "$rows" | tr , " "); do
  case $name in
    probe | order | rings | contours | scipy | ranks | stored) ;;
    *) usage ;;
  esac
done

# Writes points of a smooth surface, as rows of x, y and z: surface_points COUNT FILE
surface_points() {
  /usr/bin/python3 - "$1" "$2" <<'PYTHON'
import sys
import numpy as np

count, path = int(sys.argv[1]), sys.argv[2]
rng = np.random.default_rng(1)
table = np.lib.format.open_memmap(path, "w+", np.float64, (count, 3))
for first in range(0, count, 1_000_000):
    xy = rng.random((min(1_000_000, count - first), 2))
    table[first:first + len(xy), :2] = xy
    table[first:first + len(xy), 2] = np.sin(9 * xy[:, 0]) * np.cos(7 * xy[:, 1])
PYTHON
}

# Prints the least wall-clock and processor seconds of $repeat runs of a command with its children: timed COMMAND...
timed() {
  /usr/bin/python3 - "$repeat" "$@" <<'PYTHON'
import os
import subprocess
import sys
import time

walls, processors = [], []
for _ in range(int(sys.argv[1])):
    begin, before = time.perf_counter(), os.times()
    subprocess.run(sys.argv[2:], check=True, stdout=subprocess.DEVNULL)
    after = os.times()
    walls.append(time.perf_counter() - begin)
    processors.append(after.children_user - before.children_user + after.children_system - before.children_system)
print(f"{min(walls):.2f} s | {min(processors):.2f} s |")
PYTHON
}

build_targets benchmarkQuery tipp
for name in $(echo "$rows" | tr , " "); do
  echo
  case $name in
    probe) OMP_NUM_THREADS=1 "$build/bin/benchmarkQuery" probe "$points" "$queries" "$repeat" ;;
    order) "$build/bin/benchmarkQuery" order "$points" "$queries" "$repeat" ;;
    rings) OMP_NUM_THREADS=1 "$build/bin/benchmarkQuery" rings "$points" 1000000 "$repeat" ;;
    contours) "$build/bin/benchmarkQuery" contours "$((2 * points))" "$repeat" ;;
    scipy)
      sh Utilities/build.sh default --target tipp_python > /dev/null
      PYTHONPATH="$top/build/lib/python3/dist-packages" OMP_NUM_THREADS=1 \
        "${TIPP_SCIPY_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/query_scipy.py "$points" "$queries"
      ;;
    ranks)
      mkdir -p "$inputs/query-ranks"
      surface_points "$points" "$inputs/query-ranks/points.npy"
      "$build/bin/tipp" delaunay "$inputs/query-ranks/points.npy" -o "$inputs/query-ranks/mesh.tipp" --memory 256M
      "$build/bin/tipp" points --distribution uniform --count "$queries" --seed 2 -o "$inputs/query-ranks/asked.npy"
      echo
      echo "| ranks | time | processor |"
      echo "|---|---|---|"
      for ranks in 1 2 4 8; do
        printf '| %s | ' "$ranks"
        OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 timed mpirun --oversubscribe --bind-to none \
          --mca mpi_yield_when_idle 1 -np "$ranks" "$build/bin/tipp" query "$inputs/query-ranks/asked.npy" \
          "$inputs/query-ranks/mesh.tipp" -o "$inputs/query-ranks/values.npy" --threads 1
      done
      rm -rf "$inputs/query-ranks"
      echo
      echo "| ranks | what | time | processor | found |"
      echo "|---|---|---|---|---|"
      for ranks in 1 2 4 8; do
        OMP_NUM_THREADS=1 mpirun --allow-run-as-root --oversubscribe --bind-to none --mca mpi_yield_when_idle 1 \
          -np "$ranks" "$build/bin/benchmarkQuery" rank-rings "$points" 1000000 "$repeat"
      done
      ;;
    stored)
      store=${TIPP_QUERY_STORE:-$inputs/query}
      mkdir -p "$store"
      if [ ! -f "$store/mesh.tipp/index.json" ]; then
        surface_points 100000000 "$store/points.npy"
        "$build/bin/tipp" delaunay "$store/points.npy" -o "$store/mesh.tipp" --memory 1G
        rm "$store/points.npy"
      fi
      cat "$store"/mesh.tipp/pieces/* > /dev/null # read from the system's cache below
      "$build/bin/benchmarkQuery" stored "$store/mesh.tipp" 1000000 256
      "$build/bin/benchmarkQuery" stored-contours "$store/mesh.tipp" 256
      [ -n "${TIPP_QUERY_STORE:-}" ] || rm -rf "$store"
      ;;
  esac
done

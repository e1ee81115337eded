# SPDX-License-Identifier: BSD-3-Clause
# query [--points N] [--queries N] [--repeat R] [--rows NAME,...]
#   --points N  of the triangulation that is asked (5000000: 10 million triangles)
#   --queries N points to ask for (10000000)
#   --repeat R  runs of each; the fastest counts (3)
#   --rows      of memory (beside vtkProbeFilter, vtkContourFilter and resampling), stored (a partitioned mesh of 200
#               million triangles in 256 MB; needs 20 GB on the disk) and scipy (beside its LinearNDInterpolator; of
#               the interpreter that TIPP_SCIPY_PYTHON names, else /usr/bin/python3); memory,scipy
points=5000000
queries=10000000
repeat=3
rows=memory,scipy

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
    memory | stored | scipy) ;;
    *) usage ;;
  esac
done

build_targets benchmarkQuery tipp
case ,$rows, in
  *,memory,*) "$build/bin/benchmarkQuery" memory "$points" "$queries" "$repeat" peers ;;
esac
case ,$rows, in
  *,stored,*)
    mkdir -p "$inputs/query"
    "$build/bin/tipp" points --distribution uniform --count 100000000 --seed 1 -o "$inputs/query/points.npy"
    "$build/bin/tipp" delaunay "$inputs/query/points.npy" -o "$inputs/query/mesh.tipp" --memory 1G
    rm "$inputs/query/points.npy"
    echo
    "$build/bin/benchmarkQuery" stored "$inputs/query/mesh.tipp" 1000000 256
    rm -rf "$inputs/query"
    ;;
esac
case ,$rows, in
  *,scipy,*)
    sh Utilities/build.sh default --target tipp_python > /dev/null
    echo
    PYTHONPATH="$top/build/lib/python3/dist-packages" OMP_NUM_THREADS=1 \
      "${TIPP_SCIPY_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/query_scipy.py "$points" "$queries"
    ;;
esac

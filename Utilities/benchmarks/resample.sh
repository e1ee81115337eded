# SPDX-License-Identifier: BSD-3-Clause
# resample [--repeat R] [--opencl] [--rows NAME,...]
#   --repeat R  runs of each; the fastest counts (3)
#   --opencl    also the first OpenCL device
#   --rows      the rows to measure (default: all): probe (compared with vtkProbeFilter), stored (a partitioned mesh
#               compared with a .vtu), scipy (compared with scipy's LinearNDInterpolator, in the interpreter that
#               TIPP_SCIPY_PYTHON names, /usr/bin/python3) and partitions (a table of numbers of partitions and samples)
repeat=3
opencl=
rows=probe,stored,scipy,partitions

while [ $# -gt 0 ]; do
  case $1 in
    --repeat) [ $# -gt 1 ] || usage; repeat=$2; shift 2 ;;
    --opencl) opencl=opencl; shift ;;
    --rows) [ $# -gt 1 ] || usage; rows=$2; shift 2 ;;
    *) usage ;;
  esac
done

for name in $(echo "$rows" | tr , " "); do
  case $name in
    probe | stored | scipy | partitions) ;;
    *) usage ;;
  esac
done

build_targets benchmarkResample
row() { # CASE POINTS SAMPLES FRACTION
  "$build/bin/benchmarkResample" "$1" "$2" "$3" "$repeat" "$4" $opencl
}

echo "| case | threads, ours and VTK's | ours | vtkProbeFilter | ratio | samples hit, ours and VTK's | memory |"
echo "|---|---|---|---|---|---|---|"
case ,$rows, in
  *,probe,*)
    row local 1000000 2048 1
    row uniform 1000000 2048 1
    row uniform 5000000 2048 1
    row clustered 1000000 2048 1
    row uniform 5000000 1024 0.01
    row tetrahedra 562000 64 1
    row tetrahedra 562000 256 1
    ;;
esac
case ,$rows, in
  *,stored,*)
    mkdir -p "$inputs/stored"
    "$build/bin/benchmarkResample" stored "$inputs/stored" 5000000 1024 "$repeat" 0.01
    rm -rf "$inputs/stored"
    ;;
esac
case ,$rows, in
  *,scipy,*)
    sh Utilities/build.sh default --target tipp_python > /dev/null
    echo
    PYTHONPATH="$top/build/lib/python3/dist-packages" OMP_NUM_THREADS=1 \
      "${TIPP_SCIPY_PYTHON:-/usr/bin/python3}" Testing/Benchmarks/resample_scipy.py 1000000 2048 "$repeat"
    ;;
esac
case ,$rows, in
  *,partitions,*)
    echo
    mkdir -p "$inputs/partitions"
    "$build/bin/benchmarkResample" partitions "$inputs/partitions" 5000000 "$repeat" 256 $opencl
    rm -rf "$inputs/partitions"
    ;;
esac

# SPDX-License-Identifier: BSD-3-Clause
# resample [--repeat R] [--opencl]
#   --repeat R  runs of each; the fastest counts (3)
#   --opencl    the first OpenCL device too
repeat=3
opencl=

while [ $# -gt 0 ]; do
  case $1 in
    --repeat) [ $# -gt 1 ] || usage; repeat=$2; shift 2 ;;
    --opencl) opencl=opencl; shift ;;
    *) usage ;;
  esac
done

build_targets benchmarkResample
row() { # CASE POINTS SAMPLES FRACTION
  "$build/bin/benchmarkResample" "$1" "$2" "$3" "$repeat" "$4" $opencl
}

echo "| case | threads, ours and VTK's | ours | vtkProbeFilter | ratio | samples hit, ours and VTK's | memory |"
echo "|---|---|---|---|---|---|---|"
row local 1000000 2048 1
row uniform 1000000 2048 1
row uniform 5000000 2048 1
row clustered 1000000 2048 1
row uniform 5000000 1024 0.01
row tetrahedra 562000 64 1
row tetrahedra 562000 256 1

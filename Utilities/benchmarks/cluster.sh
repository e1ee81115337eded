# SPDX-License-Identifier: BSD-3-Clause
# cluster [--points N] [--ranks R,R...]
#   --points N  points of each traced run (100000000); the costs of sending points to their owners are measured with a tenth
#   --ranks R   numbers of ranks that the model simulates (64,1024)
points=100000000
ranks=64,1024

while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || usage
  case $1 in
    --points) points=$2 ;;
    --ranks) ranks=$2 ;;
    *) usage ;;
  esac
  shift 2
done

build_targets benchmarkOrder tipp
tipp=$build/bin/tipp
mesh=$data/adcirc/ec95d/ec95d.grd

"$tipp" points --distribution uniform --count $((points / 10)) -o "$inputs/cluster.npy" > /dev/null
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
mpirun -np 1 "$tipp" delaunay "$inputs/cluster.npy" -o "$inputs/cluster-cells.npy" --threads 1 \
  --stats "$inputs/cluster.json" > /dev/null
for kind in uniform clustered ec95d; do
  case $kind in
    ec95d) [ -f "$mesh" ] || continue; "$tipp" points --like "$mesh" --count "$points" -o "$inputs/cluster.npy" ;;
    *) "$tipp" points --distribution $kind --count "$points" -o "$inputs/cluster.npy" ;;
  esac
  for count in $(echo "$ranks" | tr , " "); do
    "$build/bin/benchmarkOrder" "$inputs/cluster.npy" "$count" > "$inputs/cluster.trace"
    echo "== $kind, $count ranks"
    /usr/bin/python3 Testing/Benchmarks/cluster_model.py --costs "$inputs/cluster.json" --points 1e10 -- "$inputs/cluster.trace"
  done
done
rm -f "$inputs"/cluster.* "$inputs/cluster-cells.npy"

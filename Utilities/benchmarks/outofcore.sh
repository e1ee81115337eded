# SPDX-License-Identifier: BSD-3-Clause
# outofcore [--points N] [--memory M] [--repeat R] [--slow]
#   --points N  points of the large input (100000000); the small one has a tenth
#   --memory M  memory limit of the large input's run (512M)
#   --repeat R  runs of each; the fastest counts (2)
#   --slow      also 500 million points with 2G, and with 256M: a mesh is written if 60 GB are free, else triangles are counted
points=100000000
memory=512M
repeat=2
slow=no

while [ $# -gt 0 ]; do
  case $1 in
    --slow) slow=yes; shift; continue ;;
  esac
  [ $# -gt 1 ] || usage
  case $1 in
    --points) points=$2 ;;
    --memory) memory=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done

build_targets tipp
tipp=$build/bin/tipp
small=$((points / 10))

make_points() { # COUNT
  [ -f "$inputs/uniform-$1.npy" ] && return
  "$tipp" points --distribution uniform --count "$1" --seed 1 -o "$inputs/unfinished.npy"
  mv "$inputs/unfinished.npy" "$inputs/uniform-$1.npy"
}
make_points "$points"
make_points "$small"

run_all() { # NAME COMMAND...: the fastest run's figures
  title=$1
  shift
  for run in $(seq "$repeat"); do
    rm -rf "$inputs/out.tipp"
    "$@" --stats "$inputs/run-$run.json" > /dev/null
  done
  rm -rf "$inputs/out.tipp" "$inputs/out.npy"
  /usr/bin/python3 Testing/Benchmarks/run_row.py "$title" "$inputs"/run-*.json
  rm -f "$inputs"/run-*.json
}

echo "== The disk, writing 2 GB and waiting until they are safe"
dd if=/dev/zero of="$inputs/disk-speed" bs=16M count=128 conv=fsync 2>&1 | tail -n 1
rm -f "$inputs/disk-speed"

echo "== Uniform points, 2 threads"
run_all "in memory, $small" \
  "$tipp" delaunay "$inputs/uniform-$small.npy" -o "$inputs/out.npy" --threads 2
run_all "out of core, $small in $memory" \
  "$tipp" delaunay "$inputs/uniform-$small.npy" -o "$inputs/out.tipp" --memory "$memory" --threads 2
run_all "out of core, $points in $memory" \
  "$tipp" delaunay "$inputs/uniform-$points.npy" -o "$inputs/out.tipp" --memory "$memory" --threads 2
run_all "counted, $points in $memory" \
  "$tipp" delaunay "uniform:$points" -o "$inputs/out.tipp" --memory "$memory" --threads 2 --sink count

if [ "$slow" = yes ]; then
  repeat=1
  sink=count
  [ "$(df -Pk "$inputs" | awk 'NR == 2 { print $4 }')" -gt 60000000 ] && sink=mesh
  for memory in 2G 256M; do
    run_all "500000000 in $memory, sink $sink" \
      "$tipp" delaunay uniform:500000000 -o "$inputs/out.tipp" --memory "$memory" --threads 2 \
      --sink "$sink"
  done
fi

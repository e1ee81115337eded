# SPDX-License-Identifier: BSD-3-Clause
# delaunay [--slow] [--large] [--repeat R]
#   --slow   also vtkDelaunay2D on the million survey points (minutes)
#   --large  also 50 million points (about 8 GB)
survey=$data/points/osborne-magnetic.csv.xz
repeat=3
slow=no
large=no

while [ $# -gt 0 ]; do
  case $1 in
    --slow) slow=yes ;;
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

build_targets benchmarkDelaunay

# Makes an input unless it exists. An unfinished file has another name.
make_input() { # NAME COMMAND...
  name=$1
  shift
  [ -f "$inputs/$name.npy" ] && return
  "$@" "$inputs/unfinished.npy"
  mv "$inputs/unfinished.npy" "$inputs/$name.npy"
}
make_input coast /usr/bin/python3 Testing/Benchmarks/gshhg-to-npy.py \
  /usr/share/gmt-gshhg/binned_GSHHS_f.nc
if [ -f "$survey" ]; then
  make_input osborne /usr/bin/python3 Testing/Benchmarks/csv-to-npy.py "$survey"
else
  echo "benchmark.sh: no $survey: the survey points are left out; name the data by TIPP_SHARED_DATA." >&2
fi

run() { "$build/bin/benchmarkDelaunay" --repeat "$repeat" "$@"; }

echo "== Large inputs, points in memory to triangles in memory"
run --phases --peers cgal,filter --input uniform:1e7 --input clustered:1e7 --input "$inputs/coast.npy" \
  --input lattice:9e6
echo "== Further inputs"
run --input lattice-jittered:9e6 --input uniform:1e6
[ ! -f "$inputs/osborne.npy" ] || run --input "$inputs/osborne.npy"
echo "== Small inputs"
run --repeat 15 --input uniform:1e5 --input uniform:1e4
echo "== One box"
run --repeat 15 --threads 1 --partitions 1x1 --input uniform:1e4
echo "== Along a sweep line"
run --repeat 9 --threads 1 --peers kernel,sweep --input uniform:1e4 --input uniform:1e5 \
  --input uniform:1e6 --input clustered:1e6 --input lattice:1e6 --input "$inputs/coast.npy"
run --threads 1 --peers kernel,sweep --input uniform:1e7 --input lattice:9e6 --input one-far-away:3e4 \
  --input circle:3e5 --input parabola:3e5
echo "== Inputs that are hard on schedules and searches"
run --peers none --input collinear:1e6 --input collinear-and-one:1e6 --input circle:1e6 \
  --input spiral:1e6 --input parabola:1e6 --input two-clusters:1e6 --input one-far-away:1e6 \
  --input sorted:1e6
echo "== vtkDelaunay2D (whose triangles are others, which makes its run fail)"
run --repeat 1 --peers cgal,vtk --input uniform:1e5 || true
if [ $slow = yes ] && [ -f "$inputs/osborne.npy" ]; then
  run --repeat 1 --peers cgal,vtk --input "$inputs/osborne.npy" || true
fi
if [ $large = yes ]; then
  echo "== Cost per point at 50 million"
  run --repeat 1 --peers none --input uniform:1e7 --input uniform:5e7
fi

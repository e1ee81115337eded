# SPDX-License-Identifier: BSD-3-Clause
# delaunay3d [--repeat R] [--large]
#   --repeat R  runs of each; the fastest counts (3)
#   --large     also ten million points
# Compares with CGAL, TetGen and VTK's vtkDelaunay3D; also with that of another VTK if TIPP_VTK_PYTHON names a Python
# interpreter that has it (pip install vtk). At the end, one and two ranks of one thread each.
repeat=3
large=no

while [ $# -gt 0 ]; do
  case $1 in
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

build_targets benchmarkDelaunay3D
row() { "$build/bin/benchmarkDelaunay3D" "$@" "$repeat"; }

row uniform 1e6
row clustered 1e6
row surface 1e6
row sphere 1e6
row lattice 2.2e6
row jittered 1e6
row body-centred 1e6
if [ "$large" = yes ]; then
  row uniform 1e7
fi
row uniform 1e5
if [ -n "${TIPP_VTK_PYTHON:-}" ]; then
  "$TIPP_VTK_PYTHON" Testing/Benchmarks/delaunay3d_vtk.py 100000 "$repeat"
fi

build_targets tipp
work=$inputs/delaunay3d-ranks
mkdir -p "$work"
/usr/bin/python3 -c "import sys, numpy as np
np.save(sys.argv[1], np.random.default_rng(1).random((1000000, 3)))" "$work/points.npy"
for run in $(seq "$repeat"); do
  for ranks in 1 2; do
    OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 mpirun --oversubscribe --bind-to none \
      --mca mpi_yield_when_idle 1 -np "$ranks" "$build/bin/tipp" delaunay3d "$work/points.npy" -o "$work/mesh.npy" \
      --threads 1 --stats "$work/$ranks-$run.json" > /dev/null
  done
done
/usr/bin/python3 Testing/Benchmarks/delaunay3d_ranks.py "$work" "$repeat"
rm -rf "$work"

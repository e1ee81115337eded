# SPDX-License-Identifier: BSD-3-Clause
# python [--points N] [--repeat R]
#   The time that the Python package adds to the triangulation, in python3 and, if the plugin is built, in pvbatch
#   --points N  points (10000000)
#   --repeat R  runs of each, alternating; the fastest counts (5)
points=10000000
repeat=5

while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || usage
  case $1 in
    --points) points=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done

sh Utilities/build.sh default --target tipp_python
echo "== python3"
PYTHONPATH="$top/build/lib/python3/dist-packages" \
  /usr/bin/python3 Testing/Benchmarks/python_overhead.py "$points" "$repeat"
plugin=$(ls -d "$top"/build-paraview/lib/paraview-*/plugins/TIPPPlugin 2> /dev/null | tail -n 1)
if [ -d "$plugin/python/tipp" ]; then
  echo "== pvbatch"
  PYTHONPATH="$plugin/python:$top/build-paraview/debian/python3-paraview/usr/lib/python3/dist-packages" \
    xvfb-run -a pvbatch Testing/Benchmarks/python_overhead.py "$points" "$repeat"
else
  echo "== pvbatch: passed over, for the plugin is not built (sh Utilities/build.sh paraview)"
fi

# SPDX-License-Identifier: BSD-3-Clause
# wheel [--wheel FILE] [--folder FOLDER] [--python PYTHON] [--package FOLDER] [--points N] [--queries N] [--repeat R]
#   The Python wheel compared with scipy, VTK and PyVista from PyPI and with the Debian build, and the bounds that it must keep
#   --wheel FILE      made by sh Utilities/wheel.sh (wheels/tipp-*.whl)
#   --folder FOLDER   for the virtual environments, which are made if they are missing (build-wheel/figures)
#   --python PYTHON   3.11 or newer (python3)
#   --package FOLDER  the Debian build's Python package (build/lib/python3/dist-packages, which is built)
#   --points N        points of the triangulations (1000000)
#   --queries N       points to interpolate at (4000000)
#   --repeat R        runs of each; the fastest counts (5)
wheel=$(ls wheels/tipp-*.whl 2> /dev/null | tail -n 1)
environments=build-wheel/figures
python=python3
package=
points=1000000
queries=4000000
repeat=5

while [ $# -gt 0 ]; do
  [ $# -gt 1 ] || usage
  case $1 in
    --wheel) wheel=$2 ;;
    --folder) environments=$2 ;;
    --python) python=$2 ;;
    --package) package=$2 ;;
    --points) points=$2 ;;
    --queries) queries=$2 ;;
    --repeat) repeat=$2 ;;
    *) usage ;;
  esac
  shift 2
done
[ -f "$wheel" ] || {
  echo "There is no wheel '$wheel'; build it: sh Utilities/wheel.sh" >&2
  exit 1
}
wheel=$(realpath "$wheel")
mkdir -p "$environments"
environments=$(cd "$environments" && pwd)

if [ -z "$package" ]; then
  sh Utilities/build.sh default --target tipp_python
  package=$top/build/lib/python3/dist-packages
fi

# environment NAME PACKAGE...: makes a virtual environment with the packages and the wheel
environment() {
  name=$1
  shift
  [ -x "$environments/$name/bin/python" ] || "$python" -m venv "$environments/$name"
  "$environments/$name/bin/python" -m pip -q install "$@"
  "$environments/$name/bin/python" -m pip -q install --force-reinstall --no-deps "$wheel"
}

# Measures the time from nothing to a picture, with the display of the machine or a virtual one.
display=
[ -n "${DISPLAY:-}" ] || ! command -v xvfb-run > /dev/null || display="xvfb-run -a"
rm -rf "$environments/first"
begin=$(date +%s)
(
  "$python" -m venv "$environments/first"
  cd "$environments/first"
  bin/pip -q install --no-cache-dir "$wheel" 'vtk>=9.7,<9.8' pyvista
  $display bin/python "$top/Testing/Wheel/first_picture.py"
)
[ -s "$environments/first/picture.png" ]
seconds=$(($(date +%s) - begin))
printf '%-62s %28s  %-16s %s\n' "from an empty environment to the first picture" "$seconds s" "< 60 s" \
  "$([ $seconds -lt 60 ] && echo kept || echo MISSED)"
rm -rf "$environments/first"

environment alone numpy
environment peers 'vtk>=9.7,<9.8' pyvista scipy
"$environments/peers/bin/python" Testing/Wheel/figures.py "$wheel" "$environments/peers/bin/python" \
  "$environments/alone/bin/python" "$package" "$points" "$queries" "$repeat"

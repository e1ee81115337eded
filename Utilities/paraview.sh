#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Unpacks Debian's ParaView in a folder, for pvbatch and for building the plugin:
#   sh Utilities/paraview.sh FOLDER
# Installing Debian's python3-paraview would remove python3-vtk9, which this project is built with. So that package is
# unpacked into FOLDER/python3-paraview, and FOLDER/prefix is a tree of links that completes ParaView's CMake package.
# Use them as follows:
#   PYTHONPATH=FOLDER/python3-paraview/usr/lib/python3/dist-packages pvbatch SCRIPT.py
#   cmake -DParaView_DIR=FOLDER/prefix/usr/lib/ARCHITECTURE/cmake/paraview-VERSION ...
set -eu

[ $# -eq 1 ] || {
  sed -n '3,4s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
top=$(cd "$(dirname "$0")/.." && pwd)
sh "$top/Utilities/install-packages.sh"
mkdir -p "$1"
cd "$1"
folder=$(pwd)
[ ! -f complete ] || exit 0
architecture=$(dpkg-architecture -q DEB_HOST_MULTIARCH)

rm -rf python3-paraview prefix download
mkdir download
(cd download && apt-get download -q python3-paraview)
dpkg -x download/python3-paraview_*.deb python3-paraview
rm -r download

# Links to the installed libraries and CMake packages, except VTK's own and those of python3-paraview.
libraries=prefix/usr/lib/$architecture
mkdir -p "$libraries/cmake" "$libraries/vtk/hierarchy" prefix/usr/lib/python3 prefix/usr/bin
ln -s /usr/include /usr/share prefix/usr/
ln -s /usr/bin/* prefix/usr/bin/
for path in "/usr/lib/$architecture"/*; do
  case ${path##*/} in
    cmake | vtk) ;;
    *) ln -s "$path" "$libraries/" ;;
  esac
done
for path in "/usr/lib/$architecture/cmake"/*; do
  case ${path##*/} in
    vtk-*) ;;
    # Copied, because a CMake package finds its prefix by its real path.
    paraview-*) cp -r "$path" "$libraries/cmake/" ;;
    *) ln -s "$path" "$libraries/cmake/" ;;
  esac
done
for root in "" "$folder/python3-paraview"; do
  for path in "$root/usr/lib/$architecture"/vtk/hierarchy/*; do
    [ ! -e "$path" ] || ln -sf "$path" "$libraries/vtk/hierarchy/"
  done
  for path in "$root/usr/bin"/*; do
    [ ! -e "$path" ] || ln -sf "$path" prefix/usr/bin/
  done
done
# Debian 13 names Python's modules after its Python; CMake's targets do not.
find python3-paraview -name '*.cpython-*.so' | while read -r module; do
  plain=${module%%.cpython-*}.so
  [ -e "$plain" ] || ln -s "${module##*/}" "$plain"
done
ln -s "$folder/python3-paraview/usr/lib/python3/dist-packages" prefix/usr/lib/python3/dist-packages
touch complete

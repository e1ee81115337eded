#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tries an installation on a bare Debian in FOLDER/root: sh Utilities/clean-root.sh RELEASE FOLDER WHAT
#   demo      the README's first command, on the last commit, timed
#   test      the README's second command, on the last commit, timed
#   packages  the Debian packages of the last commit: made there, installed by apt on another bare Debian, and used
#   plugin    the same for the package of the ParaView plugin
#   paraview  the ParaView plugin's tests, on the last commit, timed
# RELEASE is bookworm (Debian 12) or trixie (Debian 13). Needs root and debootstrap. FOLDER keeps Debian's packages for
# later runs. If CCACHE_DIR is set, the compiler cache in that folder is used; CMAKE_BUILD_PARALLEL_LEVEL limits compilers.
set -eu

[ $# -eq 3 ] || {
  sed -n '3,10s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
top=$(cd "$(dirname "$0")/.." && pwd)
release=$1
what=$3
case $release in
  bookworm | trixie) ;;
  *)
    echo "clean-root.sh: '$release' is neither bookworm nor trixie." >&2
    exit 2
    ;;
esac
case $what in
  demo | packages | paraview | plugin | test) ;;
  *)
    echo "clean-root.sh: '$what' is neither demo, packages, paraview, plugin nor test." >&2
    exit 2
    ;;
esac
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap > /dev/null; then
  echo "clean-root.sh: it needs root and the package debootstrap." >&2
  exit 1
fi

# Unmounts everything: with mounts left behind, removing the root would be dangerous.
leave() {
  for mount in ccache var/cache/apt/archives sys proc dev/pts dev; do
    ! mountpoint -q "$root/$mount" || umount "$root/$mount"
  done
}
inside() { # COMMAND
  chroot "$root" env -i HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive \
    CCACHE_DIR=/ccache CCACHE_BASEDIR=/tmp/tipp CMAKE_BUILD_PARALLEL_LEVEL="${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}" \
    sh -euc "$1"
}

# Makes a bare Debian as a copy of the one that FOLDER keeps.
make_root() {
  leave
  rm -rf --one-file-system "$root"
  cp -a "$base" "$root"
  mount --bind /dev "$root/dev"
  mount --bind /dev/pts "$root/dev/pts" # tests run the tool on terminals
  mount -t proc proc "$root/proc"
  mount -t sysfs -o ro sysfs "$root/sys" # PoCL reads the properties of the CPU there
  mkdir -p "$folder/archives-$release/partial"
  mount --bind "$folder/archives-$release" "$root/var/cache/apt/archives"
}
# Brings the compiler cache into the root; the build uses it if it is there.
bring_ccache() {
  [ -n "${CCACHE_DIR:-}" ] || return 0
  mkdir -p "$CCACHE_DIR" "$root/ccache"
  mount --bind "$CCACHE_DIR" "$root/ccache"
  inside "apt-get update -q && apt-get install -q -y --no-install-recommends ccache"
}
# Copies the last commit to the root's /tmp/tipp.
bring_sources() {
  git clone -q --no-hardlinks "file://$top" "$root/tmp/tipp"
  bring_ccache
}

mkdir -p "$2"
folder=$(cd "$2" && pwd)
root=$folder/root
base=$folder/$release
trap leave EXIT
if [ ! -e "$base/complete" ]; then
  echo "== A bare Debian in $base"
  rm -rf --one-file-system "$base"
  debootstrap --variant=minbase --include=ca-certificates "$release" "$base" http://deb.debian.org/debian \
    > "$folder/debootstrap.log"
  touch "$base/complete"
fi
make_root

case $what in
  demo)
    bring_sources
    begin=$(date +%s)
    inside "cd /tmp/tipp && sh Utilities/demo.sh"
    echo "clean-root.sh: from the bare machine to the picture took $(($(date +%s) - begin)) s"
    ;;
  test)
    bring_sources
    begin=$(date +%s)
    inside "cd /tmp/tipp && sh Utilities/test.sh"
    echo "clean-root.sh: from the bare machine to all tests passed took $(($(date +%s) - begin)) s"
    ;;
  paraview)
    bring_sources
    begin=$(date +%s)
    inside "cd /tmp/tipp && sh Utilities/test.sh paraview"
    echo "clean-root.sh: from the bare machine to the plugin's tests passed took $(($(date +%s) - begin)) s"
    ;;
  packages)
    bring_sources
    inside "cd /tmp/tipp && sh Utilities/package.sh /tmp/packages"
    rm -rf "$folder/packages-$release"
    cp -r "$root/tmp/packages" "$folder/packages-$release"
    cp -r "$root/tmp/tipp/Examples/Cxx" "$folder/packages-$release/consumer"
    # Another bare Debian, which only gets the packages' dependencies.
    make_root
    cp -r "$folder/packages-$release" "$root/tmp/packages"
    inside "apt-get update -q && apt-get install -q -y --no-install-recommends /tmp/packages/*.deb"
    echo "== The tool"
    inside "cd /tmp && tipp --version && tipp points --distribution uniform --count 1000 -o points.npy &&
      tipp delaunay points.npy -o mesh.vtp && tipp check points.npy mesh.vtp"
    echo "== Python"
    inside "cd /tmp && python3 -c 'import numpy, tipp; print(len(tipp.delaunay(numpy.load(\"points.npy\"))), \"triangles\")'"
    echo "== C++"
    inside "apt-get install -q -y --no-install-recommends g++ cmake"
    inside "cmake -S /tmp/packages/consumer -B /tmp/consumer && cmake --build /tmp/consumer"
    ;;
  plugin)
    bring_sources
    inside "cd /tmp/tipp && sh Utilities/package.sh /tmp/packages paraview"
    mkdir -p "$folder/packages-$release"
    cp "$root"/tmp/packages/paraview-tipp_*.deb "$folder/packages-$release"
    make_root
    cp "$folder/packages-$release"/paraview-tipp_*.deb "$root/tmp"
    cat > "$root/tmp/plugin.py" << 'EOF'
from paraview.simple import *
mesh = TIPPDelaunay2D(Input=Plane())
mesh.UpdatePipeline()
print("loaded:", mesh.GetDataInformation().GetNumberOfCells(), "triangles")
EOF
    inside "apt-get update -q && apt-get install -q -y --no-install-recommends /tmp/paraview-tipp_*.deb python3-paraview xvfb xauth"
    inside "cd /tmp && PV_PLUGIN_CONFIG_FILE=\$(dpkg -L paraview-tipp | grep tipp.plugins.xml) xvfb-run -a pvbatch plugin.py | grep 'loaded: 2'"
    ;;
esac
echo "clean-root.sh: $what works on $release"

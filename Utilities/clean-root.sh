#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Tries this on a bare Debian, made anew in FOLDER/root: sh Utilities/clean-root.sh FOLDER WHAT
#   demo      the README's first command, on the last commit, timed
#   packages  the Debian packages: made here, installed there by apt, and used
# Needs root and debootstrap.
set -eu

[ $# -eq 2 ] || {
  sed -n '3,6s/^# \{0,1\}//p' "$0" >&2
  exit 2
}
top=$(cd "$(dirname "$0")/.." && pwd)
case $2 in
  demo | packages) ;;
  *)
    echo "clean-root.sh: '$2' is neither demo nor packages." >&2
    exit 2
    ;;
esac
if [ "$(id -u)" -ne 0 ] || ! command -v debootstrap > /dev/null; then
  echo "clean-root.sh: it needs root and the package debootstrap." >&2
  exit 1
fi

# Mounts left behind would make removal dangerous.
leave() {
  for mount in proc dev; do
    umount "$root/$mount" 2> /dev/null || true
  done
}
inside() { # COMMAND
  chroot "$root" env -i HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin DEBIAN_FRONTEND=noninteractive sh -euc "$1"
}

mkdir -p "$1"
folder=$(cd "$1" && pwd)
root=$folder/root
leave
rm -rf --one-file-system "$root"
echo "== A bare Debian in $root"
debootstrap --variant=minbase --include=ca-certificates bookworm "$root" http://deb.debian.org/debian > "$folder/debootstrap.log"
trap leave EXIT
mount --bind /dev "$root/dev"
mount -t proc proc "$root/proc"

case $2 in
  demo)
    git -C "$top" archive --prefix=tipp/ HEAD | tar -x -C "$root/tmp"
    begin=$(date +%s)
    inside "cd /tmp/tipp && sh Utilities/demo.sh"
    echo "clean-root.sh: from the bare machine to the picture took $(($(date +%s) - begin)) s"
    ;;
  packages)
    rm -rf "$folder/packages"
    sh "$top/Utilities/package.sh" "$folder/packages"
    mkdir "$root/tmp/packages"
    cp "$folder"/packages/*.deb "$root/tmp/packages"
    inside "apt-get update -q && apt-get install -q -y --no-install-recommends /tmp/packages/*.deb g++ cmake"
    echo "== The tool"
    inside "cd /tmp && tipp points --distribution uniform --count 1000 -o points.npy &&
      tipp delaunay points.npy -o mesh.vtp && tipp check points.npy mesh.vtp"
    echo "== Python"
    inside "cd /tmp && python3 -c 'import numpy, tipp; print(len(tipp.delaunay(numpy.load(\"points.npy\"))), \"triangles\")'"
    echo "== C++"
    cp -r "$top/Examples/Cxx" "$root/tmp/consumer"
    inside "cmake -S /tmp/consumer -B /tmp/consumer/build && cmake --build /tmp/consumer/build"
    ;;
esac
echo "clean-root.sh: $2 works"

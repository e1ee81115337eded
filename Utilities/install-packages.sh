#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Installs the packages in packages.txt (beside this script) that this machine lacks; does nothing if none is missing.
set -eu

list=$(dirname "$0")/packages.txt

if ! command -v dpkg-query > /dev/null; then
  echo "This is not a Debian system: nothing installed; it needs what $list names." >&2
  exit 0
fi

# A release that is not in the list gets the packages of the newest one.
release=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
[ "$release" = bookworm ] || release=trixie

missing=""
for package in $(sed 's/#.*//' "$list" | awk -v release="$release" 'NF && (NF == 1 || $2 == release) { print $1 }'); do
  case $(dpkg-query --show --showformat='${Status}' "$package" 2> /dev/null || true) in
    *" installed") ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

if [ "$(id -u)" -eq 0 ]; then
  as_root=""
elif command -v sudo > /dev/null; then
  as_root=sudo
else
  echo "Packages are missing and there is no sudo; as root, run: apt-get install$missing" >&2
  exit 1
fi

echo "Installing:$missing"
if ! { $as_root apt-get update -q &&
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
    -o DPkg::Lock::Timeout=300 $missing; }; then
  echo "apt-get could not install:$missing. Its message above says why; install them and try again." >&2
  exit 1
fi

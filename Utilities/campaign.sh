#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Runs random tests that try to break the tool: sh Utilities/campaign.sh NAME [--minutes M] [--trials N] [--seed S]
#   kill      kills runs, resumes them, and compares the results byte for byte
#   damage    changes, cuts, swaps and removes bytes in work folders and meshes
#   mutants   damaged input files of every format that a command reads
#   disk      full disks, and outputs that cannot be written
#   ranks     lost, killed and interrupted ranks
#   agree     random points and constraints in memory, out of core and on ranks
# Prints trials, failures, and the seed of each failure. TIPP_BUILD_DIR names a build to use; without it, build/ is
# built first.
set -eu

top=$(cd "$(dirname "$0")/.." && pwd)
name=${1:-}
case $name in
  kill | damage | mutants | disk | ranks | agree) shift ;;
  *)
    sed -n '3,11s/^# \{0,1\}//p' "$0" >&2
    exit 2
    ;;
esac
if [ -z "${TIPP_BUILD_DIR:-}" ]; then
  sh "$top/Utilities/build.sh" default --target tipp
  TIPP_BUILD_DIR=$top/build
fi
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
exec /usr/bin/python3 "$top/Testing/Campaigns/$name.py" --tipp "$TIPP_BUILD_DIR/bin/tipp" "$@"

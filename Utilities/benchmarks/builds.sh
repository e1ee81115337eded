# SPDX-License-Identifier: BSD-3-Clause
# builds OLD-BUILD [--rows delaunay,io,resample] [--points N] [--rounds R]
#   OLD-BUILD  the build folder of another version, with its benchmark programs; the two builds run alternately
[ $# -gt 0 ] && [ -x "$1/bin/benchmarkDelaunay" ] || usage
build_targets benchmarkDelaunay benchmarkIo benchmarkResample tipp
old=$1
shift
exec /usr/bin/python3 Testing/Benchmarks/compare_builds.py "$old" "$build" "$inputs/builds" "$@"

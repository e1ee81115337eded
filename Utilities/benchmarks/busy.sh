# SPDX-License-Identifier: BSD-3-Clause
# busy [--old BUILD] [--loops 0,1,2] [--threads T] [--rounds R] [--rows "NAME;NAME"] [--large]
#   Several threads beside one, while endless loops keep processors busy; also with the older build in folder BUILD
sh Utilities/build.sh default --target tipp_python
/usr/bin/python3 Testing/Benchmarks/busy.py "$top/build" "$@"

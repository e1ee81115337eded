// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInt128_h
#define tippInt128_h

namespace tipp
{

// GCC and Clang have 128-bit integers as an extension; named here once so that -Wpedantic holds.
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

} // namespace tipp

#endif

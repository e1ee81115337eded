// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInt128_h
#define tippInt128_h

namespace tipp
{

// 128-bit integers are an extension of GCC and Clang; __extension__ avoids -Wpedantic warnings.
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

} // namespace tipp

#endif

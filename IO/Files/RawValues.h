// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRawValues_h
#define tippRawValues_h

#include <cstring>

namespace tipp
{

/// @file
/// Values among the bytes of a file, at any address. LAS and the other formats that use these are
/// little-endian, as are all machines that TIPP is built for.

template <typename T>
T valueAt(const void* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

template <typename T>
void setValue(void* bytes, T value)
{
  std::memcpy(bytes, &value, sizeof value);
}

} // namespace tipp

#endif

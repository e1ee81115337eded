// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyText_h
#define tippNpyText_h

#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The bytes of an .npy file of version 1 with the given header.
inline std::string npyBytes(const std::string& header, const std::string& data)
{
  const std::string text = header + "\n";
  return std::string("\x93NUMPY\x01") + std::string(1, '\0') + char(text.size() & 0xff) +
    char(text.size() >> 8) + text + data;
}

template <typename Value>
std::string bytesOf(const std::vector<Value>& values)
{
  return { reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value) };
}

inline std::string npyHeader(const std::string& descr, const std::string& shape)
{
  return "{'descr': '" + descr + "', 'fortran_order': False, 'shape': " + shape + ", }";
}

} // namespace test
} // namespace tipp

#endif

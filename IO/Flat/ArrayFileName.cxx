// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/ArrayFileName.h"

#include <charconv>

namespace tipp
{

std::string arrayFileName(const std::string& name)
{
  constexpr char digits[] = "0123456789ABCDEF";
  std::string file;
  for (const char c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '/' || c == '\\' || c == '%' || byte < 0x20 || byte == 0x7f ||
      (c == '.' && file.empty()))
    {
      file += { '%', digits[byte >> 4], digits[byte & 15] };
    }
    else
    {
      file += c;
    }
  }
  return file;
}

std::string arrayNameOf(const std::string& fileName)
{
  std::string name;
  for (std::size_t i = 0; i < fileName.size(); ++i)
  {
    unsigned int byte = 0;
    const char* const digits = fileName.data() + i + 1;
    if (fileName[i] == '%' && i + 2 < fileName.size() &&
      std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2)
    {
      name += static_cast<char>(byte);
      i += 2;
    }
    else
    {
      name += fileName[i];
    }
  }
  return name;
}

} // namespace tipp

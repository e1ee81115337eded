// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/MemorySize.h"

#include <charconv>

namespace tipp
{

std::optional<std::uint64_t> parseMemorySize(const std::string& text)
{
  std::uint64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number);
  const std::string unit(stop, end);
  const std::size_t power = std::string("KMG").find(unit);
  const bool known = unit.empty() || (unit.size() == 1 && power != std::string::npos);
  if (error != std::errc() || !known || number == 0)
  {
    return std::nullopt;
  }
  const unsigned shift = unit.empty() ? 0 : 10 * (unsigned(power) + 1);
  return number <= (~std::uint64_t(0) >> shift) ? std::make_optional(number << shift)
                                                : std::nullopt;
}

std::string checkMemorySize(const std::string& text)
{
  return parseMemorySize(text) ? "" : "'" + text + "' is no number of bytes, as 512M or 2G";
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/StatedCodes.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <iterator>
#include <system_error>

namespace tipp
{
namespace
{

constexpr std::size_t lengthOfPrefix = 5;

/// Whether the text begins with "EPSG:", in upper or lower case.
bool namesCodes(const std::string& text)
{
  std::string prefix = text.substr(0, lengthOfPrefix);
  std::transform(prefix.begin(), prefix.end(), prefix.begin(),
    [](unsigned char c) { return char(std::toupper(c)); });
  return prefix == "EPSG:";
}

/// Reads the codes that a WKT states for the whole system or, if it is compound, for its two parts:
/// AUTHORITY["EPSG","25832"] or ID["EPSG",25832] directly in them.
StatedCodes codesOfWkt(const std::string& wkt)
{
  const int depthOfParts = hasHeightSystem(wkt) ? 2 : 1;
  StatedCodes codes;
  int depth = 0;
  int part = 0;
  bool isQuoted = false;
  for (std::size_t i = 0; i < wkt.size(); ++i)
  {
    isQuoted = isQuoted != (wkt[i] == '"');
    if (isQuoted)
    {
      continue;
    }
    depth += wkt[i] == '[' ? 1 : wkt[i] == ']' ? -1 : 0;
    part += wkt[i] == ']' && depth == 1 ? 1 : 0;
    for (const std::string& start :
      { std::string("AUTHORITY[\"EPSG\",\""), std::string("ID[\"EPSG\",") })
    {
      const bool isHere =
        depth == depthOfParts && wkt[i] == ',' && wkt.compare(i + 1, start.size(), start) == 0;
      if (isHere)
      {
        std::from_chars(wkt.data() + i + 1 + start.size(), wkt.data() + wkt.size(),
          part == 0 || depthOfParts == 1 ? codes.Horizontal : codes.Heights);
      }
    }
  }
  return codes;
}

} // namespace

bool hasHeightSystem(const std::string& text)
{
  const std::string wkt = text.substr(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return namesCodes(text)
    ? text.find('+') != std::string::npos
    : wkt.compare(0, 8, "COMPD_CS") == 0 || wkt.compare(0, 11, "COMPOUNDCRS") == 0;
}

std::string withoutBlanks(const std::string& text)
{
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result),
    [](unsigned char c) { return std::isspace(c) == 0; });
  return result;
}

StatedCodes codesIn(const std::string& text)
{
  const char* const end = text.data() + text.size();
  StatedCodes codes;
  std::from_chars_result read = std::from_chars(text.data(), end, codes.Horizontal);
  if (read.ec == std::errc() && read.ptr != end && *read.ptr == '+')
  {
    read = std::from_chars(read.ptr + 1, end, codes.Heights);
  }
  return read.ec == std::errc() && read.ptr == end ? codes : StatedCodes();
}

StatedCodes codesOf(const std::string& text)
{
  return namesCodes(text) ? codesIn(text.substr(lengthOfPrefix)) : codesOfWkt(withoutBlanks(text));
}

} // namespace tipp

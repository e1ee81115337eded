// SPDX-License-Identifier: BSD-3-Clause
#include "Crs/StatedCodes.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>

namespace tipp
{

bool hasHeightSystem(const std::string& text)
{
  const bool isCode = text.compare(0, 5, "EPSG:") == 0;
  return isCode ? text.find('+') != std::string::npos
                : text.compare(0, 8, "COMPD_CS") == 0 || text.compare(0, 11, "COMPOUNDCRS") == 0;
}

std::string withoutBlanks(const std::string& text)
{
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result),
    [](unsigned char c) { return std::isspace(c) == 0; });
  return result;
}

namespace
{

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
        (part == 0 || depthOfParts == 1 ? codes.Horizontal : codes.Heights) =
          std::atoi(wkt.c_str() + i + 1 + start.size());
      }
    }
  }
  return codes;
}

} // namespace

StatedCodes codesOf(const std::string& text)
{
  if (text.compare(0, 5, "EPSG:") != 0)
  {
    return codesOfWkt(withoutBlanks(text));
  }
  const std::size_t plus = text.find('+');
  return { std::atoi(text.c_str() + 5),
    plus == std::string::npos ? 0 : std::atoi(text.c_str() + plus + 1) };
}

} // namespace tipp

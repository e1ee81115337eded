// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ColumnChoice.h"

#include "Files/IOError.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::array<std::pair<const char*, const char*>, 6> usualNames = { { { "x", "y" },
  { "lon", "lat" }, { "longitude", "latitude" }, { "easting", "northing" }, { "lng", "lat" },
  { "long", "lat" } } };

std::string lowerCase(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::optional<std::size_t> find(const std::vector<std::string>& names, const std::string& name)
{
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? std::nullopt : std::make_optional(std::size_t(at - names.begin()));
}

std::string listed(const std::vector<std::string>& names, std::size_t count)
{
  std::string list;
  for (const std::string& name : names)
  {
    list += (list.empty() ? "" : ", ") + name;
  }
  return names.empty() ? "0 to " + std::to_string(count - 1) : list;
}

std::size_t resolve(const std::string& path, const std::string& wanted,
  const std::vector<std::string>& names, std::size_t count)
{
  if (const auto named = find(names, wanted))
  {
    return *named;
  }
  std::size_t number = 0;
  const char* const end = wanted.data() + wanted.size();
  const auto [stop, error] = std::from_chars(wanted.data(), end, number);
  if (error == std::errc() && stop == end && number < count)
  {
    return number;
  }
  throw IOError(path, "has no column '" + wanted + "'; choose from " + listed(names, count) + ".");
}

} // namespace

ColumnChoice chooseColumns(const std::string& path, const std::vector<std::string>& names,
  std::size_t count, const PointOptions& options)
{
  if (count < 2)
  {
    throw IOError(path, "has a single column; x and y are needed.");
  }
  ColumnChoice choice;
  std::vector<std::string> lower;
  std::transform(names.begin(), names.end(), std::back_inserter(lower), lowerCase);
  for (const auto& [x, y] : usualNames)
  {
    const auto atX = find(lower, x);
    const auto atY = find(lower, y);
    if (atX && atY)
    {
      choice = { *atX, *atY };
      break;
    }
  }
  if (!options.X.empty())
  {
    choice.X = resolve(path, options.X, names, count);
  }
  if (!options.Y.empty())
  {
    choice.Y = resolve(path, options.Y, names, count);
  }
  if (choice.X == choice.Y)
  {
    throw IOError(path, "cannot give the same column as x and y; choose both.");
  }
  return choice;
}

} // namespace tipp

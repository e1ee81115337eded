// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/TilingChoice.h"

#include <charconv>
#include <string_view>

namespace tipp
{
namespace
{

std::optional<std::string_view> after(std::string_view text, std::string_view start)
{
  return text.substr(0, start.size()) == start ? std::make_optional(text.substr(start.size()))
                                               : std::nullopt;
}

std::optional<TilingChoice> parseTree(std::string_view number)
{
  TilingChoice choice;
  const char* const end = number.data() + number.size();
  const auto [stop, error] = std::from_chars(number.data(), end, choice.Threshold);
  const bool good = error == std::errc() && stop == end && choice.Threshold >= 1;
  return good ? std::make_optional(choice) : std::nullopt;
}

std::optional<TilingChoice> parseGrid(std::string_view counts)
{
  constexpr int most = 10000;
  TilingChoice choice;
  const char* at = counts.data();
  const char* const end = at + counts.size();
  std::size_t axis = 0;
  for (; axis < 3; ++axis)
  {
    const auto [stop, error] = std::from_chars(at, end, choice.Boxes[axis]);
    if (error != std::errc() || choice.Boxes[axis] < 1 || choice.Boxes[axis] > most)
    {
      return std::nullopt;
    }
    at = stop;
    if (at == end)
    {
      break;
    }
    if (*at++ != 'x')
    {
      return std::nullopt;
    }
  }
  return at == end && axis >= 1 && axis < 3 ? std::make_optional(choice) : std::nullopt;
}

} // namespace

std::optional<TilingChoice> TilingChoice::parse(const std::string& text)
{
  if (const auto counts = after(text, "grid:"))
  {
    return parseGrid(*counts);
  }
  for (const char* const name : { "quadtree:", "octree:" })
  {
    if (const auto number = after(text, name))
    {
      return parseTree(*number);
    }
  }
  return std::nullopt;
}

std::string TilingChoice::text(int dimension) const
{
  if (this->Threshold > 0)
  {
    return (dimension == 2 ? "quadtree:" : "octree:") + std::to_string(this->Threshold);
  }
  std::string counts = std::to_string(this->Boxes[0]) + "x" + std::to_string(this->Boxes[1]);
  if (dimension == 3)
  {
    counts += "x" + std::to_string(this->Boxes[2]);
  }
  return "grid:" + counts;
}

} // namespace tipp

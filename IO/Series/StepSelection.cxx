// SPDX-License-Identifier: BSD-3-Clause
#include "Series/StepSelection.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace tipp
{
namespace
{

/// Whether a part of FIRST:LAST:STRIDE is a number, or left out.
bool isPart(std::string_view part)
{
  std::int64_t value = 0;
  return part.empty() || (parseInteger(part, value) && value >= 0);
}

std::vector<std::string_view> partsOf(const std::string& text)
{
  std::vector<std::string_view> parts;
  splitFields(text, ':', parts);
  return parts;
}

} // namespace

bool isOneStep(const std::string& text)
{
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string checkSteps(const std::string& text)
{
  const std::vector<std::string_view> parts = partsOf(text);
  const bool isRange = !text.empty() &&
    text.find_first_not_of("0123456789:") == std::string::npos && parts.size() <= 3 &&
    std::all_of(parts.begin(), parts.end(), isPart);
  std::int64_t stride = 1;
  if (isRange && parts.size() == 3 && parseInteger(parts[2], stride) && stride == 0)
  {
    return "the stride of '" + text + "' must be at least 1";
  }
  return text == "all" || isRange
    ? ""
    : "'" + text + "' is neither a number of a step, all nor FIRST:LAST:STRIDE, such as 0:99:10";
}

std::vector<std::size_t> parseSteps(
  const std::string& text, std::size_t count, const std::string& path)
{
  const std::vector<std::string_view> parts = partsOf(text == "all" ? ":" : text);
  std::int64_t numbers[3] = { 0, std::int64_t(count) - 1, 1 };
  for (std::size_t i = 0; i < parts.size() && i < 3; ++i)
  {
    parseInteger(parts[i], numbers[i]);
  }
  auto& [first, last, stride] = numbers;
  if (isOneStep(text))
  {
    last = first;
    if (count == 0 && first == 0)
    {
      return { 0 };
    }
  }
  if (last >= std::int64_t(count) || first > last)
  {
    throw IOError(path,
      "has no time step " + (text.empty() ? "0" : text) + "; there are " + std::to_string(count) +
        ", counted from 0.");
  }
  std::vector<std::size_t> steps;
  for (std::int64_t step = first; step <= last; step += std::min(stride, last + 1))
  {
    steps.push_back(std::size_t(step));
  }
  return steps;
}

} // namespace tipp

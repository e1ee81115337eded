// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/ShortestText.h"

#include <charconv>

namespace tipp
{

char* writeShortest(NumberText& text, double value)
{
  return std::to_chars(text.data(), text.data() + text.size(), value).ptr;
}

char* writeShortestScientific(NumberText& text, double value)
{
  return std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific)
    .ptr;
}

} // namespace tipp

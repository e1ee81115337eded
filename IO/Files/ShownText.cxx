// SPDX-License-Identifier: BSD-3-Clause
#include "Files/ShownText.h"

#include <algorithm>
#include <cctype>

namespace tipp
{

std::string shownText(const std::string& text)
{
  constexpr std::size_t most = 80;
  std::string shown = text.size() > most ? text.substr(0, most) + "..." : text;
  std::replace_if(
    shown.begin(), shown.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; },
    '?');
  return shown;
}

std::string listOfNames(const std::set<std::string>& names, const std::string& intro)
{
  constexpr std::size_t most = 20;
  std::string text = intro;
  std::size_t listed = 0;
  for (const std::string& name : names)
  {
    if (listed == most)
    {
      return text + " and " + std::to_string(names.size() - most) + " more";
    }
    text += (listed++ == 0 ? "'" : ", '") + shownText(name) + "'";
  }
  return names.empty() ? text + "none" : text;
}

} // namespace tipp

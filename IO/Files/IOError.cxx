// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"

#include "Files/TemporaryPaths.h"

#include <algorithm>

namespace tipp
{

std::string onOneLine(std::string message)
{
  std::replace_if(
    message.begin(), message.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; },
    '?');
  return message;
}

std::string shownText(const std::string& text)
{
  constexpr std::size_t most = 80;
  return onOneLine(text.size() > most ? text.substr(0, most) + "..." : text);
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

IOError::IOError(const std::string& sentence)
  : std::runtime_error(onOneLine(sentence))
{
}

IOError::IOError(const std::string& path, const std::string& problem)
  : std::runtime_error(onOneLine(shownPath(path) + ": " + problem))
  , Path(path)
{
}

IOError::IOError(const std::string& path, std::int64_t line, const std::string& problem)
  : std::runtime_error(
      onOneLine(shownPath(path) + ", line " + std::to_string(line) + ": " + problem))
  , Path(path)
{
}

IOError::~IOError() = default;

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"

#include "Files/TemporaryPath.h"

#include <algorithm>
#include <cctype>

namespace tipp
{
namespace
{

/// Text from a damaged file may hold any bytes; a message must stay on one line.
std::string onOneLine(std::string message)
{
  std::replace_if(
    message.begin(), message.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; },
    '?');
  return message;
}

} // namespace

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

// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"

namespace tipp
{

IOError::IOError(const std::string& sentence)
  : std::runtime_error(sentence)
{
}

IOError::IOError(const std::string& path, const std::string& problem)
  : std::runtime_error(path + ": " + problem)
  , Path(path)
{
}

IOError::IOError(const std::string& path, std::int64_t line, const std::string& problem)
  : std::runtime_error(path + ", line " + std::to_string(line) + ": " + problem)
  , Path(path)
{
}

IOError::~IOError() = default;

} // namespace tipp

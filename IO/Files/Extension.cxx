// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Extension.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace tipp
{

std::string extensionOf(const std::string& path)
{
  const std::size_t end = path.find_last_not_of('/'); // "mesh.tipp/" is a folder's name, too
  std::string extension = std::filesystem::path(path.substr(0, end + 1)).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

} // namespace tipp

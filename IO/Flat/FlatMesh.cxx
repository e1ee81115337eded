// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Flat/FlatFolder.h"
#include "Flat/FlatVtu.h"

#include <filesystem>

namespace tipp
{

FlatMesh openFlatMesh(const std::string& path)
{
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure))
  {
    return openFlatFolder(path);
  }
  if (extensionOf(path) == ".vtu")
  {
    return openFlatVtu(path);
  }
  throw IOError(path,
    "is neither a folder of .npy arrays nor a .vtu file; 'tipp flatten' makes such a folder of any "
    "VTK file.");
}

bool isFlatMesh(const std::string& path)
{
  std::error_code failure;
  return std::filesystem::is_directory(path, failure)
    ? isFlatFolder(path)
    : extensionOf(path) == ".vtu" && isFlatVtu(path);
}

} // namespace tipp

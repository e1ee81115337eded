// SPDX-License-Identifier: BSD-3-Clause
// Replaces the code that reads VTK files in a build without VTK.
#include "Vtk/VtkFiles.h"

#include "Constraints/ReadConstraintFile.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <array>

namespace tipp
{

bool isVtkFile(const std::string& path)
{
  constexpr std::array<const char*, 14> extensions = { ".vtp", ".vtu", ".vti", ".vts", ".vtr",
    ".pvtp", ".pvtu", ".pvti", ".pvts", ".pvtr", ".vtk", ".ply", ".stl", ".obj" };
  return std::find(extensions.begin(), extensions.end(), extensionOf(path)) != extensions.end();
}

ConstraintTable readVtkConstraints(const std::string& path)
{
  throw IOError(path,
    "is a file that VTK reads, and this tipp was built without VTK; give .csv, .poly or .14.");
}

PointTable readVtkPoints(const std::string& path)
{
  throw IOError(path,
    "is a file that VTK reads, and this tipp was built without VTK; read it in Python with VTK or "
    "PyVista, and give its points.");
}

std::string cellTypeName(int type)
{
  return "type " + std::to_string(type);
}

} // namespace tipp

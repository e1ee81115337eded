// SPDX-License-Identifier: BSD-3-Clause
// Replaces everything that reads VTK's files, in a build without VTK.
#include "NoVtk.h"

#include "Constraints/ReadConstraintFile.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TemporaryPaths.h"
#include "Files/VtkXml.h"
#include "Partitioning/PartitionMesh.h"
#include "Points/ReadPoints.h"

#include <filesystem>
#include <string>

namespace tipp
{
namespace
{

/// The expression of Python that reads the file.
std::string readingOf(const std::string& path)
{
  return "pyvista.read('" + shownPath(path) + "')";
}

/// Throws IOError. `advice`: what a line of Python with PyVista does with the file; `line`: that
/// line.
[[noreturn]] void refuse(
  const std::string& path, const std::string& advice, const std::string& line)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw IOError(path, "is not a file that can be read; check the name.");
  }
  const InputFile readable(path); // one without permission is reported as such
  throw IOError(path,
    "is a file that VTK reads, and this tipp was built without VTK; " + advice + ": python -c \"" +
      line + "\".");
}

} // namespace

void refuseVtkCells(const std::string& path)
{
  refuse(path, "PyVista writes its cells",
    "import numpy, pyvista; numpy.save('cells.npy', *" + readingOf(path) +
      ".cast_to_unstructured_grid().cells_dict.values())");
}

void refuseVtkMesh(const std::string& path)
{
  refuse(path, "PyVista makes a partitioned mesh of it",
    "import pyvista, tipp; tipp.write(" + readingOf(path) + ", 'mesh.tipp')");
}

PointTable readVtkPoints(const std::string& path)
{
  refuse(path, "PyVista writes its points",
    "import numpy, pyvista; numpy.save('points.npy', " + readingOf(path) + ".points)");
}

ConstraintTable readVtkConstraints(const std::string& path)
{
  throw IOError(path,
    "is a file that VTK reads, and this tipp was built without VTK; give .csv, .poly or .14.");
}

std::string cellTypeName(int type)
{
  return "type " + std::to_string(type);
}

PartitionStatistics partitionVtkFile(
  const std::string& path, const std::string&, const PartitionOptions&, vtkMultiProcessController*)
{
  refuseVtkMesh(path);
}

} // namespace tipp

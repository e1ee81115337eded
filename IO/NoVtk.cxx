// SPDX-License-Identifier: BSD-3-Clause
// Replaces everything that reads VTK's files, in a build without VTK.
#include "Constraints/ReadConstraintFile.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TemporaryPaths.h"
#include "Files/VtkXml.h"
#include "Meshes/MeshFiles.h"
#include "Partitioning/PartitionMesh.h"
#include "Points/ReadPoints.h"

#include <string>

namespace tipp
{
namespace
{

/// Throws IOError: `done` is what a line of Python with PyVista does with the file, and
/// `statements` are the line, where FILE is the file's name.
[[noreturn]] void refuse(const std::string& path, const std::string& done, std::string statements)
{
  const InputFile readable(path); // a file that is not there is reported as such
  const std::string placeholder = "FILE";
  statements.replace(statements.find(placeholder), placeholder.size(), shownPath(path));
  throw IOError(path,
    "is a file that VTK reads, and this tipp was built without VTK; " + done + ": python -c \"" +
      statements + "\".");
}

[[noreturn]] void refuseCells(const std::string& path)
{
  refuse(path, "PyVista writes its cells",
    "import numpy, pyvista; numpy.save('cells.npy', "
    "*pyvista.read('FILE').cast_to_unstructured_grid().cells_dict.values())");
}

} // namespace

PointTable readVtkPoints(const std::string& path)
{
  refuse(path, "PyVista writes its points",
    "import numpy, pyvista; numpy.save('points.npy', pyvista.read('FILE').points)");
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

TriangleMesh readVtkTriangles(const std::string& path)
{
  refuseCells(path);
}

bool holdsVtkTetrahedra(const std::string& path)
{
  refuseCells(path);
}

StoredTetrahedra readVtkTetrahedra(const std::string& path)
{
  refuseCells(path);
}

PartitionStatistics partitionVtkFile(
  const std::string& path, const std::string&, const PartitionOptions&, vtkMultiProcessController*)
{
  refuse(path, "PyVista reads it for the package",
    "import pyvista, tipp; tipp.write(pyvista.read('FILE'), 'mesh.tipp')");
}

} // namespace tipp

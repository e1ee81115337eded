// SPDX-License-Identifier: BSD-3-Clause
#include "Points/ReadPoints.h"

#include "Adcirc/AdcircGrid.h"
#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Points/NpyPoints.h"
#include "Points/TextPoints.h"
#include "Vtk/VtkFiles.h"

#include <utility>

namespace tipp
{
namespace
{

PointTable readFixedColumns(const std::string& path)
{
  if (isVtkFile(path))
  {
    return readVtkPoints(path);
  }
  AdcircGrid grid = readAdcircGrid(path);
  PointTable table;
  table.XY = std::move(grid.XY);
  table.Columns.push_back({ "depth", std::move(grid.Depth) });
  return table;
}

} // namespace

PointTable readPoints(const std::string& path, const PointOptions& options)
{
  const std::string extension = extensionOf(path);
  if (extension == ".npy")
  {
    return readNpyPoints(path, options);
  }
  if (isTextExtension(extension))
  {
    return readTextPoints(path, options);
  }
  if (extension != ".14" && extension != ".grd" && !isVtkFile(path))
  {
    throw IOError(path,
      "has no extension that tells a kind of point file; use .npy, .csv, .txt, .xyz, .14, .grd or "
      "one of VTK's.");
  }
  if (!options.X.empty() || !options.Y.empty())
  {
    throw IOError(path, "has fixed coordinates; columns can be chosen in .npy and text files.");
  }
  return readFixedColumns(path);
}

PointTable readPointsShare(
  const std::string& path, const PointOptions& options, int part, int parts)
{
  if (extensionOf(path) == ".npy")
  {
    return readNpyPoints(path, options, part, parts);
  }
  return part == 0 ? readPoints(path, options) : PointTable();
}

} // namespace tipp

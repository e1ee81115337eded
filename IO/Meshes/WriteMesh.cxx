// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/WriteMesh.h"

#include "Adcirc/WriteAdcirc.h"
#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Files/PendingFile.h"
#include "Meshes/FindNeighbors.h"
#include "Meshes/MeshDataSet.h"
#include "Npy/NpyFile.h"
#include "Vtk/WriteXmlFile.h"

#include "vtkPolyData.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>

namespace tipp
{
namespace
{

bool isAborted(const MeshOptions& options)
{
  return options.Aborted && options.Aborted();
}

bool writeNpy(const std::string& path, TrianglesView triangles, const MeshOptions& options)
{
  NpyWriter writer(path, "<i8", { std::int64_t(triangles.size()), 3 }, options.Before);
  constexpr std::size_t chunkSize = 1 << 15;
  std::vector<std::int64_t> chunk(3 * std::min(chunkSize, triangles.size()));
  for (std::size_t first = 0; first < triangles.size(); first += chunkSize)
  {
    const std::size_t size = std::min(chunkSize, triangles.size() - first);
    for (std::size_t i = 0; i < 3 * size; ++i)
    {
      chunk[i] = triangles.id(first + i / 3, int(i % 3));
    }
    writer.write(chunk.data(), 3 * size * sizeof(std::int64_t));
  }
  if (isAborted(options))
  {
    return false;
  }
  writer.close();
  return true;
}

template <typename Writer>
bool writeXml(const std::string& path, vtkDataSet* data, const MeshOptions& options)
{
  PendingFile pending(path, options.Before);
  writeXmlFile<Writer>(path, pending, data);
  if (isAborted(options))
  {
    return false;
  }
  pending.commit();
  return true;
}

std::vector<std::int64_t> neighborsOf(TrianglesView triangles)
{
  std::vector<std::int64_t> neighbors(3 * triangles.size());
  triangles.ids32() ? findNeighbors(triangles.ids32(), triangles.size(), neighbors.data())
                    : findNeighbors(triangles.ids64(), triangles.size(), neighbors.data());
  return neighbors;
}

} // namespace

bool isMeshFile(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".npy" || extension == ".vtp" || extension == ".vtu" ||
    isAdcircExtension(extension);
}

bool writeMesh(const std::string& path, const PointTable& points, TrianglesView triangles,
  const MeshOptions& options)
{
  const std::string extension = extensionOf(path);
  if (extension == ".npy")
  {
    return writeNpy(path, triangles, options);
  }
  if (isAdcircExtension(extension))
  {
    return writeAdcircGrid(
      path, points, triangles, options.AdcircLike, options.Before, options.Aborted);
  }
  const std::vector<std::int64_t> neighbors =
    options.Neighbors ? neighborsOf(triangles) : std::vector<std::int64_t>();
  const MeshData more{ &options.Representatives, &neighbors };
  if (extension == ".vtp")
  {
    const auto data = makePolyData(points, triangles, more);
    return writeXml<vtkXMLPolyDataWriter>(path, data, options);
  }
  if (extension == ".vtu")
  {
    const auto data = makeUnstructuredGrid(points, triangles, more);
    return writeXml<vtkXMLUnstructuredGridWriter>(path, data, options);
  }
  throw IOError(
    path, "has no extension that tells a kind of mesh file; use .npy, .vtp, .vtu or .14.");
}

} // namespace tipp

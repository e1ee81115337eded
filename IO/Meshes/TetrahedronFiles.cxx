// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/TetrahedronFiles.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/PendingOutput.h"
#include "Npy/NpyFile.h"
#include "Vtk/ReadDataSet.h"
#include "Vtk/VtkFiles.h"
#include "Vtk/WriteXmlFile.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <utility>

namespace tipp
{
namespace
{

bool isStopped(const MeshOptions& options)
{
  return options.Aborted && options.Aborted();
}

bool writeIds(const std::string& path, const std::int32_t* ids, std::size_t tetrahedra,
  const MeshOptions& options)
{
  NpyWriter writer(path, "<i8", { std::int64_t(tetrahedra), 4 }, options.Before);
  constexpr std::size_t chunkSize = 1 << 16;
  std::vector<std::int64_t> chunk;
  for (std::size_t first = 0; first < 4 * tetrahedra; first += chunkSize)
  {
    chunk.assign(ids + first, ids + std::min(4 * tetrahedra, first + chunkSize));
    writer.write(chunk.data(), chunk.size() * sizeof(std::int64_t));
  }
  if (isStopped(options))
  {
    return false;
  }
  writer.close();
  return true;
}

/// Cells in the memory of the ids, which the writer does not change.
vtkSmartPointer<vtkCellArray> cellsOf(const std::int32_t* ids, std::size_t tetrahedra)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  constexpr std::size_t most32 = (std::size_t(1) << 31) / 4 - 1;
  if (tetrahedra > most32)
  {
    cells->Use64BitStorage();
    cells->AllocateExact(vtkIdType(tetrahedra), 4 * vtkIdType(tetrahedra));
    for (std::size_t i = 0; i < 4 * tetrahedra; i += 4)
    {
      cells->InsertNextCell({ ids[i], ids[i + 1], ids[i + 2], ids[i + 3] });
    }
    return cells;
  }
  vtkNew<vtkTypeInt32Array> offsets;
  offsets->SetNumberOfValues(vtkIdType(tetrahedra) + 1);
  for (std::size_t i = 0; i <= tetrahedra; ++i)
  {
    offsets->SetValue(vtkIdType(i), static_cast<int>(4 * i));
  }
  vtkNew<vtkTypeInt32Array> connectivity;
  connectivity->SetArray(const_cast<std::int32_t*>(ids), 4 * vtkIdType(tetrahedra), 1);
  cells->SetData(offsets.Get(), connectivity.Get());
  return cells;
}

} // namespace

std::size_t requireElevation(const PointTable& points, const std::string& path)
{
  const std::vector<std::string> names = points.names();
  const std::size_t found = findElevation(names);
  if (found == names.size())
  {
    throw IOError(path, "has no third coordinate; name a column z.");
  }
  return found;
}

bool writeTetrahedra(const std::string& path, PointTable points, const std::int32_t* ids,
  std::size_t tetrahedra, const std::vector<std::int64_t>& neighbors, const MeshOptions& options)
{
  if (extensionOf(path) == ".npy")
  {
    return writeIds(path, ids, tetrahedra, options);
  }
  if (extensionOf(path) != ".vtu")
  {
    throw IOError(
      path, "has no extension that tells a kind of file of tetrahedra; use .npy or .vtu.");
  }
  points.Columns[requireElevation(points, path)].Name = "z"; // makes it the third coordinate
  const auto data =
    makeUnstructuredGrid(points, TrianglesView(), { &options.Representatives, nullptr });
  data->SetCells(VTK_TETRA, cellsOf(ids, tetrahedra));
  if (!neighbors.empty())
  {
    vtkNew<vtkTypeInt64Array> array;
    array->SetName("NeighborIds");
    array->SetNumberOfComponents(4);
    array->SetNumberOfTuples(vtkIdType(tetrahedra));
    std::copy(neighbors.begin(), neighbors.end(), array->GetPointer(0));
    data->GetCellData()->AddArray(array);
  }
  PendingFile pending(path, options.Before);
  writeXmlFile<vtkXMLUnstructuredGridWriter>(path, pending, data);
  if (isStopped(options))
  {
    return false;
  }
  pending.commit();
  return true;
}

bool holdsTetrahedra(const std::string& path)
{
  if (extensionOf(path) == ".npy")
  {
    const NpyReader reader(path);
    return reader.columns() == 4 && !reader.isFloat();
  }
  if (extensionOf(path) != ".vtu" && extensionOf(path) != ".vtk")
  {
    return false;
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  return data->GetNumberOfCells() > 0 && data->GetCellType(0) == VTK_TETRA;
}

StoredTetrahedra readTetrahedra(const std::string& path)
{
  StoredTetrahedra mesh;
  if (extensionOf(path) == ".npy")
  {
    NpyReader reader(path);
    if (reader.columns() != 4 || reader.type() != NpyReader::Type::Int64)
    {
      throw IOError(path, "does not hold tetrahedra; save m x 4 integers of 64 bits.");
    }
    mesh.Ids.resize(4 * std::size_t(reader.rows()));
    reader.read(mesh.Ids.data(), mesh.Ids.size() * sizeof(std::int64_t));
    return mesh;
  }
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); ++cell)
  {
    if (data->GetCellType(cell) != VTK_TETRA)
    {
      throw IOError(
        path, "holds a cell that is not a tetrahedron (cell " + std::to_string(cell) + ").");
    }
    data->GetCellPoints(cell, ids);
    mesh.Ids.insert(mesh.Ids.end(), ids->begin(), ids->end());
  }
  mesh.XYZ.resize(3 * std::size_t(data->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    data->GetPoint(i, &mesh.XYZ[3 * std::size_t(i)]);
  }
  vtkDataArray* const neighbors = data->GetCellData()->GetArray("NeighborIds");
  for (vtkIdType i = 0; neighbors && i < neighbors->GetNumberOfTuples(); ++i)
  {
    for (int k = 0; k < neighbors->GetNumberOfComponents(); ++k)
    {
      mesh.Neighbors.push_back(std::int64_t(neighbors->GetComponent(i, k)));
    }
  }
  return mesh;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Meshes/MeshFiles.h"

#include "Arrays/FindNeighbors.h"
#include "Arrays/Scalar.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/WriteVtkXml.h"
#include "Meshes/TextMeshes.h"
#include "Models/ModelMesh.h"
#include "Models/TriangleFiles.h"
#include "Npy/NpyFile.h"
#include "Series/WriteUgrid.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace tipp
{

const NodeColumn* findZ(const NodesView& nodes)
{
  for (const NodeColumn& column : nodes.columns())
  {
    if (column.Name == "z" || column.Name == "Z")
    {
      return &column;
    }
  }
  return nullptr;
}

namespace
{

template <typename Id>
void readIds(NpyReader& reader, std::vector<std::int64_t>& ids)
{
  constexpr std::size_t chunkSize = 1 << 16;
  std::vector<Id> chunk(std::min(chunkSize, ids.size()));
  for (std::size_t first = 0; first < ids.size(); first += chunkSize)
  {
    const std::size_t size = std::min(chunkSize, ids.size() - first);
    reader.read(chunk.data(), size * sizeof(Id));
    std::transform(chunk.begin(), chunk.begin() + std::ptrdiff_t(size),
      ids.begin() + std::ptrdiff_t(first), [](Id id) { return std::int64_t(id); });
  }
}

/// Reads an .npy file of cells: `corners` ids in each row. `what` names the cells in messages.
std::vector<std::int64_t> readNpyIds(const std::string& path, int corners, const char* what)
{
  NpyReader reader(path);
  if (reader.columns() != corners || reader.isFloat())
  {
    throw IOError(path,
      std::string("does not hold ") + what + "; save m x " + std::to_string(corners) +
        " integers of 32 or 64 bits.");
  }
  std::vector<std::int64_t> all(std::size_t(corners * reader.rows()));
  switch (reader.type())
  {
    case Scalar::Int32:
      readIds<std::int32_t>(reader, all);
      break;
    case Scalar::UInt32:
      readIds<std::uint32_t>(reader, all);
      break;
    default: // as stored; unsigned ids from 2^63 on become negative, and so remain out of range
      reader.read(all.data(), all.size() * sizeof(std::int64_t));
  }
  return all;
}

} // namespace

TriangleMesh readMesh(const std::string& path)
{
  switch (openerOf(path, Use::Triangles))
  {
    case Opener::Npy:
      return { readNpyIds(path, 3, "triangles"), {}, {} };
    case Opener::Vtk:
      return readVtkTriangles(path);
    default:
      if (isModelMesh(path))
      {
        ModelMesh mesh = readModelMesh(path, ModelPart::Triangles);
        return { std::move(mesh.Triangles), std::move(mesh.XY), {} };
      }
      refuseKind(path,
        "has no extension that tells a kind of mesh file; use " +
          listFormats(Use::Triangles, " or one of VTK's") + ".");
  }
}

namespace
{

template <typename Id>
bool writeNpy(const std::string& path, const Id* ids, std::size_t cells, std::size_t corners,
  const MeshOptions& options)
{
  NpyWriter writer(path, "<i8", { std::int64_t(cells), std::int64_t(corners) }, options.Before);
  constexpr std::size_t chunkSize = 1 << 16;
  std::vector<std::int64_t> chunk;
  for (std::size_t first = 0; first < corners * cells; first += chunkSize)
  {
    chunk.assign(ids + first, ids + std::min(corners * cells, first + chunkSize));
    writer.write(chunk.data(), chunk.size() * sizeof(std::int64_t));
  }
  if (options.Aborted && options.Aborted())
  {
    return false;
  }
  writer.close();
  return true;
}

/// Cells with the same number of corners: the corners' point ids.
template <typename Id>
struct Cells
{
  const Id* Ids;
  std::size_t Count;
  std::size_t Corners;

  std::size_t idCount() const { return this->Count * this->Corners; }
};
template <typename Id>
Cells(const Id*, std::size_t, std::size_t) -> Cells<Id>;

XmlArray pointsArray(const NodesView& nodes)
{
  const NodeColumn* const z = findZ(nodes);
  const auto coordinate = [&nodes, z](std::size_t i) {
    return i % 3 < 2 ? nodes[i / 3][i % 3] : z ? z->Values[i / 3] : 0;
  };
  return computedXmlArray<double>("Points", 3 * nodes.size(), coordinate, 3);
}

XmlSection pointData(const NodesView& nodes, const MeshOptions& options)
{
  XmlSection section{ "PointData", {}, "" };
  for (const NodeColumn& column : nodes.columns())
  {
    if (&column != findZ(nodes))
    {
      section.Arrays.push_back(xmlArray(column.Name, column.Values, nodes.size()));
    }
  }
  const std::vector<std::int64_t>& ids = options.Representatives;
  if (!ids.empty())
  {
    section.Arrays.push_back(xmlArray("RepresentativePointId", ids.data(), ids.size()));
  }
  return section;
}

XmlSection cellData(
  const std::vector<std::int64_t>& neighbors, std::size_t corners, const RegionsView& regions)
{
  XmlSection section{ "CellData", {}, "" };
  if (!regions.empty())
  {
    section.Arrays.push_back(computedXmlArray<std::int64_t>(
      "Region", regions.size(), [regions](std::size_t i) { return regions[i]; }));
  }
  if (!neighbors.empty())
  {
    section.Arrays.push_back(
      xmlArray(neighborIdsName, neighbors.data(), neighbors.size(), int(corners)));
  }
  return section;
}

/// The section of cells. VTK needs offsets of the type of the ids, so that 32-bit ids are written
/// as 64-bit ones if they are too many for 32-bit offsets.
template <typename Id>
XmlSection cellSection(const std::string& name, const Cells<Id>& cells)
{
  const auto add = [&](auto zero)
  {
    using Stored = decltype(zero);
    const auto id = [ids = cells.Ids](std::size_t i) { return ids[i]; };
    const auto offset = [corners = cells.Corners](std::size_t i) { return (i + 1) * corners; };
    return XmlSection{ name,
      { computedXmlArray<Stored>("connectivity", cells.idCount(), id),
        computedXmlArray<Stored>("offsets", cells.Count, offset) },
      "" };
  };
  const bool isNarrow = sizeof(Id) == sizeof(std::int32_t) &&
    cells.idCount() <= std::size_t(std::numeric_limits<std::int32_t>::max());
  return isNarrow ? add(std::int32_t()) : add(std::int64_t());
}

template <typename Id>
bool writePolyData(const std::string& path, const NodesView& nodes, const Cells<Id>& cells,
  const std::vector<std::int64_t>& neighbors, const MeshOptions& options)
{
  const XmlPiece piece{ "PolyData",
    { { "NumberOfPoints", nodes.size() }, { "NumberOfVerts", 0 }, { "NumberOfLines", 0 },
      { "NumberOfStrips", 0 }, { "NumberOfPolys", cells.Count } },
    { pointData(nodes, options), cellData(neighbors, cells.Corners, options.Regions),
      { "Points", { pointsArray(nodes) }, "" }, cellSection("Polys", cells) } };
  return writeXmlPiece(path, options.Before, piece, options.Aborted);
}

/// Writes a .vtu file.
template <typename Id>
bool writeGrid(const std::string& path, const NodesView& nodes, const Cells<Id>& cells,
  const std::vector<std::int64_t>& neighbors, const MeshOptions& options)
{
  constexpr int vtkTriangle = 5;
  constexpr int vtkTetra = 10;
  XmlSection section = cellSection("Cells", cells);
  const int type = cells.Corners == 3 ? vtkTriangle : vtkTetra;
  section.Arrays.push_back(
    computedXmlArray<std::uint8_t>("types", cells.Count, [type](std::size_t) { return type; }));
  const XmlPiece piece{ "UnstructuredGrid",
    { { "NumberOfPoints", nodes.size() }, { "NumberOfCells", cells.Count } },
    { pointData(nodes, options), cellData(neighbors, cells.Corners, options.Regions),
      { "Points", { pointsArray(nodes) }, "" }, section } };
  return writeXmlPiece(path, options.Before, piece, options.Aborted);
}

} // namespace

namespace
{

/// The function that writes the files of this opener; null if they are no text.
bool (*textWriterOf(Opener opener))(
  const std::string&, const NodesView&, TrianglesView, const MeshOptions&)
{
  switch (opener)
  {
    case Opener::Adcirc:
      return &writeAdcircGrid;
    case Opener::Sms:
      return &writeSmsMesh;
    case Opener::Gmsh:
      return &writeGmshMesh;
    case Opener::Triangle:
      return &writeTriangleFiles;
    default:
      return nullptr;
  }
}

} // namespace

namespace
{

UgridContent ugridOf(
  const NodesView& nodes, const TrianglesView& triangles, const MeshOptions& options)
{
  UgridContent content;
  content.Nodes = std::int64_t(nodes.size());
  content.Triangles = std::int64_t(triangles.size());
  content.Crs = options.Crs;
  content.Node = [&nodes](std::int64_t node) { return nodes[std::size_t(node)]; };
  content.Corner = [&triangles](std::int64_t triangle, int corner)
  { return triangles.id(std::size_t(triangle), corner); };
  for (const NodeColumn& column : nodes.columns())
  {
    content.Arrays.push_back({ column.Name, "", "", Scalar::Float64, false, false,
      [&column](std::size_t) { return column.Values; } });
  }
  const std::vector<std::int64_t>& ids = options.Representatives;
  if (!ids.empty())
  {
    content.Arrays.push_back({ "RepresentativePointId", "", "", Scalar::Int64, false, false,
      [&ids](std::size_t) { return ids.data(); } });
  }
  if (!options.Regions.empty())
  {
    content.Arrays.push_back({ "Region", "", "", Scalar::Int32, true, false,
      [regions = options.Regions](std::size_t) { return regions.data(); } });
  }
  return content;
}

} // namespace

bool writeMesh(const std::string& path, const NodesView& nodes, TrianglesView triangles,
  const MeshOptions& options)
{
  const Opener opener = openerOf(path, Use::WritesTriangles);
  if (opener == Opener::None)
  {
    throw IOError(path,
      "has no extension that tells a kind of mesh file; use " + listFormats(Use::WritesTriangles) +
        ".");
  }
  if (opener == Opener::Npy)
  {
    return triangles.withIds(
      [&](const auto* ids) { return writeNpy(path, ids, triangles.size(), 3, options); });
  }
  if (opener == Opener::Netcdf)
  {
    return writeUgrid(path, ugridOf(nodes, triangles, options), options.Before, options.Aborted);
  }
  if (const auto writer = textWriterOf(opener))
  {
    return writer(path, nodes, triangles, options);
  }
  return triangles.withIds(
    [&](const auto* ids)
    {
      std::vector<std::int64_t> neighbors(options.Neighbors ? 3 * triangles.size() : 0);
      if (options.Neighbors)
      {
        findNeighbors(ids, triangles.size(), neighbors.data());
      }
      const Cells cells{ ids, triangles.size(), 3 };
      return extensionOf(path) == ".vtp" ? writePolyData(path, nodes, cells, neighbors, options)
                                         : writeGrid(path, nodes, cells, neighbors, options);
    });
}

std::vector<std::string> filesOfMesh(const std::string& path, bool hasSegments)
{
  std::vector<std::string> files{ path };
  const auto add = [&](const char* extension)
  {
    if (extensionOf(path) != extension)
    {
      files.push_back(triangleFileBeside(path, extension));
    }
  };
  if (isOpenedBy(path, Opener::Triangle))
  {
    add(".node");
    add(".ele");
    if (hasSegments)
    {
      add(".poly");
    }
  }
  return files;
}

std::vector<std::string> filesOfMeshes(const std::vector<std::string>& paths)
{
  std::vector<std::string> all;
  for (const std::string& path : paths)
  {
    const std::vector<std::string> files = filesOfMesh(path, false);
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

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
  const Opener opener = openerOf(path, Use::WritesTetrahedra);
  if (opener == Opener::Npy)
  {
    return writeNpy(path, ids, tetrahedra, 4, options);
  }
  if (opener != Opener::Vtk)
  {
    throw IOError(path,
      "has no extension that tells a kind of file of tetrahedra; use " +
        listFormats(Use::WritesTetrahedra) + ".");
  }
  points.Columns[requireElevation(points, path)].Name = "z"; // makes it the third coordinate
  return writeGrid(path, points, Cells{ ids, tetrahedra, 4 }, neighbors, options);
}

bool holdsTriangles(const std::string& path)
{
  const Opener opener = openerOf(path, Use::Triangles);
  return isModelMesh(path) || (opener == Opener::Vtk && holdsVtkTriangles(path));
}

bool holdsTetrahedra(const std::string& path)
{
  if (isOpenedBy(path, Opener::Npy))
  {
    const NpyReader reader(path);
    return reader.columns() == 4 && !reader.isFloat();
  }
  return (extensionOf(path) == ".vtu" || extensionOf(path) == ".vtk") && holdsVtkTetrahedra(path);
}

StoredTetrahedra readTetrahedra(const std::string& path)
{
  return isOpenedBy(path, Opener::Npy)
    ? StoredTetrahedra{ readNpyIds(path, 4, "tetrahedra"), {}, {} }
    : readVtkTetrahedra(path);
}

} // namespace tipp

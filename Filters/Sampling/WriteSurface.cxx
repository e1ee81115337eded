// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/WriteSurface.h"

#include "Files/InputFile.h"
#include "Files/WriteVtkXml.h"

#include <cstddef>
#include <cstdint>
#include <limits>

namespace tipp
{
namespace
{

constexpr std::size_t corners = 3;

/// The section of the triangles: 32-bit ids and offsets if they fit, whatever the mesh has.
XmlSection cellSection(const std::string& name, const SimplexMesh& mesh)
{
  const std::size_t cells = std::size_t(mesh.Cells);
  const auto id = [&mesh](std::size_t i)
  {
    return mesh.Wide ? static_cast<const std::int64_t*>(mesh.Ids)[i]
                     : std::int64_t(static_cast<const std::int32_t*>(mesh.Ids)[i]);
  };
  const auto add = [&](auto zero)
  {
    using Id = decltype(zero);
    const auto offset = [](std::size_t i) { return (i + 1) * corners; };
    return XmlSection{ name,
      { computedXmlArray<Id>("connectivity", corners * cells, id),
        computedXmlArray<Id>("offsets", cells, offset) },
      "" };
  };
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  const bool isNarrow = mesh.PointCount <= most && mesh.Cells <= most / std::int64_t(corners);
  return isNarrow ? add(std::int32_t()) : add(std::int64_t());
}

XmlArray pointsArray(const SimplexMesh& mesh)
{
  const std::size_t count = 3 * std::size_t(mesh.PointCount);
  return mesh.Float ? xmlArray("Points", static_cast<const float*>(mesh.Points), count, 3)
                    : xmlArray("Points", static_cast<const double*>(mesh.Points), count, 3);
}

} // namespace

void writeSurface(const std::string& path, const PathState& before, const SimplexMesh& triangles,
  const std::vector<SurfaceMeans>& means)
{
  const bool isPolyData = extensionOf(path) == ".vtp";
  const std::uint64_t points = std::uint64_t(triangles.PointCount);
  const std::uint64_t cells = std::uint64_t(triangles.Cells);
  XmlSection cellData{ "CellData", {}, "" };
  for (const SurfaceMeans& mean : means)
  {
    cellData.Arrays.push_back(
      xmlArray(mean.Name, mean.Values.data(), mean.Values.size(), mean.Components));
  }
  XmlPiece piece;
  piece.Type = isPolyData ? "PolyData" : "UnstructuredGrid";
  piece.Counts = { { "NumberOfPoints", points } };
  if (isPolyData)
  {
    piece.Counts.insert(piece.Counts.end(),
      { { "NumberOfVerts", 0 }, { "NumberOfLines", 0 }, { "NumberOfStrips", 0 },
        { "NumberOfPolys", cells } });
  }
  else
  {
    piece.Counts.emplace_back("NumberOfCells", cells);
  }
  piece.Sections = { { "PointData", {}, "" }, cellData,
    { "Points", { pointsArray(triangles) }, "" },
    cellSection(isPolyData ? "Polys" : "Cells", triangles) };
  if (!isPolyData)
  {
    constexpr std::uint8_t vtkTriangle = 5;
    piece.Sections.back().Arrays.push_back(computedXmlArray<std::uint8_t>(
      "types", std::size_t(cells), [](std::size_t) { return vtkTriangle; }));
  }
  writeXmlPiece(path, before, piece);
}

} // namespace tipp

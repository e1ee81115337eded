// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ReadConstraintFile.h"

#include "Files/IOError.h"
#include "Raster/GdalLibrary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tipp
{

namespace
{

/// Collects the edges of geometries.
class VectorEdges
{
public:
  void add(OGRGeometryH geometry)
  {
    const OGRwkbGeometryType kind = kindOf(geometry);
    if (kind == wkbLineString)
    {
      this->addLine(geometry, this->Table.Edges);
      return;
    }
    // The rings of a polygon, or the members of a collection. Other kinds of geometry have none.
    const int parts = gdal().OGR_G_GetGeometryCount(geometry);
    for (int i = 0; i < parts; ++i)
    {
      const OGRGeometryH part = gdal().OGR_G_GetGeometryRef(geometry, i);
      kind == wkbPolygon ? this->addRing(part, i == 0) : this->add(part);
    }
  }

  ConstraintTable take()
  {
    ConstraintTable& table = this->Table;
    table.PolygonBegin = table.Edges.size();
    table.Edges.insert(table.Edges.end(), this->PolygonEdges.begin(), this->PolygonEdges.end());
    if (std::all_of(
          table.Height.begin(), table.Height.end(), [](double z) { return std::isnan(z); }))
    {
      table.Height.clear();
    }
    return std::move(table);
  }

private:
  using Edges = std::vector<std::array<std::int64_t, 2>>;

  static OGRwkbGeometryType kindOf(OGRGeometryH geometry)
  {
    return gdal().OGR_GT_Flatten(gdal().OGR_G_GetGeometryType(geometry));
  }

  /// Appends the edges of a line. Returns the index of its first point.
  std::size_t addLine(OGRGeometryH line, Edges& edges)
  {
    const auto first = std::int64_t(this->Table.XY.size() / 2);
    const int points = gdal().OGR_G_GetPointCount(line);
    const bool hasHeight = gdal().OGR_G_Is3D(line) != 0;
    for (int i = 0; i < points; ++i)
    {
      this->Table.XY.push_back(gdal().OGR_G_GetX(line, i));
      this->Table.XY.push_back(gdal().OGR_G_GetY(line, i));
      this->Table.Height.push_back(hasHeight ? gdal().OGR_G_GetZ(line, i) : std::nan(""));
      if (i > 0)
      {
        edges.push_back({ first + i - 1, first + i });
      }
    }
    return std::size_t(first);
  }

  void addRing(OGRGeometryH ring, bool isOuter)
  {
    Edges edges;
    const std::size_t first = this->addLine(ring, edges);
    const std::vector<double>& xy = this->Table.XY;
    double area = 0;
    for (const auto& edge : edges)
    {
      const auto at = [&](std::int64_t id, std::size_t axis)
      { return xy[2 * std::size_t(id) + axis] - xy[2 * first + axis]; };
      area += at(edge[0], 0) * at(edge[1], 1) - at(edge[1], 0) * at(edge[0], 1);
    }
    for (auto& edge : edges)
    {
      if ((area > 0) != isOuter)
      {
        std::swap(edge[0], edge[1]);
      }
      this->PolygonEdges.push_back(edge);
    }
  }

  ConstraintTable Table;
  Edges PolygonEdges;
};

} // namespace

void forFeatures(
  const std::string& path, const std::function<void(OGRFeatureH, OGRGeometryH)>& visit)
{
  gdal().CPLErrorReset();
  const GdalDataSet file(
    gdal().GDALOpenEx(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, nullptr, nullptr));
  if (!file)
  {
    const std::string reason = gdal().CPLGetLastErrorMsg();
    throw IOError(path,
      "cannot be read as lines or polygons" +
        (reason.empty() ? std::string(".") : " (" + reason + ")."));
  }
  const int layers = gdal().GDALDatasetGetLayerCount(file.get());
  for (int i = 0; i < layers; ++i)
  {
    const OGRLayerH layer = gdal().GDALDatasetGetLayer(file.get(), i);
    gdal().OGR_L_ResetReading(layer);
    while (const OGRFeatureH feature = gdal().OGR_L_GetNextFeature(layer))
    {
      const GdalOwner<OGRFeatureH, &GdalLibrary::OGR_F_Destroy> held(feature);
      const OGRGeometryH geometry = gdal().OGR_F_GetGeometryRef(feature);
      const bool isCurved = geometry && gdal().OGR_G_HasCurveGeometry(geometry, 1);
      const GdalOwner<OGRGeometryH, &GdalLibrary::OGR_G_DestroyGeometry> straight(
        isCurved ? gdal().OGR_G_GetLinearGeometry(geometry, 0, nullptr) : nullptr);
      visit(feature, isCurved ? straight.get() : geometry);
    }
  }
  if (gdal().CPLGetLastErrorType() >= CE_Failure)
  {
    throw IOError(path, "is damaged (" + std::string(gdal().CPLGetLastErrorMsg()) + ").");
  }
}

ConstraintTable readVectorFile(const std::string& path)
{
  VectorEdges edges;
  forFeatures(path,
    [&edges](OGRFeatureH, OGRGeometryH geometry) { geometry ? edges.add(geometry) : void(); });
  return edges.take();
}

} // namespace tipp

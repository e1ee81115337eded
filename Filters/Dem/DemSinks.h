// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDemSinks_h
#define tippDemSinks_h

#include "Constraints/SurfaceValues.h"
#include "Constraints/TableConstraints.h"
#include "Dem/RasterTiles.h"
#include "Dem/TerrainSampler.h"
#include "Dem/TileStore.h"
#include "OutOfCore/TriangleConsumer.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// Whether points of the constraints need values from the surface for these bands.
VTKTIPPFILTERS_EXPORT bool needsSurface(
  const TableConstraints& constraints, const std::vector<std::string>& bands);

/// Evaluates the surface of the input points at the points of constraints (see
/// TableConstraints::Surface), during an out-of-core triangulation of the input points.
class VTKTIPPFILTERS_EXPORT SurfaceSink : public TriangleConsumer
{
public:
  explicit SurfaceSink(const TableConstraints& constraints);

  /// Moves out the values: for each column those at the points of both tables, NaN outside of the
  /// surface. On the first rank, after the run.
  std::vector<std::vector<double>> takeValues() { return std::move(this->Values); }

  /// Returns the heights among these values, which may be none. Call it before takeValues().
  std::vector<double> heights() const
  {
    return this->Elevation < this->Values.size() ? this->Values[this->Elevation]
                                                 : std::vector<double>();
  }

  std::string identity() const override { return this->Identity; }
  std::uint64_t fileBytes(const Box2&, const std::vector<std::string>&) const override;
  void begin(
    const Box2&, const std::vector<std::string>& columns, const std::string& files) override;
  void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) override;
  bool end(const std::function<bool(double)>& progress) override;

private:
  const std::string Identity;
  const std::vector<Point2> Positions;
  const SurfacePositions Wanted;
  std::size_t Columns = 0;
  std::size_t Elevation = 0; ///< index of the column of heights; Columns: there is none
  std::string Files;
  std::vector<std::vector<double>> Values;
};

/// Samples the triangles of an out-of-core triangulation and discards them. Pixels are kept in a
/// TileStore until all are known.
class VTKTIPPFILTERS_EXPORT RasterSink : public TriangleConsumer
{
public:
  /// Returns the settings once the points' bounds and columns are known.
  using MakeSettings =
    std::function<TerrainSettings(const Box2& bounds, const std::vector<std::string>& columns)>;
  /// Writes the raster from its tiles. Returns false if `progress` stopped it.
  using WriteRaster = std::function<bool(const TerrainSettings& settings, const TileSource& tiles,
    const std::function<bool(double)>& progress)>;

  /// `writeRaster` is called on the first rank. `encoding` describes the raster's file, so that
  /// finished tiles are encoded during the run; without it they are not.
  RasterSink(MakeSettings makeSettings, WriteRaster writeRaster,
    const std::optional<RasterDescription>& encoding = std::nullopt);

  /// Sets a text that identifies everything besides the points that must not change in a resumed
  /// run. First rank only.
  void setIdentity(const std::string& identity) { this->Identity = identity; }

  std::string identity() const override { return this->Identity; }
  std::uint64_t fileBytes(
    const Box2& bounds, const std::vector<std::string>& columns) const override;
  void begin(
    const Box2& bounds, const std::vector<std::string>& columns, const std::string& files) override;
  void take(const std::string& name, const double* rows, const PointRowLayout& layout,
    std::size_t points, const std::vector<TriangleRange>& triangles) override;
  bool end(const std::function<bool(double)>& progress) override;

private:
  struct Part;
  struct Tile;

  RasterWindow windowOf(const Box2& box) const;
  void sampleByTile(Part& part, const std::vector<TriangleRange>& triangles) const;
  void sampleTile(Part& part, const Tile& tile) const;
  void requireSingles(const BandValues& values) const;
  void answerBorders();

  std::string Identity;
  const MakeSettings Make;
  const WriteRaster Write;
  const std::optional<RasterDescription> Encoding;
  TerrainSettings Settings;
  std::array<double, 2> Margins{}; ///< along x and y, how far rounding may move a coordinate
  std::string Files;
  std::unique_ptr<TileStore> Store;
};

} // namespace tipp

#endif

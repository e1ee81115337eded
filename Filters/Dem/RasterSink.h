// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRasterSink_h
#define tippRasterSink_h

#include "Dem/MakeDem.h"
#include "Dem/TileStore.h"
#include "OutOfCore/OutOfCoreTriangulation.h"

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

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
  /// finished tiles are encoded during the run; null: they are not.
  RasterSink(MakeSettings makeSettings, WriteRaster writeRaster, const RasterDescription* encoding);

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
  void addTriangle(Part& part, const std::int32_t* corners) const;
  void sampleTile(Part& part, const Tile& tile) const;
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

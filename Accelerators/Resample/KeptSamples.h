// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippKeptSamples_h
#define tippKeptSamples_h

#include "Parallel/ParallelFor.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace tipp
{

/// The triangles that contain the samples of a lattice, with what interpolation needs of them, so
/// that field after field can be interpolated without the mesh: the time steps of a simulation, for
/// example.
///
/// The samples are kept in tiles of 16 rows. In a tile each triangle has a slot. A field is
/// interpolated by computing its gradient in each slot's triangle, and then from the gradients the
/// samples: both in arrays that fit into the first cache. The bits of the results are those of
/// resample().
class VTKTIPPACCELERATORS_EXPORT KeptSamples
{
public:
  /// Finds the triangle of each sample, as claimSamples() does. The mesh needs fewer than 2^31
  /// points and triangles, and may be freed afterwards. Nothing if `report` stopped the work.
  static std::optional<KeptSamples> find(
    const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& report = {});

  std::int64_t samples() const { return this->Width * this->Height; }
  /// The number of samples in triangles.
  std::int64_t inside() const { return this->Inside; }
  std::size_t bytes() const; ///< memory in use

  /// Interpolates a field linearly from its values at the mesh's points. A sample is NaN if a
  /// corner of its triangle is. `null`: for the samples outside. `stride`: the distance between
  /// consecutive values, and between samples, such as 3 for one component of a vector.
  template <typename Value, typename Sample>
  void fromPoints(
    const Value* values, Sample* samples, Sample null, int threads, int stride = 1) const;

  /// Takes a field from its values at the mesh's triangles.
  template <typename Value, typename Sample>
  void fromCells(
    const Value* values, Sample* samples, Sample null, int threads, int stride = 1) const;

  /// Interpolates a water level that is NaN at dry points. In triangles with wet and dry points,
  /// the dry points get the mean of the wet ones, and samples where the level is not above the
  /// ground are dry. `ground`: the ground's elevation at the samples. Dry samples are NaN.
  template <typename Value, typename Sample>
  void waterLevel(
    const Value* values, const Sample* ground, Sample* samples, Sample null, int threads) const;

private:
  static constexpr std::int64_t TileRows = 16;
  static constexpr std::int64_t TileColumns = 64;
  static constexpr std::int64_t StripTiles = 32;

  /// The part of the lattice in a tile.
  struct TileBox
  {
    std::int64_t Row;
    std::int64_t Column;
    std::int64_t Rows;
    std::int64_t Columns;
  };

  /// The slots of a tile, a multiple of four of them. The last triangle's slot is followed by at
  /// least one without triangle, which the samples outside have. Arrays of `Slots` numbers follow
  /// each other, from FirstNumber and FirstId on.
  struct Tile
  {
    std::int32_t Triangles; ///< slots with triangles
    std::int32_t Slots;
    std::size_t FirstNumber; ///< in Strip::Numbers: six arrays
    std::size_t FirstId;     ///< in Strip::Ids: four arrays
  };

  /// A sample that is computed from weights: in a thin triangle, or near the mesh's border.
  struct Weighted
  {
    std::int64_t Sample;
    std::int32_t Ids[3];
    std::int32_t Cell;
    double Weights[2]; ///< of the second and the third point; the first has the remainder
  };

  /// Consecutive tiles: the work of a thread at a time.
  struct Strip
  {
    std::vector<Tile> Tiles;
    std::vector<std::uint16_t> SlotOfSample; ///< tile by tile, row by row
    /// Gradients of the weights of the second and third corner along both axes, and the first
    /// corner's coordinates.
    std::vector<double> Numbers;
    std::vector<std::int32_t> Ids; ///< of the three corners, and the triangle's index
    std::vector<Weighted> Special; ///< by ascending sample
  };

  class Builder;
  template <typename Value, typename Sample>
  class Evaluation;

  std::int64_t tileCount() const { return this->TilesAcross * this->TilesDown; }
  TileBox boxOf(std::int64_t tile) const;

  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t TilesAcross = 0;
  std::int64_t TilesDown = 0;
  std::int64_t Inside = 0;
  std::vector<double> U; ///< coordinates of the columns
  std::vector<double> V; ///< coordinates of the rows
  std::vector<Strip> Strips;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearBorder_h
#define tippNearBorder_h

#include "Parallel/ParallelFor.h"
#include "Resample/Claims.h"
#include "Resample/Resample.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Marks for square blocks of samples. A block is marked if a sample that no cell claims lies in it
/// or next to it. Most blocks, and the cells in them, have no such sample.
class OpenBlocks
{
public:
  explicit OpenBlocks(const LatticeAxes& axes);

  /// Adds the samples for which isOpen(sample) is true.
  template <typename IsOpen>
  void add(const IsOpen& isOpen, int threads)
  {
    const std::int64_t width = this->Axes.U.size();
    forChunks(this->Axes.V.size(), 16, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t row = begin; row < end; ++row)
        {
          for (std::int64_t i = 0; i < width; ++i)
          {
            isOpen(row * width + i) ? this->mark(i, row) : void();
          }
        }
      });
  }

  bool any() const;

  /// The number of the block that a point lies in, with `Marked` if the block is marked.
  std::uint32_t blockOf(const std::array<double, 2>& point) const
  {
    const std::uint32_t block = indexOf(this->Axes.V, point[1]) >> this->Shift << this->RowBits |
      indexOf(this->Axes.U, point[0]) >> this->Shift;
    return this->Marks[block] != 0 ? block | Marked : block;
  }
  static constexpr std::uint32_t Marked = std::uint32_t(1) << 31;

  /// Whether a block in the box around these blocks is marked.
  bool anyAround(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

private:
  void mark(std::int64_t column, std::int64_t row);
  /// The index of the last sample that is not beyond a coordinate, up to rounding.
  static std::uint32_t indexOf(const LatticeAxis& axis, double coordinate)
  {
    return std::uint32_t(std::clamp(int(axis.position(coordinate)) - 1, 0, axis.size() - 1));
  }

  const LatticeAxes& Axes;
  int Shift = 4;   ///< a block has 2^Shift samples along each axis
  int RowBits = 0; ///< a row of blocks has 2^RowBits numbers
  std::vector<unsigned char> Marks;
};

/// Returns the samples without a claim that lie outside of all triangles, but within the lattice's
/// Slack of one, sorted. `isOpen` tells which samples no cell claims, and `blocks` where they are.
/// There are none for tetrahedra. The mesh may be a part of a larger one.
std::vector<NearSample> nearSamples(const SimplexMesh& mesh, const LatticeAxes& axes, int threads,
  const OpenBlocks& blocks, const std::function<bool(std::int64_t)>& isOpen);

/// nearSamples() for the samples whose value in `claimed` is `open`.
template <typename T>
std::vector<NearSample> nearSamplesOf(
  const SimplexMesh& mesh, const LatticeAxes& axes, int threads, const T* claimed, T open)
{
  if (mesh.Dimension != 2 || !(std::max(axes.U.Slack, axes.V.Slack) > 0) || axes.samples() == 0)
  {
    return {};
  }
  const auto isOpen = [claimed, open](std::int64_t sample) { return claimed[sample] == open; };
  OpenBlocks blocks(axes);
  blocks.add(isOpen, threads);
  return blocks.any() ? nearSamples(mesh, axes, threads, blocks, isOpen)
                      : std::vector<NearSample>();
}

/// Fills the attributes' samples: with the value at the nearest point of the triangle's border, as
/// interpolate() does. `parents` is ResampleOptions::Parents.
void fillNear(const std::vector<NearSample>& samples, const std::vector<Attribute>& attributes,
  const std::int64_t* parents);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNearBorder_h
#define tippNearBorder_h

#include "Parallel/ParallelFor.h"
#include "Resample/Attribute.h"
#include "Resample/Claims.h"
#include "Resample/GroupBoxes.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Marks for square blocks of samples that have a sample that no cell claims. Most blocks, and the
/// cells in them, have none.
class OpenBlocks
{
public:
  explicit OpenBlocks(const LatticeAxes& axes);

  /// Adds the samples for which isOpen(sample) is true.
  template <typename IsOpen>
  void add(const IsOpen& isOpen, int threads)
  {
    const std::int64_t size = std::int64_t(1) << this->Shift;
    // A chunk is a row of blocks.
    forChunks(this->Axes.V.size(), size, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        unsigned char* const marks = this->Marks.data() + (begin >> this->Shift) * this->Columns;
        for (std::int64_t row = begin; row < end; ++row)
        {
          for (std::int64_t block = 0; block < this->Columns; ++block)
          {
            const std::int64_t first = row * this->Axes.U.size() + block * size;
            const std::int64_t count = std::min(size, this->Axes.U.size() - block * size);
            unsigned char open = 0;
            for (std::int64_t i = 0; i < count; ++i) // without a branch: uses SIMD
            {
              open = (unsigned char)(open | isOpen(first + i));
            }
            marks[block] = (unsigned char)(marks[block] | open);
          }
        }
      });
  }

  bool any() const;

  /// Whether a block with a sample in the box, or one step beside it, is marked.
  bool isAnyMarkedIn(const SampleBox& box) const;

private:
  const LatticeAxes& Axes;
  int Shift = 4;            ///< a block has 2^Shift samples along each axis
  std::int64_t Columns = 0; ///< number of blocks along u
  std::vector<unsigned char> Marks;
};

/// Returns the samples without a claim that lie outside of all triangles, but within the lattice's
/// Slack of one, sorted. `isOpen` tells which samples no cell claims, and `blocks` where they are.
/// There are none for tetrahedra. The mesh may be a part of a larger one. Unknown `boxes` cost time
/// only.
std::vector<NearSample> nearSamples(const SimplexMesh& mesh, const LatticeAxes& axes, int threads,
  const GroupBoxes& boxes, const OpenBlocks& blocks,
  const std::function<bool(std::int64_t)>& isOpen);

/// nearSamples() for the samples whose value in `claimed` is `open`.
template <typename T>
std::vector<NearSample> nearSamplesOf(const SimplexMesh& mesh, const LatticeAxes& axes, int threads,
  const GroupBoxes& boxes, const T* claimed, T open)
{
  if (mesh.Dimension != 2 || !(std::max(axes.U.Slack, axes.V.Slack) > 0) || axes.samples() == 0)
  {
    return {};
  }
  const auto isOpen = [claimed, open](std::int64_t sample) { return claimed[sample] == open; };
  OpenBlocks blocks(axes);
  blocks.add(isOpen, threads);
  return blocks.any() ? nearSamples(mesh, axes, threads, boxes, blocks, isOpen)
                      : std::vector<NearSample>();
}

/// Fills the attributes' samples: with the value at the nearest point of the triangle's border, as
/// interpolate() does. `parents` is ResampleOptions::Parents.
void fillNear(const std::vector<NearSample>& samples, const std::vector<Attribute>& attributes,
  const std::int64_t* parents);

} // namespace tipp

#endif

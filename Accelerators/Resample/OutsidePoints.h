// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutsidePoints_h
#define tippOutsidePoints_h

#include "Parallel/ParallelFor.h"
#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstdint>
#include <memory>

namespace tipp
{

/// For each point a mask of the lattice's sides that it lies beyond. A cell whose points all lie
/// beyond one side has no samples. The test reads a byte per point, where the points themselves
/// would be random accesses to memory.
template <typename Access>
class OutsidePoints
{
public:
  static constexpr int D = Access::Dimension;

  OutsidePoints(const SimplexMesh& mesh, const LatticeAxis* const (&axes)[3])
    : Cells(mesh)
    , Count(mesh.PointCount)
    , Worthwhile(mesh.Cells > mesh.PointCount)
  {
    for (int axis = 0; axis < D; ++axis)
    {
      const LatticeAxis& samples = *axes[axis];
      const bool empty = samples.size() == 0;
      this->Low[axis] = empty ? 0 : samples[0];
      this->High[axis] = empty ? 0 : samples[samples.size() - 1];
    }
  }

  /// Computes the masks if most points are outside; otherwise there are none.
  void find(int threads)
  {
    if (!this->Worthwhile || !this->mostAreOutside())
    {
      return;
    }
    this->Sides.reset(new unsigned char[std::size_t(this->Count)]);
    forChunks(this->Count, 1 << 16, threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t id = begin; id < end; ++id)
        {
          this->Sides[std::size_t(id)] = this->sidesOf(id);
        }
      });
  }

  bool found() const { return this->Sides != nullptr; }
  /// A bit for each side that a point lies beyond; null before find().
  const unsigned char* sides() const { return this->Sides.get(); }

  /// Whether a cell certainly has no samples; false before find().
  [[gnu::always_inline]] bool contain(std::int64_t cell) const
  {
    if (!this->Sides)
    {
      return false;
    }
    int common = 0xff;
    for (int i = 0; i <= D; ++i)
    {
      common &= this->Sides[std::size_t(this->Cells.ids(cell)[i])];
    }
    return common != 0;
  }

private:
  [[gnu::always_inline]] unsigned char sidesOf(std::int64_t id) const
  {
    double p[D];
    this->Cells.coordinates(id, p);
    int sides = 0;
    for (int axis = 0; axis < D; ++axis)
    {
      sides |= int(p[axis] < this->Low[axis]) << (2 * axis);
      sides |= int(p[axis] > this->High[axis]) << (2 * axis + 1);
    }
    return (unsigned char)(sides);
  }

  bool mostAreOutside() const
  {
    const std::int64_t step = std::max<std::int64_t>(1, this->Count / 1000);
    std::int64_t outside = 0;
    std::int64_t seen = 0;
    for (std::int64_t id = 0; id < this->Count; id += step, ++seen)
    {
      outside += this->sidesOf(id) != 0;
    }
    return 3 * outside > 2 * seen;
  }

  Access Cells;
  std::int64_t Count;
  bool Worthwhile;
  double Low[D];
  double High[D];
  std::unique_ptr<unsigned char[]> Sides;
};

} // namespace tipp

#endif

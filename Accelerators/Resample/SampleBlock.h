// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleBlock_h
#define tippSampleBlock_h

#include "Resample/CellVisitor.h"
#include "Resample/Weights.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// Some samples that cells claim, grouped by cell, and their weights.
///
/// Most cells have a sample or two, and how many cannot be predicted; so samples are gathered
/// first, and what takes time is done in loops over many cells or many samples.
template <typename Access>
class SampleBlock
{
public:
  static constexpr int D = Access::Dimension;
  static constexpr int Capacity = 512;

  struct Sample
  {
    std::int64_t Place; ///< among the lattice's
    std::int32_t Column;
    std::int32_t Row;
    std::int32_t Layer;
    std::int32_t Group;
  };

  /// Samples with one cell.
  struct Group
  {
    std::int64_t Corners[D + 1]; ///< point ids, in the lexicographic order of the coordinates
    std::int32_t Cell;
  };

  SampleBlock(const SimplexMesh& mesh, const LatticeAxes& axes)
    : Cells(mesh)
    , Axes(axes)
    , Samples(std::size_t(Capacity + Stride))
    , Groups(std::size_t(Capacity + 2))
    , Solvers(std::size_t(Capacity))
    , WeightValues(std::size_t(D * Capacity))
  {
  }

  int room() const { return Capacity - this->Size; }

  void clear()
  {
    this->Size = 0;
    this->LastGroup = -1;
    this->LastCell = -1;
  }

  /// Adds samples of a row, at most room() of them; 0 or fewer: none.
  [[gnu::always_inline]] void add(std::int32_t cell, const SampleRow& row, int begin, int count)
  {
    const int group = this->LastGroup + int(cell != this->LastCell);
    this->Groups[std::size_t(group)].Cell = cell;
    this->LastGroup = count > 0 ? group : this->LastGroup;
    this->LastCell = count > 0 ? cell : this->LastCell;
    Sample* const samples = this->Samples.data() + this->Size;
    const auto write = [&](int i) {
      samples[i] = { row.First + begin + i, begin + i, row.Row, row.Layer, group };
    };
    // So many at a time, and what is too much is overwritten by the next.
    for (int i = 0; i < Stride; ++i)
    {
      write(i);
    }
    for (int i = Stride; i < count; ++i)
    {
      write(i);
    }
    this->Size += count > 0 ? count : 0;
  }

  /// Finds the corners of all groups and the weights of all samples.
  void weigh()
  {
    for (int i = 0; i < this->groups(); ++i)
    {
      this->load(i);
    }
    for (int j = 0; j < this->Size; ++j)
    {
      const Sample& sample = this->Samples[std::size_t(j)];
      const double at[3] = { this->Axes.U[sample.Column], this->Axes.V[sample.Row],
        D == 3 ? this->Axes.W[sample.Layer] : 0 };
      double weights[D];
      this->Solvers[std::size_t(sample.Group)].solve(at, weights);
      for (int i = 0; i < D; ++i)
      {
        this->WeightValues[std::size_t(i) * Capacity + std::size_t(j)] = weights[i];
      }
    }
  }

  int size() const { return this->Size; }
  const Sample& operator[](int j) const { return this->Samples[std::size_t(j)]; }
  /// Weight of corner i + 1 for each sample.
  const double* weights(int i) const { return this->WeightValues.data() + i * Capacity; }

  int groups() const { return this->LastGroup + 1; }
  const Group& group(int i) const { return this->Groups[std::size_t(i)]; }

private:
  /// Samples that add() writes at a time.
  static constexpr int Stride = 4;

  using Corners = typename CellGeometry<D>::Corners;

  static void toArray(const Point2& corner, double* array)
  {
    array[0] = corner.x;
    array[1] = corner.y;
  }
  static void toArray(const Point3& corner, double* array)
  {
    array[0] = corner.x;
    array[1] = corner.y;
    array[2] = corner.z;
  }

  void load(int i)
  {
    Group& group = this->Groups[std::size_t(i)];
    Corners corners;
    this->Cells.corners(group.Cell, corners);
    // Without branches, of which half would be mispredicted.
    int ranks[D + 1] = {};
    for (int a = 0; a <= D; ++a)
    {
      for (int b = a + 1; b <= D; ++b)
      {
        const bool swapped = lexicographicLess(corners[b], corners[a]);
        ranks[a] += int(swapped);
        ranks[b] += int(!swapped);
      }
    }
    double sorted[D + 1][D];
    for (int a = 0; a <= D; ++a)
    {
      group.Corners[ranks[a]] = this->Cells.ids(group.Cell)[a];
      toArray(corners[a], sorted[ranks[a]]);
    }
    this->Solvers[std::size_t(i)].set(sorted);
  }

  Access Cells;
  const LatticeAxes& Axes;
  int Size = 0;
  int LastGroup = -1;
  std::int32_t LastCell = -1;
  std::vector<Sample> Samples;
  std::vector<Group> Groups;
  std::vector<Weights<D>> Solvers; ///< one a group
  std::vector<double> WeightValues;
};

} // namespace tipp

#endif

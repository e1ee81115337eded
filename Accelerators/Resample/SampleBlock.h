// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleBlock_h
#define tippSampleBlock_h

#include "Resample/CellVisitor.h"
#include "Resample/Lanes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// Barycentric weights of samples in a thin triangle (D = 2) or tetrahedron (D = 3): those of all
/// corners but the first, whose weight is the remainder.
///
/// Elimination with complete pivoting has a small residual: the weighted sum of the corners is the
/// sample to a few roundings, so linear fields are reproduced, however thin the cell is.
template <int D>
class ThinWeights
{
public:
  /// `edges`: from the first corner to each of the others.
  explicit ThinWeights(const double (&edges)[D][D])
  {
    for (int axis = 0; axis < D; ++axis)
    {
      for (int i = 0; i < D; ++i)
      {
        this->Matrix[axis][i] = edges[i][axis];
      }
    }
    this->eliminate();
  }

  /// Computes the weights of the sample at `offset` from the first corner: weights[i] is that of
  /// corner i + 1.
  void solve(const double (&offset)[D], double (&weights)[D]) const
  {
    double right[D];
    for (int i = 0; i < D; ++i)
    {
      right[i] = offset[this->Rows[i]];
      for (int k = 0; k < i; ++k)
      {
        right[i] -= this->Matrix[i][k] * right[k];
      }
    }
    for (int i = D - 1; i >= 0; --i)
    {
      for (int k = i + 1; k < D; ++k)
      {
        right[i] -= this->Matrix[i][k] * right[k];
      }
      right[i] *= this->Reciprocals[i];
      weights[this->Columns[i]] = right[i];
    }
  }

private:
  /// Replaces Matrix by its LU factors; Rows and Columns store the permutations.
  void eliminate()
  {
    auto& m = this->Matrix;
    for (int i = 0; i < D; ++i)
    {
      this->Rows[i] = this->Columns[i] = i;
    }
    double first = 0;
    for (int step = 0; step < D; ++step)
    {
      this->choosePivot(step);
      first = step == 0 ? std::fabs(m[0][0]) : first;
      // The remaining pivots are rounding errors: the cell is flat.
      constexpr double rounding = 4.4408920985006262e-16;
      const bool flat = !(std::fabs(m[step][step]) > rounding * first);
      this->Reciprocals[step] = flat ? 0 : 1 / m[step][step];
      for (int row = step + 1; row < D; ++row)
      {
        m[row][step] *= this->Reciprocals[step];
        for (int column = step + 1; column < D; ++column)
        {
          m[row][column] -= m[row][step] * m[step][column];
        }
      }
    }
  }

  void choosePivot(int step)
  {
    auto& m = this->Matrix;
    int pivotRow = step;
    int pivotColumn = step;
    for (int row = step; row < D; ++row)
    {
      for (int column = step; column < D; ++column)
      {
        if (std::fabs(m[row][column]) > std::fabs(m[pivotRow][pivotColumn]))
        {
          pivotRow = row;
          pivotColumn = column;
        }
      }
    }
    std::swap(this->Rows[step], this->Rows[pivotRow]);
    std::swap(this->Columns[step], this->Columns[pivotColumn]);
    for (int i = 0; i < D; ++i)
    {
      std::swap(m[step][i], m[pivotRow][i]);
    }
    for (int i = 0; i < D; ++i)
    {
      std::swap(m[i][step], m[i][pivotColumn]);
    }
  }

  double Matrix[D][D];
  double Reciprocals[D];
  int Rows[D];
  int Columns[D];
};

/// A buffer of samples that cells claim: in runs along the first axis, grouped by cell.
///
/// Most cells have few samples, and branch prediction cannot foresee how many. So samples are
/// collected first, and the expensive work is done in loops over many cells, runs or samples.
template <typename Access>
class SampleBlock
{
public:
  static constexpr int D = Access::Dimension;
  static constexpr int Capacity = 512;

  SampleBlock(const SimplexMesh& mesh, const LatticeAxes& axes)
    : Cells(mesh)
    , Axes(axes)
    , Indices(Capacity + Stride)
    , Offsets(Capacity + Stride)
    , RunOfSamples(Capacity + Stride)
    , Runs(Capacity + 1)
    , RunOffsets(Capacity)
    , GroupCells(Capacity + laneCount)
    , Groups(Capacity / laneCount + 1)
  {
  }

  int room() const { return Capacity - this->Size; }

  void clear()
  {
    this->Size = 0;
    this->RunCount = 0;
    this->LastGroup = -1;
    this->LastCell = -1;
  }

  /// Adds `count` samples of a row, at most room(); does nothing if count <= 0.
  [[gnu::always_inline]] void add(std::int32_t cell, const SampleRow& row, int begin, int count)
  {
    const int group = this->LastGroup + int(cell != this->LastCell);
    const bool any = count > 0;
    this->GroupCells[std::size_t(group)] = cell;
    this->Runs[std::size_t(this->RunCount)] = { row.Row, row.Layer, group };
    // Always writes a whole stride; the surplus is overwritten by the next call.
    for (int i = 0; i < Stride; ++i)
    {
      this->write(i, row.First + begin, this->Axes.U.data() + begin);
    }
    for (int i = Stride; i < count; ++i)
    {
      this->write(i, row.First + begin, this->Axes.U.data() + begin);
    }
    this->LastGroup = any ? group : this->LastGroup;
    this->LastCell = any ? cell : this->LastCell;
    this->RunCount += int(any);
    this->Size += any ? count : 0;
  }

  /// Computes the groups' corners, the gradients of their weights, and the samples' offsets.
  void weigh() { hasAvx2() ? this->weighAvx2() : this->weighAll(); }

  int size() const { return this->Size; }
  /// The index of each sample in the lattice.
  const std::int64_t* indices() const { return this->Indices.data(); }
  const std::int32_t* runsOfSamples() const { return this->RunOfSamples.data(); }
  int groupOf(int j) const { return this->groupOfRun(this->RunOfSamples[std::size_t(j)]); }
  std::int32_t cellOf(int j) const { return this->GroupCells[std::size_t(this->groupOf(j))]; }

  int runs() const { return this->RunCount; }
  int groupOfRun(int run) const { return this->Runs[std::size_t(run)].Group; }

  int groups() const { return this->LastGroup + 1; }

  /// The rest is known after weigh().

  /// Groups 4 * i to 4 * i + 3. Valid, like all that follows, after weigh().
  const GroupLanes<Access>& groupLanes(int i) const { return this->Groups[std::size_t(i)]; }
  /// The point index of a corner; corners are in lexicographic order of their coordinates.
  std::int64_t cornerId(int group, int corner) const
  {
    return this->groupLanes(group / laneCount).Ids[corner][group % laneCount];
  }

  /// The offset of each sample from its cell's first corner along the first axis.
  const double* offsets() const { return this->Offsets.data(); }
  /// The offset of a run's samples along the other axes.
  const double (&runOffset(int run) const)[D - 1]
  {
    return this->RunOffsets[std::size_t(run)].Along;
  }

  /// The weights of all corners but the first at sample j.
  void weightsOf(int j, double (&weights)[D]) const
  {
    const int group = this->groupOf(j);
    const GroupLanes<Access>& lanes = this->groupLanes(group / laneCount);
    const int lane = group % laneCount;
    double offset[D] = { this->Offsets[std::size_t(j)] };
    std::copy_n(this->runOffset(this->RunOfSamples[std::size_t(j)]), D - 1, offset + 1);
    if (lanes.Thin[lane] != 0)
    {
      double edges[D][D];
      for (int i = 0; i < D; ++i)
      {
        for (int axis = 0; axis < D; ++axis)
        {
          edges[i][axis] = lanes.Corners[i + 1][axis][lane] - lanes.Corners[0][axis][lane];
        }
      }
      ThinWeights<D>(edges).solve(offset, weights);
      return;
    }
    for (int i = 0; i < D; ++i)
    {
      double rest = 0;
      for (int axis = 1; axis < D; ++axis)
      {
        rest += lanes.Normals[i][axis][lane] * offset[axis];
      }
      weights[i] = lanes.Normals[i][0][lane] * offset[0] + rest;
    }
  }

private:
  /// Samples that add() writes at a time; LatticeAxis::data() is padded by as many.
  static constexpr int Stride = 4;

  struct Run
  {
    std::int32_t Row;
    std::int32_t Layer;
    std::int32_t Group;
  };

  struct RunOffset
  {
    double First; ///< coordinate of the first corner along the first axis
    double Along[D - 1];
  };

  [[gnu::always_inline]] void write(int i, std::int64_t index, const double* coordinates)
  {
    const std::size_t j = std::size_t(this->Size) + std::size_t(i);
    this->Indices[j] = index + i;
    this->Offsets[j] = coordinates[i];
    this->RunOfSamples[j] = this->RunCount;
  }

#ifdef __x86_64__
  [[gnu::target("avx2")]]
#endif
  void
  weighAvx2()
  {
    this->weighAll();
  }

  [[gnu::always_inline]] void weighAll()
  {
    const int groups = this->groups();
    // Unused lanes repeat the last group.
    for (int i = groups; i % laneCount != 0; ++i)
    {
      this->GroupCells[std::size_t(i)] = this->GroupCells[std::size_t(groups - 1)];
    }
    for (int i = 0; i < groups; i += laneCount)
    {
      this->Groups[std::size_t(i / laneCount)].set(this->Cells, this->GroupCells.data() + i);
    }
    for (int run = 0; run < this->RunCount; ++run)
    {
      const Run& of = this->Runs[std::size_t(run)];
      const auto& origin = this->groupLanes(of.Group / laneCount).Corners[0];
      const int lane = of.Group % laneCount;
      RunOffset& offset = this->RunOffsets[std::size_t(run)];
      offset.First = origin[0][lane];
      offset.Along[0] = this->Axes.V[of.Row] - origin[1][lane];
      if constexpr (D == 3)
      {
        offset.Along[1] = this->Axes.W[of.Layer] - origin[2][lane];
      }
    }
    for (int j = 0; j < this->Size; ++j)
    {
      this->Offsets[std::size_t(j)] -=
        this->RunOffsets[std::size_t(this->RunOfSamples[std::size_t(j)])].First;
    }
  }

  Access Cells;
  const LatticeAxes& Axes;
  int Size = 0;
  int RunCount = 0;
  int LastGroup = -1;
  std::int32_t LastCell = -1;
  std::vector<std::int64_t> Indices;
  std::vector<double> Offsets; ///< the samples' coordinates before weigh()
  std::vector<std::int32_t> RunOfSamples;
  std::vector<Run> Runs;
  std::vector<RunOffset> RunOffsets;
  std::vector<std::int32_t> GroupCells;
  std::vector<GroupLanes<Access>> Groups; ///< four each
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleRuns_h
#define tippSampleRuns_h

#include "Resample/CellVisitor.h"
#include "Resample/Weights.h"

#include <cstdint>
#include <vector>

namespace tipp
{

/// The samples of one block of an image that cells claim, as runs of neighbours in a row with one
/// cell, and their weights.
template <typename Access>
class SampleRuns
{
public:
  static constexpr int D = Access::Dimension;
  static constexpr int BlockSize = 2048;

  struct Run
  {
    std::int64_t Corners[D + 1]; ///< point ids, in the lexicographic order of the coordinates
    std::int32_t Cell;
    int Begin; ///< counted from the block's first sample
    int Count;
  };

  SampleRuns(const SimplexMesh& mesh, const LatticeAxes& axes)
    : Cells(mesh)
    , Axes(axes)
    , WeightValues(std::size_t(D * BlockSize))
  {
  }

  /// Finds the runs of samples first..first + count - 1.
  void find(const std::int32_t* claims, std::int64_t first, int count)
  {
    this->Runs.clear();
    this->First = first;
    const int width = this->Axes.U.size();
    int column = int(first % width);
    for (int i = 0; i < count;)
    {
      const int rowEnd = std::min(count, i + width - column);
      while (i < rowEnd)
      {
        const std::int32_t cell = claims[first + i];
        const int begin = i;
        while (i < rowEnd && claims[first + i] == cell)
        {
          ++i;
        }
        if (cell >= 0)
        {
          this->Runs.emplace_back();
          this->Runs.back().Cell = cell;
          this->Runs.back().Begin = begin;
          this->Runs.back().Count = i - begin;
        }
      }
      column = 0;
    }
  }

  const std::vector<Run>& runs() const { return this->Runs; }

  /// Finds the corners and the weights of all runs.
  void weigh()
  {
    constexpr std::size_t ahead = 8;
    for (const Run& run : this->Runs)
    {
      __builtin_prefetch(this->Cells.ids(run.Cell));
    }
    for (std::size_t i = 0; i < this->Runs.size(); ++i)
    {
      if (i + ahead < this->Runs.size())
      {
        this->Cells.prefetch(this->Runs[i + ahead].Cell);
      }
      this->weigh(this->Runs[i]);
    }
  }

  /// Weight of corner i + 1 for each sample of the block.
  const double* weights(int i) const { return this->WeightValues.data() + i * BlockSize; }

private:
  using Corners = typename CellGeometry<D>::Corners;

  static void toArrays(const Point2 (&corners)[3], double (&arrays)[3][2])
  {
    for (int i = 0; i < 3; ++i)
    {
      arrays[i][0] = corners[i].x;
      arrays[i][1] = corners[i].y;
    }
  }
  static void toArrays(const Point3 (&corners)[4], double (&arrays)[4][3])
  {
    for (int i = 0; i < 4; ++i)
    {
      arrays[i][0] = corners[i].x;
      arrays[i][1] = corners[i].y;
      arrays[i][2] = corners[i].z;
    }
  }

  void weigh(Run& run)
  {
    Corners corners;
    this->Cells.corners(run.Cell, corners);
    for (int i = 0; i <= D; ++i)
    {
      run.Corners[i] = this->Cells.ids(run.Cell)[i];
    }
    for (int end = D; end > 0; --end)
    {
      for (int i = 0; i < end; ++i)
      {
        if (lexicographicLess(corners[i + 1], corners[i]))
        {
          std::swap(corners[i], corners[i + 1]);
          std::swap(run.Corners[i], run.Corners[i + 1]);
        }
      }
    }
    double arrays[D + 1][D];
    toArrays(corners, arrays);
    this->Solver.set(arrays);
    const std::int64_t sample = this->First + run.Begin;
    const std::int64_t row = sample / this->Axes.U.size();
    const double others[2] = { this->Axes.V[int(row % this->Axes.V.size())],
      D == 3 ? this->Axes.W[int(row / this->Axes.V.size())] : 0 };
    double* weights[D];
    for (int i = 0; i < D; ++i)
    {
      weights[i] = this->WeightValues.data() + i * BlockSize + run.Begin;
    }
    this->Solver.solve(
      this->Axes.U.data() + sample % this->Axes.U.size(), run.Count, others, weights);
  }

  Access Cells;
  const LatticeAxes& Axes;
  std::vector<double> WeightValues;
  std::vector<Run> Runs;
  Weights<D> Solver;
  std::int64_t First = 0;
};

} // namespace tipp

#endif

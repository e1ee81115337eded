// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOverlapSums_h
#define tippOverlapSums_h

#include "Overlap/RunningSum.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace tipp
{

/// Values of a mesh of triangles that are averaged over parts of its cells.
struct OverlapField
{
  const double* Values = nullptr; ///< Components per cell or per point; not owned
  int Components = 1;
  bool OfCells = true; ///< constant in each cell; otherwise per point, linear in each triangle
};

/// For each target, a triangle or a pixel: the area that is covered by cells, and the integrals of
/// fields over it. A part that several cells cover counts once for each. The components of all
/// fields are numbered one after another.
class OverlapSums
{
public:
  OverlapSums(std::int64_t targets, int components)
    : Components(std::size_t(components))
    , Sums(std::size_t(targets) * (std::size_t(components) + 1))
  {
  }

  /// The sums of a target: the area, then an integral for each component.
  RunningSum* of(std::int64_t target)
  {
    return this->Sums.data() + std::size_t(target) * (this->Components + 1);
  }
  const RunningSum* of(std::int64_t target) const
  {
    return this->Sums.data() + std::size_t(target) * (this->Components + 1);
  }

  double areaOf(std::int64_t target) const { return this->of(target)->value(); }

  /// The mean over the covered area; NaN if there is none.
  double meanOf(std::int64_t target, int component) const
  {
    const RunningSum* const sums = this->of(target);
    const double area = sums->value();
    return area > 0 ? sums[component + 1].value() / area : std::numeric_limits<double>::quiet_NaN();
  }

  /// Writes the means of `count` components from `first` on to `means`, those of each target
  /// together: `null` where `shares`, by target, is 0.
  void copyMeans(int first, int count, const std::vector<double>& shares, double null,
    double* means, int threads) const
  {
    forIndices(
      std::int64_t(shares.size()),
      [&](std::int64_t i)
      {
        for (int k = 0; k < count; ++k)
        {
          means[i * count + k] = shares[std::size_t(i)] > 0 ? this->meanOf(i, first + k) : null;
        }
      },
      threads);
  }

  int components() const { return int(this->Components); }
  std::int64_t targets() const { return std::int64_t(this->Sums.size() / (this->Components + 1)); }

  /// The sums of all targets, one after another.
  const std::vector<RunningSum>& all() const { return this->Sums; }

  /// Sets the sums of the targets from `first` on.
  void set(std::int64_t first, const std::vector<RunningSum>& sums)
  {
    std::copy(sums.begin(), sums.end(), this->of(first));
  }

  /// Adds the sums of target `from` to those of target `to`, and sets those of `from` to 0.
  void move(std::int64_t from, std::int64_t to)
  {
    for (std::size_t i = 0; i <= this->Components; ++i)
    {
      this->of(to)[i].add(this->of(from)[i]);
      this->of(from)[i] = {};
    }
  }

private:
  std::size_t Components;
  std::vector<RunningSum> Sums;
};

/// Returns a covered share. One that rounding alone makes larger than 1 is 1.
inline double coveredShare(double covered, double whole)
{
  constexpr double rounding = 1e-9;
  const double share = whole > 0 ? covered / whole : 0;
  return share > 1 && share < 1 + rounding ? 1 : share;
}

/// Returns the number of components of all fields.
inline int componentsOf(const std::vector<OverlapField>& fields)
{
  int components = 0;
  for (const OverlapField& field : fields)
  {
    components += field.Components;
  }
  return components;
}

/// Whether a field is of points.
inline bool anyOfPoints(const std::vector<OverlapField>& fields)
{
  bool isAny = false;
  for (const OverlapField& field : fields)
  {
    isAny = isAny || !field.OfCells;
  }
  return isAny;
}

} // namespace tipp

#endif

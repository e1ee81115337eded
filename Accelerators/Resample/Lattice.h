// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLattice_h
#define tippLattice_h

#include "Arrays/Decimal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Samples at Min + i * Delta (see GridSteps), for the indices of an extent as VTK's images have
/// them: first and last along x, y, z, both inclusive. The indices count from the whole lattice's
/// origin, so that parts of a lattice have the very same samples.
struct Lattice
{
  std::array<double, 3> Min = {};            ///< coordinates of the sample with index (0, 0, 0)
  std::array<double, 3> Delta = { 1, 1, 1 }; ///< spacing along x, y, z
  std::array<int, 6> Extent = {};            ///< first and last index along x, y, z
  /// How far, along x, y, z, a sample outside of all triangles may be from one and still count as
  /// on its border. Volumes do not use it.
  std::array<double, 3> Slack = {};

  std::int64_t size(int axis) const
  {
    return std::int64_t(this->Extent[2 * axis + 1]) - this->Extent[2 * axis] + 1;
  }
  std::int64_t samples() const { return this->size(0) * this->size(1) * this->size(2); }
  bool empty() const { return this->size(0) < 1 || this->size(1) < 1 || this->size(2) < 1; }
};

/// The half-open range [Begin, End) of sample indices.
struct IndexRange
{
  int Begin;
  int End;

  bool empty() const { return this->Begin >= this->End; }
  int size() const { return this->End - this->Begin; }

  /// Returns the first index for which the test is false, or End; it must be true before that index
  /// and false from there on.
  template <typename Test>
  int firstWhereNot(const Test& test) const
  {
    int low = this->Begin;
    for (int high = this->End; low < high;)
    {
      const int middle = low + (high - low) / 2;
      test(middle) ? low = middle + 1 : high = middle;
    }
    return low;
  }
};

/// Where a line or plane crosses a row: the number of samples strictly before the crossing, and the
/// number before or on it.
struct RowCrossing
{
  int Before; ///< number of samples strictly before the crossing
  int WithOn; ///< number of samples before or on it
};

/// The constants of one axis of a lattice. LatticeAxis computes its coordinates from them, so they
/// must not change later.
struct AxisConstants
{
  double Origin; ///< of the lattice; the first sample's coordinate differs if its index is not 0
  double Delta;
  double Inverse;  ///< 1 / Delta
  double First;    ///< index of the first sample
  double Limit;    ///< the largest position()
  GridSteps Steps; ///< from the origin to each sample
  ///@{ See LatticeAxis::error().
  double ErrorScale = HUGE_VAL;
  double ErrorOffset = HUGE_VAL;
  ///@}
};

/// One axis of a lattice: the coordinates of its samples, and the position of other coordinates
/// among them.
class LatticeAxis : public AxisConstants
{
public:
  LatticeAxis(const Lattice& lattice, int axis)
    : AxisConstants{ lattice.Min[axis], lattice.Delta[axis], 1.0 / lattice.Delta[axis],
      double(lattice.Extent[2 * axis]), double(lattice.size(axis)) + 0.5,
      GridSteps(lattice.Min[axis], lattice.Delta[axis]) }
    , Slack(lattice.Slack[axis])
    , Count(int(lattice.size(axis)))
    , Coordinates(std::size_t(this->Count) + Padding)
  {
    for (std::size_t i = 0; i < this->Coordinates.size(); ++i)
    {
      this->Coordinates[i] = this->Steps[double(i) + this->First];
    }
    // A step of 0 makes it infinite: no estimate is certain then.
    const double scale = Roundings * std::fabs(this->Inverse);
    if (this->Inverse > 0 && scale < 1e270)
    {
      this->ErrorScale = scale;
      this->ErrorOffset = scale * std::fabs(this->Origin);
    }
  }

  const double Slack; ///< see Lattice::Slack

  int size() const { return this->Count; }
  double operator[](int i) const { return this->Coordinates[std::size_t(i)]; }
  /// The samples' coordinates, plus four padding values.
  const double* data() const { return this->Coordinates.data(); }

  /// The position of v, counted in steps from one step before the first sample, with rounding
  /// errors. Clamped so that its integer part is 0 below all samples and size() above them.
  double position(double v) const
  {
    return this->clamp((v - this->Origin) * this->Inverse - this->First + 1);
  }
  // With this order of arguments NaN becomes 0.5.
  double clamp(double position) const { return std::min(this->Limit, std::max(0.5, position)); }

  /// An upper bound, in steps, on the error of position() for crossings of lines and rows in a cell
  /// whose coordinates lie within +-reach, including the error of the samples' own coordinates. A
  /// crossing has ten roundings, each of at most 2^-53 of twice `reach` and Origin; the bound
  /// allows for 64.
  double error(double reach) const { return reach * this->ErrorScale + this->ErrorOffset; }

  /// Whether the integer part of a position with this error is certain. False if the error is half
  /// or more, infinite, or NaN.
  static bool certain(double position, double error)
  {
    return std::fabs(position - int(position) - 0.5) < 0.5 - error;
  }

  /// Finds a crossing whose computed position has the given error, among `columns`. side(i) is
  /// exact: 1 if sample i lies before the crossing, 0 on it, -1 beyond.
  template <typename Side>
  RowCrossing crossing(double position, double error, IndexRange columns, const Side& side) const
  {
    if (certain(position, error))
    {
      return { int(position), int(position) };
    }
    if (!(error < 0.5))
    {
      return { columns.firstWhereNot([&](int i) { return side(i) > 0; }),
        columns.firstWhereNot([&](int i) { return side(i) >= 0; }) };
    }
    // The only sample whose side is uncertain, or none: -1 or size().
    const int i = position - int(position) < 0.5 ? int(position) - 1 : int(position);
    if (i < 0 || i >= this->size())
    {
      return { int(position), int(position) };
    }
    const int where = side(i);
    return { where > 0 ? i + 1 : i, where >= 0 ? i + 1 : i };
  }

  /// The samples in the closed interval [low, high]. `error` is error() for a reach that includes
  /// both.
  [[gnu::always_inline]] IndexRange range(double low, double high, double error) const
  {
    const double begin = this->position(low);
    const double end = this->position(high);
    if ((int(certain(begin, error)) & int(certain(end, error))) != 0) // & : one branch
    {
      return { int(begin), int(end) };
    }
    return this->exactRange(low, high);
  }

  /// 64 roundings of numbers up to 1.
  static constexpr double Roundings = 7.1054273576010019e-15; // 2^-47

  /// range() by exact comparisons, for uncertain positions.
  [[gnu::noinline]] IndexRange exactRange(double low, double high) const
  {
    const auto begin = this->Coordinates.begin();
    const auto end = begin + this->Count;
    return { int(std::lower_bound(begin, end, low) - begin),
      int(std::upper_bound(begin, end, high) - begin) };
  }

private:
  static constexpr std::size_t Padding = 4;

  int Count;
  std::vector<double> Coordinates;
};

/// A row of a lattice's samples along the first axis.
struct SampleRow
{
  std::int64_t First; ///< index of its first sample
  int Row;
  int Layer;
};

/// A cell's samples in a row: those it claims, and those on its border beyond them.
struct RowSpan
{
  int Begin;
  int End;       ///< [Begin, End) are claimed; none if End <= Begin
  int ClosedEnd; ///< [max(Begin, End), ClosedEnd) lie on its border
};

} // namespace tipp

#endif

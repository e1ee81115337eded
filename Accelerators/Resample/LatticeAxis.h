// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLatticeAxis_h
#define tippLatticeAxis_h

#include "Resample/Lattice.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tipp
{

/// Indices of samples, Begin included, End not.
struct IndexRange
{
  int Begin;
  int End;

  bool empty() const { return this->Begin >= this->End; }
  int size() const { return this->End - this->Begin; }

  /// The test holds for some indices from Begin on, or none, and not beyond them.
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

/// How many samples of a row lie strictly before a line or plane that crosses it, and with those on
/// it.
struct Crossing
{
  int Before;
  int WithOn;
};

/// One axis of a lattice: the coordinates of its samples, and where among them others lie.
class LatticeAxis
{
public:
  LatticeAxis(const Lattice& lattice, int axis)
    : Min(lattice.Min[axis])
    , Delta(lattice.Delta[axis])
    , Inverse(1.0 / lattice.Delta[axis])
    , First(lattice.Extent[2 * axis])
    , Limit(double(lattice.size(axis)) + 0.5)
    , Count(int(lattice.size(axis)))
    , Coordinates(std::size_t(this->Count) + Padding)
  {
    for (std::size_t i = 0; i < this->Coordinates.size(); ++i)
    {
      this->Coordinates[i] = this->Min + (double(i) + this->First) * lattice.Delta[axis];
    }
    this->ErrorScale = Roundings * std::fabs(this->Inverse);
    this->ErrorOffset = this->ErrorScale * std::fabs(this->Min);
    // A step of 0 makes it infinite: every estimate then counts for nothing.
    if (!(this->Inverse > 0 && this->ErrorScale < 1e270))
    {
      this->ErrorScale = this->ErrorOffset = HUGE_VAL;
    }
  }

  int size() const { return this->Count; }
  double operator[](int i) const { return this->Coordinates[std::size_t(i)]; }
  /// The coordinates, and four more.
  const double* data() const { return this->Coordinates.data(); }

  /// Where v lies, in steps, rounded: 1 at the first sample. Clamped to numbers whose whole part is
  /// 0 below all samples and size() above them.
  double place(double v) const
  {
    return this->clamp((v - this->Min) * this->Inverse - this->First + 1);
  }
  // In this order of arguments NaN becomes 0.5.
  double clamp(double place) const { return std::min(this->Limit, std::max(0.5, place)); }
  double inverse() const { return this->Inverse; }
  /// The lattice's own: not that of the first sample, if that has another index than 0.
  double origin() const { return this->Min; }
  double firstIndex() const { return this->First; }

  /// How far place() may be wrong for crossings of lines with rows, computed within a cell whose
  /// coordinates reach to +-reach, and the samples' own coordinates, in steps. A crossing takes ten
  /// roundings, each of 2^-53 of twice `reach` and Min at the most; this counts 64.
  double error(double reach) const { return reach * this->ErrorScale + this->ErrorOffset; }
  double errorScale() const { return this->ErrorScale; }
  double errorOffset() const { return this->ErrorOffset; }
  double limit() const { return this->Limit; }
  double delta() const { return this->Delta; }

  /// Whether the whole part of a place with this error is certain. Never with an error that is half
  /// or more, infinite, or not a number.
  static bool certain(double place, double error)
  {
    return std::fabs(place - int(place) - 0.5) < 0.5 - error;
  }

  /// The only sample that a place with an error below one half does not tell the side of; -1 or
  /// size() if there is none.
  static int doubtful(double place)
  {
    const int whole = int(place);
    return place - whole < 0.5 ? whole - 1 : whole;
  }

  /// The samples before a crossing at a place that is not certain, those of `columns` being in
  /// question. side(i) is exact: 1 before it, 0 on it, -1 beyond.
  template <typename Side>
  Crossing crossing(double place, double error, IndexRange columns, const Side& side) const
  {
    if (!(error < 0.5))
    {
      return { columns.firstWhereNot([&](int i) { return side(i) > 0; }),
        columns.firstWhereNot([&](int i) { return side(i) >= 0; }) };
    }
    const int i = doubtful(place);
    if (i < 0 || i >= this->size())
    {
      return { int(place), int(place) };
    }
    const int where = side(i);
    return { where > 0 ? i + 1 : i, where >= 0 ? i + 1 : i };
  }

  /// The samples from low to high, both included; `error` as from error() with a reach to both.
  [[gnu::always_inline]] IndexRange range(double low, double high, double error) const
  {
    const double begin = this->place(low);
    const double end = this->place(high);
    if ((int(certain(begin, error)) & int(certain(end, error))) != 0) // & : one branch
    {
      return { int(begin), int(end) };
    }
    return this->exactRange(low, high);
  }

  /// 64 roundings of numbers up to 1.
  static constexpr double Roundings = 7.1054273576010019e-15; // 2^-47

  /// As range() where that is not certain.
  [[gnu::noinline]] IndexRange exactRange(double low, double high) const
  {
    const auto begin = this->Coordinates.begin();
    const auto end = begin + this->Count;
    return { int(std::lower_bound(begin, end, low) - begin),
      int(std::upper_bound(begin, end, high) - begin) };
  }

private:
  static constexpr std::size_t Padding = 4;

  double Min;
  double Delta;
  double Inverse;
  double First;
  double Limit;
  double ErrorScale;
  double ErrorOffset;
  int Count;
  std::vector<double> Coordinates;
};

/// Samples of a cell along a row: those it answers, and those it contains beyond them.
struct RowSpan
{
  int Begin;
  int End;       ///< those it answers are Begin..End - 1; none if End <= Begin
  int ClosedEnd; ///< those from max(Begin, End) before this lie on its border
};

} // namespace tipp

#endif

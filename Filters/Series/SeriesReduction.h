// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesReduction_h
#define tippSeriesReduction_h

#include "Series/SeriesOutput.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// A single field that is made from all time steps of another one.
struct SeriesReduction
{
  enum class Of
  {
    Maximum,
    Minimum,
    Mean,          ///< over the steps that have a value
    TimeOfMaximum, ///< from the first step to the first one with the maximum
    TimeAbove      ///< how long the value is above Level
  };
  Of Kind = Of::Maximum;
  double Level = 0; ///< for TimeAbove

  /// Reads "max", "min", "mean", "time-of-max" or "above:LEVEL"; nothing for any other text.
  VTKTIPPFILTERS_EXPORT static std::optional<SeriesReduction> parse(const std::string& text);

  /// The field that this makes of another one. `timeUnits` as in SeriesDescription; `first`: the
  /// time of the first step.
  VTKTIPPFILTERS_EXPORT SeriesField fieldOf(
    const SeriesField& field, const std::string& timeUnits, double first = 0) const;
};

/// Computes a reduction as steps arrive. A step stands for the time from half way after the step
/// before it to half way before the step after it; the first and the last one for half as long.
/// NaN counts as no value, and is the result where no step has one.
class VTKTIPPFILTERS_EXPORT SeriesReducer
{
public:
  /// `times`: of all steps that will be added, ascending.
  SeriesReducer(const SeriesReduction& reduction, std::size_t samples, std::vector<double> times);

  /// Adds samples [begin, end) of the next step. Threads may add different ranges.
  void add(std::size_t step, const float* samples, std::size_t begin, std::size_t end);

  /// The result for all samples, when all steps have been added.
  std::vector<float> result() const;

private:
  SeriesReduction Reduction;
  std::vector<double> Times;
  std::vector<double> Durations; ///< how long each step stands for
  ///@{ By sample; empty if the reduction does not need them.
  std::vector<float> Extreme;
  std::vector<double> Sums;         ///< of values or durations, or the time of the maximum
  std::vector<std::int32_t> Counts; ///< of values
  ///@}
};

} // namespace tipp

#endif

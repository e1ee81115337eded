// SPDX-License-Identifier: BSD-3-Clause
#include "Series/SeriesReduction.h"

#include "Files/TextFile.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace tipp
{
namespace
{

using Of = SeriesReduction::Of;

constexpr float noValue = std::numeric_limits<float>::quiet_NaN();

/// How long each step stands for.
std::vector<double> durationsOf(const std::vector<double>& times)
{
  std::vector<double> durations(times.size(), 0);
  for (std::size_t i = 0; i + 1 < times.size(); ++i)
  {
    const double half = (times[i + 1] - times[i]) / 2;
    durations[i] += half;
    durations[i + 1] += half;
  }
  return durations;
}

/// The unit of times "seconds since 2008-09-01".
std::string unitOf(const std::string& timeUnits)
{
  return timeUnits.substr(0, timeUnits.find(' '));
}

/// When the first step is, in brackets; empty if the file does not say.
std::string dateOf(double first, const std::string& timeUnits)
{
  return timeUnits.find(" since ") == std::string::npos
    ? ""
    : " (" + shortText(first) + " " + timeUnits + ")";
}

std::string shortest(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

} // namespace

std::optional<SeriesReduction> SeriesReduction::parse(const std::string& text)
{
  const std::pair<const char*, Of> names[] = { { "max", Of::Maximum }, { "min", Of::Minimum },
    { "mean", Of::Mean }, { "time-of-max", Of::TimeOfMaximum } };
  for (const auto& [name, kind] : names)
  {
    if (text == name)
    {
      return SeriesReduction{ kind, 0 };
    }
  }
  const std::string start = "above:";
  double level = 0;
  if (text.rfind(start, 0) == 0 && parseNumber(text.substr(start.size()), level) &&
    std::isfinite(level))
  {
    return SeriesReduction{ Of::TimeAbove, level };
  }
  return std::nullopt;
}

SeriesField SeriesReduction::fieldOf(
  const SeriesField& field, const std::string& timeUnits, double first) const
{
  const std::string name = field.LongName.empty() ? field.Name : field.LongName;
  switch (this->Kind)
  {
    case Of::Maximum:
      return { field.Name + "_max", "maximum of " + name, field.Units, false };
    case Of::Minimum:
      return { field.Name + "_min", "minimum of " + name, field.Units, false };
    case Of::Mean:
      return { field.Name + "_mean", "mean of " + name, field.Units, false };
    case Of::TimeOfMaximum:
      return { field.Name + "_time_of_max",
        "time from the first step" + dateOf(first, timeUnits) + " to the maximum of " + name,
        unitOf(timeUnits), false };
    case Of::TimeAbove:
      break;
  }
  const std::string level = shortest(this->Level);
  return { field.Name + "_time_above_" + level, "time for which " + name + " is above " + level,
    unitOf(timeUnits), false };
}

SeriesReducer::SeriesReducer(
  const SeriesReduction& reduction, std::size_t samples, std::vector<double> times)
  : Reduction(reduction)
  , Times(std::move(times))
  , Durations(durationsOf(this->Times))
{
  const Of kind = reduction.Kind;
  const bool hasExtreme = kind == Of::Maximum || kind == Of::Minimum || kind == Of::TimeOfMaximum;
  const bool hasCounts = kind == Of::Mean || kind == Of::TimeAbove;
  this->Extreme.assign(hasExtreme ? samples : 0, noValue);
  this->Sums.assign(hasCounts || kind == Of::TimeOfMaximum ? samples : 0, 0);
  this->Counts.assign(hasCounts ? samples : 0, 0);
}

void SeriesReducer::add(std::size_t step, const float* samples, std::size_t begin, std::size_t end)
{
  switch (this->Reduction.Kind)
  {
    case Of::Maximum:
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Extreme[i] = std::fmax(this->Extreme[i], samples[i]);
      }
      break;
    case Of::Minimum:
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Extreme[i] = std::fmin(this->Extreme[i], samples[i]);
      }
      break;
    case Of::Mean:
      for (std::size_t i = begin; i < end; ++i)
      {
        const bool is = !std::isnan(samples[i]);
        this->Sums[i] += is ? double(samples[i]) : 0;
        this->Counts[i] += is;
      }
      break;
    case Of::TimeOfMaximum:
      for (std::size_t i = begin; i < end; ++i)
      {
        const bool isHigher = !std::isnan(samples[i]) && !(samples[i] <= this->Extreme[i]);
        this->Extreme[i] = isHigher ? samples[i] : this->Extreme[i];
        this->Sums[i] = isHigher ? this->Times[step] - this->Times.front() : this->Sums[i];
      }
      break;
    case Of::TimeAbove:
      for (std::size_t i = begin; i < end; ++i)
      {
        this->Sums[i] += double(samples[i]) > this->Reduction.Level ? this->Durations[step] : 0;
        this->Counts[i] += !std::isnan(samples[i]);
      }
      break;
  }
}

std::vector<float> SeriesReducer::result() const
{
  if (this->Sums.empty())
  {
    return this->Extreme;
  }
  std::vector<float> result(this->Sums.size());
  for (std::size_t i = 0; i < result.size(); ++i)
  {
    const bool has = this->Counts.empty() ? !std::isnan(this->Extreme[i]) : this->Counts[i] > 0;
    const bool isMean = this->Reduction.Kind == Of::Mean;
    result[i] = has ? float(isMean ? this->Sums[i] / this->Counts[i] : this->Sums[i]) : noValue;
  }
  return result;
}

} // namespace tipp

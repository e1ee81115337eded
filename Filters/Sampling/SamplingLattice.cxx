// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SamplingLattice.h"

#include "Arrays/Decimal.h"
#include "Files/TextFile.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

namespace tipp
{

std::array<int, 3> chosenDimensions(
  const Box3& bounds, std::array<int, 3> dimensions, bool surfaces)
{
  std::optional<double> step;
  for (std::size_t axis = 0; axis < 3 && !step; ++axis)
  {
    if (dimensions[axis] > 0)
    {
      step = bounds.width(axis) / std::max(dimensions[axis] - 1, 1);
    }
  }
  if (!step)
  {
    throw std::runtime_error(
      "SamplingDimensions have no number above 0: give one along an axis at least.");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (dimensions[axis] == 0)
    {
      const bool one = (axis == 2 && surfaces) || !(*step > 0); // invalid bounds are reported later
      const double steps = one ? 0 : std::max(std::round(bounds.width(axis) / *step), 0.0);
      if (!(steps < std::numeric_limits<int>::max()))
      {
        throw std::runtime_error("more than 2147483647 samples along " +
          std::string(1, "xyz"[axis]) + " would be as far apart as those of the first axis: give " +
          "the number of samples along it.");
      }
      dimensions[axis] = int(steps) + 1;
    }
  }
  return dimensions;
}

std::string warningOfOneSample(std::int64_t samples, double distance)
{
  return distance > 0 && samples == 1
    ? "there is one sample, because the distance of samples, " + shortText(distance) +
      ", is larger than the range; give a smaller one, in the units of the mesh."
    : "";
}

Lattice rangeLattice(
  const Box3& bounds, const std::array<int, 3>& dimensions, const std::array<double, 3>& delta)
{
  Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::string name(1, "xyz"[axis]);
    const double low = bounds.Min[axis];
    const double high = bounds.Max[axis];
    int count = dimensions[axis];
    if (!std::isfinite(high - low) || low > high)
    {
      throw std::runtime_error("the range along " + name + " is from " + std::to_string(low) +
        " to " + std::to_string(high) + ": give finite bounds, the lower one first.");
    }
    if (!std::isfinite(delta[axis]) || delta[axis] < 0)
    {
      throw std::runtime_error("Delta along " + name + " is " + std::to_string(delta[axis]) +
        ": give a distance above 0, or 0 to use SamplingDimensions.");
    }
    if (delta[axis] > 0)
    {
      const double steps = stepsUpTo(low, delta[axis], high, 0);
      if (!(steps < std::numeric_limits<int>::max()))
      {
        throw std::runtime_error(
          "more than 2147483647 samples along " + name + ": give a larger Delta.");
      }
      count = int(steps) + 1;
    }
    if (count < 1)
    {
      throw std::runtime_error(
        "SamplingDimensions along " + name + " is " + std::to_string(count) + ": give 1 or more.");
    }
    lattice.Min[axis] = low;
    lattice.Extent[2 * axis + 1] = count - 1;
    if (delta[axis] > 0)
    {
      lattice.Delta[axis] = delta[axis];
      lattice.Slack[axis] = roundingOf(low, high);
    }
    else if (count > 1)
    {
      lattice.Delta[axis] = partOfRange(low, high, count - 1);
      // Rounding must not move the last sample out of the range.
      while (lattice.Delta[axis] > 0 && GridSteps(low, lattice.Delta[axis])[count - 1] > high)
      {
        lattice.Delta[axis] = std::nextafter(lattice.Delta[axis], 0.0);
      }
    }
    else
    {
      lattice.Delta[axis] = high > low ? high - low : 1;
    }
  }
  return lattice;
}

std::vector<int> surfaceAxes(const std::array<int, 3>& dimensions)
{
  if (dimensions[2] == 1 || (dimensions[0] > 1 && dimensions[1] > 1))
  {
    return { 0, 1 };
  }
  return dimensions[1] == 1 ? std::vector<int>{ 0, 2 } : std::vector<int>{ 1, 2 };
}

void requirePixels(const Lattice& lattice, const std::vector<int>& axes)
{
  const int projected = 3 - axes[0] - axes[1];
  if (lattice.size(projected) > 1)
  {
    throw std::runtime_error("conservative means have one layer: give one sample along " +
      std::string(1, "xyz"[projected]) + ".");
  }
  for (const int axis : axes)
  {
    const bool hasWidth = lattice.Slack[std::size_t(axis)] > 0; // Delta was given
    if (lattice.size(axis) == 1 && !hasWidth)
    {
      throw std::runtime_error("there is one sample along " + std::string(1, "xyz"[axis]) +
        ", which does not tell the width of its pixel: give Delta.");
    }
  }
}

void requireMemory(double samples, double bytes)
{
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > memory)
  {
    char text[256];
    std::snprintf(text, sizeof text,
      "%.0f samples need at least %.1f GB of memory, and this machine has %.1f GB: use a smaller "
      "range, fewer samples or fewer arrays.",
      samples, bytes / 1e9, memory / 1e9);
    throw std::runtime_error(text);
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDescribedSeries_h
#define tippDescribedSeries_h

#include "Files/MeshDescription.h"
#include "Series/MeshSeries.h"

#include <string>
#include <vector>

namespace tipp
{

/// A stored array whose components become variables of a series.
struct DescribedArray
{
  std::string Name;
  Scalar Type = Scalar::Float64;
  int Components = 1;
  bool OnCells = false;
  bool Varies = false;
};

/// Sets the unit and calendar of time and the reference system of a series.
void describeTimes(MeshSeries& series, const MeshDescription& description);

/// Adds a variable for each component of an array, with what its mesh says of it.
void addVariables(
  MeshSeries& series, const DescribedArray& array, const MeshDescription& description);

/// Replaces the value that stands for none in a variable by NaN.
void removeMarks(const SeriesVariable& variable, std::vector<double>& values);

} // namespace tipp

#endif

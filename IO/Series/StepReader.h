// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippStepReader_h
#define tippStepReader_h

#include "Arrays/Scalar.h"
#include "Series/MeshSeries.h"

#include <cstddef>
#include <vector>

namespace tipp
{

/// The type in which values of a variable are written to other files. Whole numbers may be missing,
/// too, so it is one of floating-point numbers that represents all of them.
Scalar storedType(Scalar type);

/// Reads a variable, or all components of a vector, step by step, in the type to be written.
class StepReader
{
public:
  /// `first`: the index of the variable, or of the first component. `marksMissing`: NaN becomes the
  /// variable's Mark, if it has one. The series must outlive the reader.
  StepReader(MeshSeries& series, std::size_t first, int components, bool marksMissing);

  Scalar type() const { return this->Type; }

  /// Returns the values of a step, component by component of each node or cell; valid until the
  /// next call. Throws IOError, also where a whole number is too large for the type.
  const void* read(std::size_t step);

private:
  void mark(double mark);
  void requireExact(const SeriesVariable& variable) const;
  template <typename T>
  void put(std::size_t component);

  MeshSeries& Series;
  const std::size_t First;
  const std::size_t Components;
  const bool MarksMissing;
  const Scalar Type;
  std::vector<double> Values;
  std::vector<char> Bytes;
};

} // namespace tipp

#endif

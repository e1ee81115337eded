// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlattenedSeries_h
#define tippFlattenedSeries_h

#include "Flat/FlatMesh.h"
#include "Series/MeshSeries.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// The output of a model as the content of a flat mesh, with the file that its values are read
/// from.
struct FlattenedSeries
{
  explicit FlattenedSeries(const std::string& path, const std::vector<std::string>& values = {})
    : Series(openMeshSeries(path, { values, false }))
    , Content(flattenSeries(*Series))
  {
  }

  /// A value at a step, of an array of Float64.
  static double valueAt(const FlatArray& array, std::int64_t step, std::size_t index)
  {
    return static_cast<const double*>(array.StepValues(step))[index];
  }

  std::unique_ptr<MeshSeries> Series;
  FlatContent Content;
};

} // namespace test
} // namespace tipp

#endif

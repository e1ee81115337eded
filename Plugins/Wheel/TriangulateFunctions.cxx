// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays.h"
#include "Functions.h"
#include "Reporter.h"
#include "TriangulationDict.h"

#include "AlphaShape/AlphaShape.h"
#include "Merging/TriangulateMerged.h"
#include "Parallel/ThreadLimit.h"
#include "Triangulation/Triangulate.h"

namespace tipp::python
{
namespace
{

nb::dict triangulatePoints(const InputArray& points, double distance, double maximumEdge,
  int columns, int rows, bool stages, int threads, bool neighbors, nb::object progress)
{
  Reporter reporter(std::move(progress));
  TriangulationOptions options;
  options.MaximumEdge = maximumEdge;
  options.Columns = columns;
  options.Rows = rows;
  options.Order = stages ? Schedule::Stages : Schedule::Dynamic;
  options.Threads = threads;
  options.Progress = reporter.function();
  Triangulation triangulation;
  withoutLock(
    [&]
    {
      const ThreadLimit limit(threads);
      const PointsView view = viewOf(points);
      triangulation =
        distance > 0 ? triangulateMerged(view, distance, options) : triangulate(view, options);
    });
  reporter(1);
  reporter.raiseIfStopped();
  return triangulationDict(std::move(triangulation), points.shape(0), maximumEdge > 0, neighbors);
}

template <typename Id, typename Scalar>
AlphaShape<Id> shapeOf(
  const InputArray& points, const InputArray& triangles, double alpha, const InputArray& covered)
{
  const auto* const coordinates = static_cast<const Scalar*>(points.data());
  const std::size_t width = points.shape(1);
  const auto pointAt = [=](PointId id, double* p)
  {
    const Scalar* const from = coordinates + std::size_t(id) * width;
    p[0] = double(from[0]);
    p[1] = double(from[1]);
    p[2] = width > 2 ? double(from[2]) : 0;
  };
  Buffer<Id> ids(triangles.size());
  std::copy_n(static_cast<const Id*>(triangles.data()), ids.size(), ids.data());
  const auto* const marks = static_cast<const char*>(covered.data());
  return alphaShape(ids, PointAt(pointAt), alpha, std::vector<char>(marks, marks + covered.size()));
}

template <typename Id>
nb::tuple alphaTuple(
  const InputArray& points, const InputArray& triangles, double alpha, const InputArray& covered)
{
  AlphaShape<Id> shape = withoutLock(
    [&]
    {
      return scalarOf(points.dtype()) == Scalar::Float32
        ? shapeOf<Id, float>(points, triangles, alpha, covered)
        : shapeOf<Id, double>(points, triangles, alpha, covered);
    });
  return nb::make_tuple(arrayOf(std::move(shape.Triangles), 3), arrayOf(std::move(shape.Lines), 2),
    arrayOf(std::move(shape.Vertices), 1));
}

nb::tuple alphaShapeOf(
  const InputArray& points, const InputArray& triangles, double alpha, const InputArray& covered)
{
  return scalarOf(triangles.dtype()) == Scalar::Int32
    ? alphaTuple<std::int32_t>(points, triangles, alpha, covered)
    : alphaTuple<std::int64_t>(points, triangles, alpha, covered);
}

} // namespace

void addTriangulateFunctions(nb::module_& module)
{
  module.def("triangulate", &triangulatePoints, nb::arg("points"), nb::arg("distance"),
    nb::arg("maximum_edge"), nb::arg("columns"), nb::arg("rows"), nb::arg("stages"),
    nb::arg("threads"), nb::arg("neighbors"), nb::arg("progress").none());
  module.def("alpha_shape", &alphaShapeOf, nb::arg("points"), nb::arg("triangles"),
    nb::arg("alpha"), nb::arg("covered"));
}

} // namespace tipp::python

// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"

#include "InMemory/AlphaShape.h"
#include "InMemory/TriangulateMerged.h"
#include "Meshes/MeshFiles.h"
#include "Output/RunStatistics.h"
#include "Parallel/ParallelFor.h"
#include "Triangulation/TriangleLocator.h"
#include "Triangulation/Triangulate.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstring>

namespace tipp::python
{
namespace
{

nb::object duplicatesArray(const std::vector<Duplicate>& duplicates)
{
  static_assert(sizeof(Duplicate) == 2 * sizeof(std::int64_t), "two ids in a row");
  Buffer<std::int64_t> pairs(2 * duplicates.size());
  if (!duplicates.empty())
  {
    std::memcpy(pairs.data(), duplicates.data(), duplicates.size() * sizeof(Duplicate));
  }
  return arrayOf(std::move(pairs), 2);
}

nb::object rejectedArray(const std::vector<PointId>& rejected)
{
  Buffer<char> ids(rejected.size() * sizeof(PointId));
  if (!rejected.empty())
  {
    std::memcpy(ids.data(), rejected.data(), ids.size());
  }
  return arrayOf(std::move(ids), Scalar::Int64, 1);
}

nb::object neighborsArray(const Triangulation& triangulation)
{
  const std::size_t triangles = triangulation.triangleCount();
  Buffer<std::int64_t> neighbors(3 * triangles);
  withoutLock(
    [&]
    {
      triangulation.Ids64.empty()
        ? findNeighbors(triangulation.Ids32.data(), triangles, neighbors.data())
        : findNeighbors(triangulation.Ids64.data(), triangles, neighbors.data());
    });
  return arrayOf(std::move(neighbors), 3);
}

nb::dict statisticsDict(const RunStatistics& statistics)
{
  nb::dict result;
  for (const Figures& total : statistics.Totals)
  {
    result[total.Key.c_str()] = std::get<std::vector<std::int64_t>>(total.Values).front();
  }
  for (const FigureList& list : statistics.Lists)
  {
    if (list.Key == "phases")
    {
      const auto& names = std::get<std::vector<std::string>>(list.Columns[0].Values);
      const auto& values = std::get<std::vector<double>>(list.Columns[1].Values);
      nb::dict seconds;
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        seconds[names[i].c_str()] = values[i];
      }
      result["seconds"] = seconds;
    }
  }
  return result;
}

} // namespace

PointsView viewOf(const InputArray& points)
{
  const std::size_t count = points.shape(0);
  const std::size_t stride = points.shape(1);
  return scalarOf(points.dtype()) == Scalar::Float32
    ? PointsView(static_cast<const float*>(points.data()), count, stride)
    : PointsView(static_cast<const double*>(points.data()), count, stride);
}

TriangulationOptions triangulationOptions(
  double maximumEdge, int columns, int rows, bool stages, int threads, Reporter& reporter)
{
  TriangulationOptions options;
  options.MaximumEdge = maximumEdge;
  options.Columns = columns;
  options.Rows = rows;
  options.Order = stages ? Schedule::Stages : Schedule::Dynamic;
  options.Threads = threads;
  options.Progress = reporter.function();
  return options;
}

nb::dict triangulationDict(
  Triangulation&& triangulation, std::size_t points, bool longEdgesLeftOut, bool wantsNeighbors)
{
  nb::dict result;
  result["duplicates"] = duplicatesArray(triangulation.Duplicates);
  result["rejected"] = rejectedArray(triangulation.Rejected);
  result["warnings"] = warningsOf(triangulation, std::int64_t(points), longEdgesLeftOut);
  result["statistics"] = statisticsDict(
    statisticsOf(triangulation, std::int64_t(points), std::int64_t(triangulation.triangleCount())));
  if (wantsNeighbors)
  {
    result["neighbors"] = neighborsArray(triangulation);
  }
  result["triangles"] = triangulation.Ids64.empty() ? arrayOf(std::move(triangulation.Ids32), 3)
                                                    : arrayOf(std::move(triangulation.Ids64), 3);
  return result;
}

namespace
{

nb::dict triangulatePoints(const InputArray& points, double distance, double maximumEdge,
  int columns, int rows, bool stages, int threads, bool neighbors, nb::object progress)
{
  Reporter reporter(std::move(progress));
  const TriangulationOptions options =
    triangulationOptions(maximumEdge, columns, rows, stages, threads, reporter);
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

namespace
{

constexpr std::int64_t pointsAtOnce = 4096;

/// A TriangleLocator over NumPy arrays, which it keeps alive: float64 points of two columns, int32
/// corners and neighbours.
class Locator
{
public:
  Locator(InputArray points, InputArray corners, InputArray neighbors)
    : Points(std::move(points))
    , Corners(std::move(corners))
    , Neighbors(std::move(neighbors))
    , Finder(PointsView(static_cast<const double*>(this->Points.data()), this->Points.shape(0), 2),
        static_cast<const std::int32_t*>(this->Corners.data()),
        static_cast<const std::int32_t*>(this->Neighbors.data()), this->Corners.shape(0))
  {
  }

  /// Returns the triangle that contains each point, or -1.
  nb::object find(const InputArray& points, int threads) const
  {
    Buffer<char> found(points.shape(0) * sizeof(std::int32_t));
    this->forPoints(points, threads,
      [&](std::int64_t i, Point2 p)
      { found.as<std::int32_t>()[i] = std::int32_t(this->Finder.find(p)); });
    return arrayOf(std::move(found), Scalar::Int32, 1);
  }

  /// Interpolates linearly in each triangle; `fill` is the value outside. `values` has float64 rows
  /// for the triangulated points.
  nb::object interpolate(
    const InputArray& points, const InputArray& values, double fill, int threads) const
  {
    const std::size_t columns = values.shape(1);
    const auto* const rows = static_cast<const double*>(values.data());
    Buffer<char> samples(points.shape(0) * columns * sizeof(double));
    this->forPoints(points, threads,
      [&](std::int64_t i, Point2 p)
      {
        double* const sample = samples.as<double>() + std::size_t(i) * columns;
        const std::int64_t triangle = this->Finder.find(p);
        if (triangle < 0)
        {
          std::fill_n(sample, columns, fill);
          return;
        }
        double weights[3];
        this->Finder.weights(triangle, p, weights);
        const std::int32_t* const corners = this->Finder.corners(triangle);
        for (std::size_t c = 0; c < columns; ++c)
        {
          sample[c] = 0;
          for (int corner = 0; corner < 3; ++corner)
          {
            sample[c] += weights[corner] * rows[std::size_t(corners[corner]) * columns + c];
          }
        }
      });
    void* const memory = samples.release();
    return owningArray(memory, Scalar::Float64, { points.shape(0), columns });
  }

private:
  template <typename Work>
  void forPoints(const InputArray& points, int threads, const Work& work) const
  {
    const nb::gil_scoped_release released;
    const auto* const xy = static_cast<const double*>(points.data());
    forChunks(std::int64_t(points.shape(0)), pointsAtOnce, threadCount(threads), {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          work(i, { xy[2 * i], xy[2 * i + 1] });
        }
      });
  }

  InputArray Points;
  InputArray Corners;
  InputArray Neighbors;
  TriangleLocator Finder;
};

} // namespace

void addLocatorClass(nb::module_& module)
{
  nb::class_<Locator>(module, "Locator")
    .def(nb::init<InputArray, InputArray, InputArray>())
    .def("find", &Locator::find)
    .def("interpolate", &Locator::interpolate);
}

} // namespace tipp::python

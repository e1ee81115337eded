// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays/FindNeighbors.h"
#include "Binding.h"
#include "Constraints/ConstraintEdges.h"
#include "Constraints/Insertion/TriangulateConstrained.h"
#include "Constraints/PositionIndex.h"
#include "Constraints/ResolveCrossings.h"
#include "Constraints/SurfaceValues.h"
#include "Files/RawArray.h"
#include "InMemory/AlphaShape.h"
#include "InMemory/TriangulatePoints.h"
#include "Parallel/ParallelFor.h"
#include "Statistics/RunStatistics.h"
#include "Triangulation/TriangleLocator.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tipp::python
{
namespace
{

/// Converts (m, 2) ids of the ends of constraints, and for each the number of its line or polygon.
SourceConstraints constraintsOf(
  const InputArray& pairs, const InputArray& cells, std::size_t polygonBegin)
{
  static_assert(sizeof(Constraint) == 2 * sizeof(std::int64_t), "two ids in a row");
  return { vectorOf<Constraint>(pairs), vectorOf<std::int64_t>(cells), polygonBegin };
}

/// Returns rows of five values: x, y, the ids of the two points that the crossing lies between, and
/// its relative position between them.
nb::object crossingsArray(const std::vector<CrossingPoint>& crossings)
{
  std::vector<double> values;
  for (const CrossingPoint& crossing : crossings)
  {
    values.insert(values.end(),
      { crossing.Position.x, crossing.Position.y, double(crossing.A), double(crossing.B),
        crossing.Fraction });
  }
  return copyOf(values, 5);
}

/// Returns values of points, followed by the interpolated values of crossings as crossingsArray()
/// returns them.
nb::object interpolate(const InputArray& values, const InputArray& crossings)
{
  std::vector<CrossingPoint> points;
  for (const auto& [x, y, a, b, fraction] : vectorOf<std::array<double, 5>>(crossings))
  {
    if (std::max(a, b) >= double(values.shape(0) + points.size()))
    {
      throw std::runtime_error("an array has fewer values than there are points.");
    }
    points.push_back({ { x, y }, PointId(a), PointId(b), fraction });
  }
  const Scalar type = scalarOf(values.dtype());
  const std::size_t columns = componentsOf(values);
  Buffer<char> result(values.nbytes() + points.size() * columns * scalarSize(type));
  std::memcpy(result.data(), values.data(), values.nbytes());
  interpolateTuples(points, values.shape(0), type, columns, result.data());
  return arrayOf(std::move(result), type, columns);
}

/// Returns the id that each of the other points has among the points, and which of them are new.
nb::tuple matchedPositions(const InputArray& points, const InputArray& others)
{
  const MatchedPositions matched =
    withoutLock([&] { return matchPositions(viewOf(points), viewOf(others)); });
  return nb::make_tuple(copyOf(matched.Ids), copyOf(matched.New));
}

/// Triangulates points, with the constraints of `pairs` and `cells`, if given; see constraintsOf().
/// Returns triangles and warnings; with `details` also duplicates, rejected and statistics; with
/// `neighbors` and `marks` these arrays; with constraints also pieces and crossings.
//
// Details take half of the time for which a call for 1,000 points keeps the GIL.
nb::dict triangulateArrays(const InputArray& points, const std::optional<InputArray>& pairs,
  const std::optional<InputArray>& cells, std::size_t polygonBegin, bool split, bool marks,
  double distance, double maximumEdge, int columns, int rows, bool stages, int threads,
  bool neighbors, bool details, Progress progress)
{
  Reporter reporter(std::move(progress));
  SourceConstraints source;
  PointsRequest request;
  request.Distance = distance;
  request.Crossings = split ? CrossingRule::Split : CrossingRule::Refuse;
  request.Options.MaximumEdge = maximumEdge;
  request.Options.Columns = columns;
  request.Options.Rows = rows;
  request.Options.Order = stages ? Schedule::Stages : Schedule::Dynamic;
  request.Options.Threads = threads;
  request.Options.Progress = reporter.function();
  if (pairs)
  {
    source = constraintsOf(*pairs, *cells, polygonBegin);
    request.Source = &source;
  }
  std::vector<std::string> warnings;
  const ThreadLimit limit(threads);
  ConstrainedTriangulation result =
    withoutLock([&] { return triangulatePoints(viewOf(points), request, warnings); });
  reporter.finish();
  Triangulation& mesh = result.Mesh;
  const ResolvedConstraints& resolved = result.Constraints;
  nb::dict dict;
  if (pairs)
  {
    dict["pieces"] = idRowsOf(resolved.Segments);
    dict["crossings"] = crossingsArray(resolved.Crossings);
  }
  dict["warnings"] = warnings;
  if (details)
  {
    dict["duplicates"] = idRowsOf(mesh.Duplicates);
    dict["rejected"] = copyOf(mesh.Rejected);
    RunStatistics statistics =
      statisticsOf(mesh, std::int64_t(points.shape(0) + resolved.Crossings.size()),
        std::int64_t(mesh.triangleCount()));
    if (pairs)
    {
      addConstraintTotals({ resolved, source.Constraints.size() }, statistics);
    }
    dict["statistics"] = statisticsDict(statistics);
  }
  if (neighbors)
  {
    dict["neighbors"] = arrayOf(withoutLock([&] { return neighborIds(mesh); }), 3);
  }
  if (marks)
  {
    dict["marks"] =
      arrayOf(withoutLock([&] { return constraintMarks(mesh, resolved.Segments); }), 3);
  }
  dict["triangles"] =
    mesh.Ids64.empty() ? arrayOf(std::move(mesh.Ids32), 3) : arrayOf(std::move(mesh.Ids64), 3);
  return dict;
}

/// Triangulates points of shape (n, 3) in space. Returns a dictionary of cells, duplicates,
/// rejected, warnings and statistics; with `neighbors` also these. Cells are tetrahedra or, if all
/// points lie in one plane, triangles.
nb::dict tetrahedralizeArrays(const InputArray& points, double distance, int partitions,
  int threads, bool neighbors, Progress progress)
{
  Reporter reporter(std::move(progress));
  TetrahedralizationOptions options;
  options.Partitions = partitions;
  options.Threads = threads;
  options.Progress = reporter.function();
  const std::size_t count = points.shape(0);
  std::vector<Point3> copy;
  if (scalarOf(points.dtype()) == Scalar::Float32)
  {
    const auto* const floats = static_cast<const float*>(points.data());
    copy.resize(count);
    std::copy_n(floats, 3 * count, reinterpret_cast<double*>(copy.data()));
  }
  const Point3* const coordinates =
    copy.empty() ? static_cast<const Point3*>(points.data()) : copy.data();
  const ThreadLimit limit(threads);
  Triangulation triangles; // of coplanar points
  Tetrahedralization mesh = withoutLock(
    [&] { return tetrahedralizePoints(coordinates, count, distance, options, triangles); });
  reporter.finish();
  const bool isFlat = mesh.Dimension == 2;
  nb::dict dict;
  dict["duplicates"] = idRowsOf(mesh.Duplicates);
  dict["rejected"] = copyOf(mesh.Rejected);
  dict["warnings"] = warningsOf(mesh, std::int64_t(count));
  dict["statistics"] =
    statisticsDict(statisticsOf(mesh, std::int64_t(count), std::int64_t(mesh.cellCount())));
  if (neighbors)
  {
    dict["neighbors"] =
      arrayOf(withoutLock([&] { return isFlat ? neighborIds(triangles) : neighborIds(mesh); }),
        isFlat ? 3 : 4);
  }
  dict["cells"] = isFlat ? arrayOf(std::move(triangles.Ids32), 3) : arrayOf(std::move(mesh.Ids), 4);
  return dict;
}

/// Returns for each corner of a triangle or tetrahedron the index of the cell opposite to it, or
/// -1. `cells` has 32-bit ids.
nb::object neighborsOf(const InputArray& cells)
{
  const std::size_t count = cells.shape(0);
  const std::size_t corners = cells.shape(1);
  if (count > std::size_t(std::numeric_limits<std::int32_t>::max()) / corners)
  {
    throw std::length_error(std::to_string(count) + " cells are too many for 32-bit ids.");
  }
  const auto* const ids = static_cast<const std::int32_t*>(cells.data());
  Buffer<std::int32_t> neighbors(cells.size());
  withoutLock(
    [&]
    {
      corners == 3 ? findNeighbors<3>(ids, count, neighbors.data())
                   : findNeighbors<4>(ids, count, neighbors.data());
    });
  return arrayOf(std::move(neighbors), corners);
}

/// Returns the tetrahedra, triangles, lines and vertices of an alpha shape.
template <std::size_t Corners, typename Id>
nb::tuple alphaTuple(
  const InputArray& points, const InputArray& cells, double alpha, const InputArray& covered)
{
  const std::size_t width = points.shape(1);
  const auto read = [&](const auto* coordinates, PointId id, double* p)
  {
    const auto* const from = coordinates + std::size_t(id) * width;
    p[0] = double(from[0]);
    p[1] = double(from[1]);
    p[2] = width > 2 ? double(from[2]) : 0;
  };
  const bool isFloat = scalarOf(points.dtype()) == Scalar::Float32;
  const PointAt pointAt = [&](PointId id, double* p)
  {
    isFloat ? read(static_cast<const float*>(points.data()), id, p)
            : read(static_cast<const double*>(points.data()), id, p);
  };
  Buffer<Id> ids(cells.size());
  std::copy_n(static_cast<const Id*>(cells.data()), ids.size(), ids.data());
  AlphaShape<Id> shape =
    withoutLock([&] { return alphaShape<Corners>(ids, pointAt, alpha, vectorOf<char>(covered)); });
  const std::size_t vertices = shape.Vertices.size();
  return nb::make_tuple(arrayOf(std::move(shape.Tetrahedra), 4),
    arrayOf(std::move(shape.Triangles), 3), arrayOf(std::move(shape.Lines), 2),
    arrayOf(std::move(shape.Vertices), { vertices, 1 }));
}

/// Triangles have 32-bit or 64-bit ids, tetrahedra 32-bit ids.
nb::tuple alphaShapeOf(
  const InputArray& points, const InputArray& cells, double alpha, const InputArray& covered)
{
  const auto shape = cells.shape(1) == 4       ? alphaTuple<4, std::int32_t>
    : scalarOf(cells.dtype()) == Scalar::Int32 ? alphaTuple<3, std::int32_t>
                                               : alphaTuple<3, std::int64_t>;
  return shape(points, cells, alpha, covered);
}

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
    Buffer<std::int32_t> found(points.shape(0));
    this->forPoints(points, threads,
      [&](std::int64_t i, Point2 p)
      { found[std::size_t(i)] = std::int32_t(this->Finder.find(p)); });
    return arrayOf(std::move(found));
  }

  /// Interpolates linearly in each triangle; `fill` is the value outside. `values` has float64 rows
  /// for the triangulated points.
  nb::object interpolate(
    const InputArray& points, const InputArray& values, double fill, int threads) const
  {
    const std::size_t columns = values.shape(1);
    const auto* const rows = static_cast<const double*>(values.data());
    Buffer<double> samples(points.shape(0) * columns);
    this->forPoints(points, threads,
      [&](std::int64_t i, Point2 p)
      {
        double* const sample = samples.data() + std::size_t(i) * columns;
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
    return arrayOf(std::move(samples), { points.shape(0), columns });
  }

private:
  template <typename Work>
  void forPoints(const InputArray& points, int threads, const Work& work) const
  {
    const nb::gil_scoped_release released;
    const auto* const xy = static_cast<const double*>(points.data());
    forIndices(
      std::int64_t(points.shape(0)),
      [&](std::int64_t i) {
        work(i, { xy[2 * i], xy[2 * i + 1] });
      },
      threads, pointsAtOnce);
  }

  InputArray Points;
  InputArray Corners;
  InputArray Neighbors;
  TriangleLocator Finder;
};

} // namespace

void addTriangulateFunctions(nb::module_& module)
{
  nb::class_<Locator>(module, "Locator")
    .def(nb::init<InputArray, InputArray, InputArray>())
    .def("find", &Locator::find)
    .def("interpolate", &Locator::interpolate);
  module.def("triangulate", &triangulateArrays);
  module.def("tetrahedralize", &tetrahedralizeArrays);
  module.def("neighbors", &neighborsOf);
  module.def("match_positions", &matchedPositions);
  module.def("interpolate", &interpolate);
  module.def("alpha_shape", &alphaShapeOf);
}

} // namespace tipp::python

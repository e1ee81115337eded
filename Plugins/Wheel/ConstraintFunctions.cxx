// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"

#include "Constraints/Constraint.h"
#include "Constraints/ConstraintPoints.h"
#include "Constraints/KeepInside.h"
#include "Constraints/TriangulateConstrained.h"
#include "Output/RunStatistics.h"
#include "Parallel/ParallelFor.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstring>
#include <iterator>

namespace tipp::python
{
namespace
{

template <typename Value>
nb::object idsOf(const std::vector<Value>& values, std::size_t columns)
{
  Buffer<std::int64_t> ids(values.size() * sizeof(Value) / sizeof(std::int64_t));
  if (!values.empty())
  {
    std::memcpy(ids.data(), values.data(), values.size() * sizeof(Value));
  }
  return arrayOf(std::move(ids), columns);
}

/// Returns the id that each of the other points has among the points, and which of them are new.
nb::tuple matchedPositions(const InputArray& points, const InputArray& others)
{
  const MatchedPositions matched =
    withoutLock([&] { return matchPositions(viewOf(points), viewOf(others)); });
  return nb::make_tuple(idsOf(matched.Ids, 1), idsOf(matched.New, 1));
}

std::vector<Constraint> constraintsOf(const InputArray& pairs)
{
  static_assert(sizeof(Constraint) == 2 * sizeof(std::int64_t), "two ids in a row");
  std::vector<Constraint> result(pairs.shape(0));
  if (!result.empty())
  {
    std::memcpy(result.data(), pairs.data(), result.size() * sizeof(Constraint));
  }
  return result;
}

/// Returns rows of five values: x, y, the ids of the two points that the crossing lies between, and
/// its relative position between them.
nb::object crossingsArray(const std::vector<CrossingPoint>& crossings)
{
  constexpr std::size_t columns = 5;
  Buffer<char> values(columns * crossings.size() * sizeof(double));
  double* row = values.as<double>();
  for (const CrossingPoint& crossing : crossings)
  {
    row[0] = crossing.Position.x;
    row[1] = crossing.Position.y;
    row[2] = double(crossing.A);
    row[3] = double(crossing.B);
    row[4] = crossing.Fraction;
    row += columns;
  }
  return arrayOf(std::move(values), Scalar::Float64, columns);
}

/// Returns for each corner whether the edge opposite to it is part of a constraint.
template <typename Id>
nb::object edgeMarks(const Buffer<Id>& ids, const ConstraintEdges& edges)
{
  Buffer<char> marks(ids.size());
  for (std::size_t t = 0; t < ids.size(); t += 3)
  {
    for (std::size_t i = 0; i < 3; ++i)
    {
      marks.as<unsigned char>()[t + i] =
        edges.contains(ids[t + (i + 1) % 3], ids[t + (i + 2) % 3]) ? 1 : 0;
    }
  }
  return arrayOf(std::move(marks), Scalar::UInt8, 3);
}

nb::dict triangulateWithConstraints(const InputArray& points, const InputArray& pairs,
  std::size_t polygonBegin, bool split, bool marks, double maximumEdge, int columns, int rows,
  bool stages, int threads, bool neighbors, nb::object progress)
{
  Reporter reporter(std::move(progress));
  const TriangulationOptions options =
    triangulationOptions(maximumEdge, columns, rows, stages, threads, reporter);
  const std::vector<Constraint> constraints = constraintsOf(pairs);
  const std::size_t given = points.shape(0);
  std::vector<std::string> warnings; // of the triangulation before triangles are removed
  const auto cut = [&](ConstrainedTriangulation& whole)
  {
    const auto count = std::int64_t(given + whole.Constraints.Crossings.size());
    warnings = warningsOf(whole.Mesh, count, maximumEdge > 0);
    const std::vector<ConstraintPiece>& pieces = whole.Constraints.Pieces;
    keepInside(
      {}, whole.Mesh, pieces, { piecesOf(pieces, polygonBegin, constraints.size()), {}, {} });
  };
  ConstrainedTriangulation result = withoutLock(
    [&]
    {
      const ThreadLimit limit(threads);
      return triangulateConstrained(viewOf(points), constraints,
        split ? CrossingRule::Split : CrossingRule::Refuse, options, cut);
    });
  reporter(1);
  reporter.raiseIfStopped();
  const ResolvedConstraints& resolved = result.Constraints;
  const std::size_t count = given + resolved.Crossings.size();
  nb::object flags = nb::none();
  if (marks)
  {
    const ConstraintEdges edges(resolved.Pieces);
    flags = result.Mesh.Ids64.empty() ? edgeMarks(result.Mesh.Ids32, edges)
                                      : edgeMarks(result.Mesh.Ids64, edges);
  }
  nb::dict dict = triangulationDict(std::move(result.Mesh), count, maximumEdge > 0, neighbors);
  dict["warnings"] = warnings;
  dict["marks"] = flags;
  dict["pieces"] = idsOf(resolved.Pieces, 3);
  dict["crossings"] = crossingsArray(resolved.Crossings);
  dict["not_finite"] = resolved.NotFinite;
  nb::object statistics = dict["statistics"];
  ConstraintFigures(resolved, constraints.size())
    .visit(
      [&statistics](const char* key, const char*, std::int64_t value) { statistics[key] = value; });
  return dict;
}

} // namespace

void addConstraintFunctions(nb::module_& module)
{
  module.def("match_positions", &matchedPositions, nb::arg("points"), nb::arg("others"));
  module.def("triangulate_constrained", &triangulateWithConstraints, nb::arg("points"),
    nb::arg("pairs"), nb::arg("polygon_begin"), nb::arg("split"), nb::arg("marks"),
    nb::arg("maximum_edge"), nb::arg("columns"), nb::arg("rows"), nb::arg("stages"),
    nb::arg("threads"), nb::arg("neighbors"), nb::arg("progress").none());
}

} // namespace tipp::python

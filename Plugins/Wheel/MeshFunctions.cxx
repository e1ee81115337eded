// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"
#include "Files/PagedMemory.h"
#include "Files/RawArray.h"
#include "Parallel/ParallelFor.h"
#include "Refinement/MeshPoints.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace tipp::python
{
namespace
{

/// The points, the (m, 3) int32 corners and the float64 lengths of a surface of sizes.
using Surface = std::tuple<InputArray, InputArray, InputArray>;

RefinementOptions refinementOptions(const nb::dict& given)
{
  RefinementOptions options;
  options.MinimumAngle = of<double>(given, "min_angle");
  options.LargestArea = of<double>(given, "max_area");
  options.ShortestEdge = of<double>(given, "shortest_edge");
  options.KeepsBorder = of<bool>(given, "keep_border");
  options.KeepsSegments = of<bool>(given, "keep_segments");
  options.MostPoints = of<std::int64_t>(given, "most_points");
  options.Threads = of<int>(given, "threads");
  for (const auto& [x, y, area] : of<std::vector<std::array<double, 3>>>(given, "regions"))
  {
    options.Regions.push_back({ { x, y }, area });
  }
  return options;
}

void addMesh(PointsMesh& mesh, std::size_t regions, nb::dict& result)
{
  RefinedMesh& refined = mesh.Mesh;
  std::vector<std::array<std::int64_t, 3>> ids;
  std::vector<double> weights;
  for (const PointBlend& blend : mesh.Blends)
  {
    ids.push_back(blend.Ids);
    weights.insert(weights.end(), blend.Weights.begin(), blend.Weights.end());
  }
  Buffer<unsigned char> outside(refined.triangleCount());
  std::fill(outside.begin(), outside.end(), 0);
  for (const TriangleOutside& triangle : refined.Outside)
  {
    outside[std::size_t(triangle.Triangle)] = codeOf(triangle.Why);
  }
  result["ids"] = idRowsOf(ids);
  result["weights"] = copyOf(weights, 3);
  result["new"] = arrayOf(std::move(mesh.NewXY), 2);
  result["outside"] = arrayOf(std::move(outside));
  result["segments"] = idRowsOf(refined.Segments);
  if (regions > 0)
  {
    result["regions"] = arrayOf(std::move(refined.RegionOf));
  }
  result["triangles"] = arrayOf(std::move(refined.Triangles), 3);
}

/// Meshes points; `pairs` are the (m, 2) ids of the ends of constraints. Returns triangles, new
/// points, outside, segments and warnings; with `values` also the ids and weights of what each new
/// point lies between; with regions also these.
nb::dict meshArrays(const InputArray& points, const InputArray& pairs, std::size_t polygonBegin,
  const nb::dict& given, const std::optional<InputArray>& lengths,
  const std::optional<Surface>& surface, bool values, Progress progress)
{
  Reporter reporter(std::move(progress));
  SourceConstraints source{ vectorOf<Constraint>(pairs), {}, polygonBegin };
  for (const auto& [x, y] : of<std::vector<std::array<double, 2>>>(given, "holes"))
  {
    source.Holes.push_back({ x, y });
  }
  MeshRequest request;
  request.Refinement = refinementOptions(given);
  request.Refinement.Progress = reporter.function();
  request.Source = &source;
  request.Crossings = of<int>(given, "crossings") == 1 ? CrossingRule::Split : CrossingRule::Refuse;
  request.IsConvex = of<bool>(given, "convex");
  request.Lengths = lengths ? static_cast<const double*>(lengths->data()) : nullptr;
  request.HasValues = values;
  request.SmoothingRounds = of<int>(given, "smooth");
  LengthSurface sizes;
  if (surface)
  {
    const auto& [at, corners, its] = *surface;
    sizes = { viewOf(at), static_cast<const std::int32_t*>(corners.data()),
      std::int64_t(corners.shape(0)), static_cast<const double*>(its.data()) };
    request.Surface = &sizes;
  }
  std::vector<std::string> warnings;
  const std::unique_ptr<PagedMemory> memory = limitedMemory(of<std::string>(given, "scratch"),
    of<std::uint64_t>(given, "memory"), "give another folder as scratch");
  request.Refinement.Memory = memory.get();
  const ThreadLimit limit(request.Refinement.Threads);
  PointsMesh mesh = withoutLock([&] { return meshPoints(viewOf(points), request, warnings); });
  reporter.finish();
  nb::dict result;
  result["warnings"] = warnings;
  addMesh(mesh, request.Refinement.Regions.size(), result);
  return result;
}

/// Returns values of points, followed by those of new points: the means of the values of three ids
/// each, with the weights. Both have a row for each new point, as meshArrays() returns them.
nb::object blend(const InputArray& values, const InputArray& ids, const InputArray& weights)
{
  const auto rows = vectorOf<std::array<std::int64_t, 3>>(ids);
  const auto shares = vectorOf<std::array<double, 3>>(weights);
  Buffer<PointBlend> blends(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    for (const std::int64_t id : rows[i])
    {
      if (id < 0 || std::size_t(id) >= values.shape(0) + i)
      {
        throw std::runtime_error("an array has fewer values than there are points.");
      }
    }
    blends[i] = { rows[i], shares[i] };
  }
  const Scalar type = scalarOf(values.dtype());
  const std::size_t columns = componentsOf(values);
  Buffer<char> result(values.nbytes() + blends.size() * columns * scalarSize(type));
  std::memcpy(result.data(), values.data(), values.nbytes());
  blendTuples(blends, values.shape(0), type, columns, result.data());
  return arrayOf(std::move(result), type, columns);
}

} // namespace

void addMeshFunctions(nb::module_& module)
{
  module.def("mesh", &meshArrays);
  module.def("blend", &blend);
}

} // namespace tipp::python

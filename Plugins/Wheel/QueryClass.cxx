// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"

#include "Query/Queries.h"
#include "Resident/ResidentMesh.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace tipp::python
{
namespace
{

nb::tuple listsOf(const IdLists& lists)
{
  return nb::make_tuple(copyOf(lists.Starts), copyOf(lists.Ids));
}

/// Rings of polygons: (n, 2) corners, the first corner of each ring and the end, each ring's zone,
/// and whether it is a hole.
using RingArrays = std::tuple<InputArray, InputArray, InputArray, InputArray>;

std::vector<Zone> zonesOf(const RingArrays& rings, std::size_t count)
{
  const auto* const corners = static_cast<const Point2*>(std::get<0>(rings).data());
  const std::vector<std::int64_t> starts = vectorOf<std::int64_t>(std::get<1>(rings));
  const std::vector<std::int64_t> zoneOf = vectorOf<std::int64_t>(std::get<2>(rings));
  const std::vector<std::int64_t> holes = vectorOf<std::int64_t>(std::get<3>(rings));
  std::vector<Zone> zones(count);
  for (std::size_t i = 0; i < zoneOf.size(); ++i)
  {
    zones[std::size_t(zoneOf[i])].push_back(
      { { corners + starts[i], corners + starts[i + 1] }, holes[i] != 0 });
  }
  return zones;
}

Region regionOf(const std::vector<double>& box, const std::optional<RingArrays>& rings)
{
  Region region;
  region.Box = boxOfVtkBounds<3>(box.data());
  region.Polygons = rings ? zonesOf(*rings, 1)[0] : Zone();
  if (rings && region.Polygons.empty())
  {
    throw std::runtime_error("there are no polygons.");
  }
  return region;
}

/// Answers queries with NumPy arrays, which the Python side has checked: points are float64 of
/// shape (n, 3), ids int64. Works without the GIL.
class Query
{
public:
  Query(const std::string& path, std::uint64_t memory, int step, int threads)
    : Mesh(withoutLock(
        [&] {
          return std::make_unique<ResidentMesh>(path, ResidentOptions{ memory, threads, step });
        }))
  {
  }

  /// Opens a mesh in memory, which it does not copy. `ids`: the ids of its cells; none: their
  /// indices.
  Query(const InputArray& points, const InputArray& cells, const nb::dict& pointData,
    const nb::dict& cellData, const std::optional<InputArray>& ids, int threads)
  {
    struct OwnedMesh
    {
      InputArray Points, Cells;
      std::optional<InputArray> Ids;
      std::vector<NamedArray> Arrays[2];
    };
    const std::shared_ptr<const OwnedMesh> kept(new OwnedMesh{ points, cells, ids,
      { namedArrays(pointData, points, "points"), namedArrays(cellData, cells, "cells") } });
    MeshPart part;
    part.Mesh = meshOf(points, cells);
    part.OwnedCells = part.Mesh.Cells;
    part.CellIds = ids ? static_cast<const std::int64_t*>(ids->data()) : nullptr;
    for (const bool ofPoints : { true, false })
    {
      for (const auto& [name, array] : kept->Arrays[ofPoints ? 0 : 1])
      {
        StoredArray description;
        description.Name = name;
        description.OfPoints = ofPoints;
        description.Type = scalarOf(array.dtype());
        description.Components = int(componentsOf(array));
        part.Arrays.push_back({ description, array.data() });
      }
    }
    part.Keeps = kept;
    this->Mesh = std::make_unique<ResidentMesh>(std::move(part), ResidentOptions{ 1, threads });
  }

  std::vector<std::string> names() const { return this->Mesh->names(); }

  nb::tuple locate(const InputArray& points) const
  {
    AnswerOptions options;
    options.Weights = true;
    const MeshAnswer answer = this->ask(points, options);
    return nb::make_tuple(
      copyOf(answer.Cells), copyOf(answer.Weights, std::size_t(this->Mesh->mesh().CellSize)));
  }

  nb::tuple sample(const InputArray& points, const std::vector<std::string>& names) const
  {
    AnswerOptions options;
    options.Arrays = names;
    MeshAnswer answer = this->ask(points, options);
    return nb::make_tuple(copyOf(answer.Cells), valuesOf(answer));
  }

  nb::object neighbors(const InputArray& cells) const
  {
    const std::vector<std::int64_t> found =
      withoutLock([&] { return neighborsOf(*this->Mesh, vectorOf<std::int64_t>(cells)); });
    return copyOf(found, std::size_t(this->Mesh->mesh().CellSize));
  }
  nb::tuple star(const InputArray& points) const
  {
    return listsOf(
      withoutLock([&] { return starsOf(*this->Mesh, vectorOf<std::int64_t>(points)); }));
  }
  nb::tuple ringOfPoints(const InputArray& points, int k) const
  {
    return listsOf(
      withoutLock([&] { return ringsOfPoints(*this->Mesh, vectorOf<std::int64_t>(points), k); }));
  }
  nb::tuple ringOfCells(const InputArray& cells, int k) const
  {
    return listsOf(
      withoutLock([&] { return ringsOfCells(*this->Mesh, vectorOf<std::int64_t>(cells), k); }));
  }
  nb::tuple boundary() const
  {
    return listsOf(withoutLock([&] { return boundaryOf(*this->Mesh); }).Points);
  }
  nb::tuple contours(const std::string& array, int component, const InputArray& levels) const
  {
    const auto values = vectorOf<double>(levels);
    const Contours found =
      withoutLock([&] { return contoursOf(*this->Mesh, array, component, values); });
    return nb::make_tuple(copyOf(found.Starts), copyOf(found.Levels), positionsOf(found.Points, 3));
  }

  nb::tuple profile(
    const InputArray& polyline, double spacing, const std::vector<std::string>& names) const
  {
    const auto points = vectorOf<Point3>(polyline);
    Profile found = withoutLock([&] { return profileOf(*this->Mesh, points, spacing, names); });
    return nb::make_tuple(copyOf(found.Distances),
      positionsOf(found.Points, this->Mesh->mesh().CellSize - 1), copyOf(found.Answer.Cells),
      valuesOf(found.Answer));
  }

  nb::tuple closest(const InputArray& points) const
  {
    const ClosestLocations found = withoutLock(
      [&]
      {
        return closestTo(
          *this->Mesh, static_cast<const Point3*>(points.data()), std::int64_t(points.shape(0)));
      });
    return nb::make_tuple(
      copyOf(found.Cells), positionsOf(found.Points, 3), copyOf(found.Distances));
  }

  nb::object cells(
    const std::vector<double>& box, const std::optional<RingArrays>& rings, bool whole) const
  {
    const Region region = regionOf(box, rings);
    return copyOf(withoutLock([&] { return cellsIn(*this->Mesh, region, whole); }));
  }
  nb::object points(const std::vector<double>& box, const std::optional<RingArrays>& rings) const
  {
    const Region region = regionOf(box, rings);
    return copyOf(withoutLock([&] { return pointsIn(*this->Mesh, region); }));
  }

  nb::tuple zones(const RingArrays& rings, std::size_t count, const std::string& array,
    int component, double level) const
  {
    const std::vector<Zone> given = zonesOf(rings, count);
    const ZoneStatistics found =
      withoutLock([&] { return statisticsOf(*this->Mesh, given, array, component, level); });
    return nb::make_tuple(copyOf(found.Cells), copyOf(found.Area), copyOf(found.Low),
      copyOf(found.High), copyOf(found.Mean), copyOf(found.Sum), copyOf(found.Above));
  }

  nb::tuple descend(const InputArray& points, const std::string& array, int component) const
  {
    const auto from = vectorOf<Point3>(points);
    const Descents found =
      withoutLock([&] { return descentsOf(*this->Mesh, from, array, component); });
    return nb::make_tuple(
      copyOf(found.Starts), positionsOf(found.Points, 3), copyOf(found.Values), copyOf(found.Pits));
  }

  nb::tuple components() const
  {
    const Components found = withoutLock([&] { return componentsOf(*this->Mesh); });
    return nb::make_tuple(copyOf(found.OfCells), copyOf(found.Sizes));
  }

private:
  /// Returns the answer's values. Takes over the memory of its arrays.
  static nb::dict valuesOf(MeshAnswer& answer)
  {
    nb::dict result;
    for (MeshAnswer::Array& array : answer.Arrays)
    {
      result[array.Name.c_str()] =
        arrayOf(std::move(array.Values), array.Type, std::size_t(array.Components));
    }
    return result;
  }

  static nb::object positionsOf(const std::vector<Point3>& points, int columns)
  {
    std::vector<double> coordinates;
    for (const Point3& p : points)
    {
      coordinates.insert(coordinates.end(), { p.x, p.y });
      if (columns == 3)
      {
        coordinates.push_back(p.z);
      }
    }
    return copyOf(coordinates, std::size_t(columns));
  }

  MeshAnswer ask(const InputArray& points, const AnswerOptions& options) const
  {
    static_assert(sizeof(Point3) == 3 * sizeof(double));
    return withoutLock(
      [&]
      {
        return this->Mesh->answer(
          static_cast<const Point3*>(points.data()), std::int64_t(points.shape(0)), options);
      });
  }

  std::unique_ptr<ResidentMesh> Mesh;
};

} // namespace

void addQueryClass(nb::module_& module)
{
  nb::class_<Query>(module, "Query")
    .def(nb::init<const std::string&, std::uint64_t, int, int>())
    .def(nb::init<const InputArray&, const InputArray&, const nb::dict&, const nb::dict&,
           const std::optional<InputArray>&, int>(),
      nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none(), nb::arg())
    .def("names", &Query::names)
    .def("locate", &Query::locate)
    .def("sample", &Query::sample)
    .def("neighbors", &Query::neighbors)
    .def("star", &Query::star)
    .def("ring_of_points", &Query::ringOfPoints)
    .def("ring_of_cells", &Query::ringOfCells)
    .def("boundary", &Query::boundary)
    .def("contours", &Query::contours)
    .def("profile", &Query::profile)
    .def("closest", &Query::closest)
    .def("cells_in", &Query::cells)
    .def("points_in", &Query::points)
    .def("zones", &Query::zones)
    .def("descend", &Query::descend)
    .def("components", &Query::components);
}

} // namespace tipp::python

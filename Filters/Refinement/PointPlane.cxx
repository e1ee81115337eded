// SPDX-License-Identifier: BSD-3-Clause
#include "Refinement/PlaneValues.h"

#include "Constraints/SurfaceValues.h"
#include "Files/IOError.h"
#include "Locate/CellLocator.h"
#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"
#include "Resample/Resample.h"
#include "Triangulation/Triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace tipp
{
namespace
{

/// Returns the index of the column that the options choose. Throws IOError.
std::size_t chooseColumn(
  const PointTable& table, const PlaneValuesOptions& options, const std::string& path)
{
  const std::vector<std::string> names = table.names();
  std::vector<std::string> wanted = options.Names;
  if (!options.Column.empty())
  {
    wanted = { options.Column };
  }
  for (const std::string& name : wanted)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end())
    {
      return std::size_t(found - names.begin());
    }
  }
  // Any other column may hold anything, so that none is guessed.
  const std::set<std::string> known(names.begin(), names.end());
  throw IOError(path,
    "has no column '" + (wanted.empty() ? std::string("z") : wanted.front()) + "'" +
      listOfNames(known, "; name one of ") + ".");
}

/// Points with values, and triangles if the file has them.
struct GivenPoints
{
  std::vector<double> XYZ; ///< three per point, z = 0
  std::vector<double> Values;
  std::vector<std::int64_t> Triangles; ///< three point ids each
};

void requireFinite(const GivenPoints& points, const std::string& path)
{
  for (std::size_t i = 0; i < points.Values.size(); ++i)
  {
    if (!std::isfinite(points.Values[i]) || !std::isfinite(points.XYZ[3 * i]) ||
      !std::isfinite(points.XYZ[3 * i + 1]))
    {
      throw IOError(path,
        "has no finite value or position at point " + std::to_string(i) +
          " (counted from 0); remove the point.");
    }
  }
}

void requireIds(const GivenPoints& points, const std::string& path)
{
  const auto count = std::int64_t(points.Values.size());
  for (std::size_t i = 0; i < points.Triangles.size(); ++i)
  {
    if (points.Triangles[i] < 0 || points.Triangles[i] >= count)
    {
      throw IOError(path,
        "has a triangle (" + std::to_string(i / 3) + ", counted from 0) with the point " +
          std::to_string(points.Triangles[i]) + ", but " + std::to_string(count) +
          " points; copy or write it again.");
    }
  }
}

GivenPoints readGiven(const std::string& path, const PlaneValuesOptions& options)
{
  PointOptions reading;
  reading.Threads = threadCount(options.Threads);
  PointTable table = readPoints(path, reading);
  if (table.size() == 0)
  {
    throw IOError(path, "has no points; give a file with some.");
  }
  GivenPoints given;
  given.Values = std::move(table.Columns[chooseColumn(table, options, path)].Values);
  given.XYZ.resize(3 * table.size());
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    given.XYZ[3 * i] = table.XY[2 * i];
    given.XYZ[3 * i + 1] = table.XY[2 * i + 1];
  }
  requireFinite(given, path);
  if (holdsTriangles(path))
  {
    given.Triangles = readMesh(path).Triangles;
    requireIds(given, path);
  }
  return given;
}

class PointPlane : public PlaneValues
{
public:
  explicit PointPlane(GivenPoints given)
    : Given(std::move(given))
  {
  }

  Box2 box() const override
  {
    Box2 box = Box2::empty();
    for (std::size_t i = 0; i < this->Given.Values.size(); ++i)
    {
      box.extend(this->position(std::int64_t(i)));
    }
    return box;
  }

  double least(const Box2&, const Report&) override
  {
    return *std::min_element(this->Given.Values.begin(), this->Given.Values.end());
  }

  std::vector<double> sample(const SizeLattice& lattice, int threads, const Report& report) override
  {
    this->makeTriangles(threads, partOf(report, 0, 0.4));
    std::vector<double> values(lattice.nodes(), std::numeric_limits<double>::quiet_NaN());
    if (this->Given.Triangles.empty())
    {
      this->takeNearestPoints(lattice, threads, partOf(report, 0.4, 1), values);
      return values;
    }
    const SimplexMesh mesh = this->mesh();
    Attribute attribute;
    attribute.Values = this->Given.Values.data();
    attribute.Samples = values.data();
    attribute.NullValue = std::numeric_limits<double>::quiet_NaN();
    ResampleOptions options;
    options.Threads = threadCount(threads);
    options.Progress = partOf(report, 0.4, 0.6);
    if (resample(mesh, lattice.samples(), { attribute }, options).Aborted)
    {
      throw WorkAborted();
    }
    this->extend(mesh, lattice, threads, partOf(report, 0.6, 1), values);
    return values;
  }

private:
  Point2 position(std::int64_t point) const
  {
    return { this->Given.XYZ[3 * std::size_t(point)], this->Given.XYZ[3 * std::size_t(point) + 1] };
  }

  SimplexMesh mesh() const
  {
    SimplexMesh mesh;
    mesh.Points = this->Given.XYZ.data();
    mesh.Ids = this->Given.Triangles.data();
    mesh.Wide = true;
    mesh.Cells = std::int64_t(this->Given.Triangles.size() / 3);
    mesh.PointCount = std::int64_t(this->Given.Values.size());
    return mesh;
  }

  /// Triangulates the points unless the file has triangles.
  void makeTriangles(int threads, const Report& report)
  {
    if (!this->Given.Triangles.empty())
    {
      return;
    }
    TriangulationOptions options;
    options.Threads = threads;
    options.Progress = report;
    const Triangulation made =
      triangulate(PointsView(this->Given.XYZ.data(), this->Given.Values.size(), 3), options);
    if (made.Aborted)
    {
      throw WorkAborted();
    }
    this->Given.Triangles.assign(made.Ids32.begin(), made.Ids32.end());
    this->Given.Triangles.insert(this->Given.Triangles.end(), made.Ids64.begin(), made.Ids64.end());
  }

  void takeNearestPoints(const SizeLattice& lattice, int threads, const Report& report,
    std::vector<double>& values) const
  {
    std::vector<Point2> positions;
    for (std::size_t i = 0; i < this->Given.Values.size(); ++i)
    {
      positions.push_back(this->position(std::int64_t(i)));
    }
    takeNearest(lattice, positions, this->Given.Values, threads, report, values);
  }

  /// Gives nodes outside of all triangles the value at the nearest place of one.
  void extend(const SimplexMesh& mesh, const SizeLattice& lattice, int threads,
    const Report& report, std::vector<double>& values) const
  {
    const CellLocator locator(mesh, nullptr, threadCount(threads));
    forRows(lattice, threads, report,
      [&](int row)
      {
        for (int column = 0; column < lattice.columns(); ++column)
        {
          double& value = values[lattice.index(column, row)];
          if (std::isnan(value))
          {
            const Point2 node = lattice.at(column, row);
            NearCell nearest;
            locator.findNearest({ node.x, node.y, 0 }, nearest);
            value = this->valueOn(nearest.Id, { nearest.At.x, nearest.At.y });
          }
        }
      });
  }

  /// The value at a place of a triangle. -1, if all triangles are degenerate: at the first point.
  double valueOn(std::int64_t triangle, Point2 place) const
  {
    if (triangle < 0)
    {
      return this->Given.Values.front();
    }
    const std::int64_t* const ids = this->Given.Triangles.data() + 3 * triangle;
    return SurfaceTriangle(
      { this->position(ids[0]), this->position(ids[1]), this->position(ids[2]) })
      .valueAt(place, [&](std::size_t i) { return this->Given.Values[std::size_t(ids[i])]; });
  }

  GivenPoints Given;
};

} // namespace

std::unique_ptr<PlaneValues> openPointPlane(
  const std::string& path, const PlaneValuesOptions& options)
{
  return std::make_unique<PointPlane>(readGiven(path, options));
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatSeries.h"

#include "Files/IOError.h"
#include "Files/RawValues.h"
#include "Flat/DescribedSeries.h"
#include "Flat/FlatMesh.h"
#include "Series/VariableNames.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Reads one component of the tuples [begin, end) of an array.
std::vector<double> readComponent(
  const RawArray& array, int component, std::int64_t begin, std::int64_t end)
{
  const InputFile file(array.Path);
  std::vector<double> values(std::size_t(end - begin));
  const std::size_t size = scalarSize(array.Type);
  const std::size_t tuple = array.tupleBytes();
  // Whole tuples at a time.
  const std::size_t most = std::max<std::size_t>(1, (std::size_t(1) << 20) / tuple);
  std::vector<char> bytes(most * tuple);
  for (std::size_t first = 0; first < values.size(); first += most)
  {
    const std::size_t count = std::min(most, values.size() - first);
    file.read(array.Offset + (std::size_t(begin) + first) * tuple, bytes.data(), count * tuple);
    withScalar(array.Type,
      [&](auto type)
      {
        const char* from = bytes.data() + std::size_t(component) * size;
        for (std::size_t i = 0; i < count; ++i, from += tuple)
        {
          values[first + i] = double(valueAt<decltype(type)>(from));
        }
      });
  }
  return values;
}

std::vector<double> readComponent(const RawArray& array, int component)
{
  return readComponent(array, component, 0, array.Tuples);
}

class FlatSeries : public MeshSeries
{
public:
  explicit FlatSeries(const std::string& path)
    : Mesh(openFlatMesh(path))
  {
    if (this->Mesh.CellSize != 3)
    {
      throw IOError(
        path, "has tetrahedra, and time steps are resampled in the plane; give triangles.");
    }
    this->Path = path;
    this->Nodes = this->Mesh.Points.Tuples;
    this->Times = this->Mesh.Times;
    describeTimes(*this, this->Mesh.Description);
    for (const bool onCells : { false, true })
    {
      for (const RawArray& array : onCells ? this->Mesh.CellData : this->Mesh.PointData)
      {
        this->add({ array }, onCells, false);
      }
      for (const std::vector<RawArray>& steps :
        onCells ? this->Mesh.CellSeries : this->Mesh.PointSeries)
      {
        this->add(steps, onCells, true);
      }
    }
    if (this->Mesh.Points.Components == 3)
    {
      RawArray points = this->Mesh.Points;
      points.Name = heightName(this->Variables);
      this->Sources.push_back({ { points }, 2 });
      this->Variables.push_back({ points.Name, "", "", points.Type, false, false });
    }
  }

  SeriesMesh readMesh() override
  {
    SeriesMesh mesh;
    mesh.XY = interleaved(readComponent(this->Mesh.Points, 0), readComponent(this->Mesh.Points, 1));
    CellReader(this->Mesh).read(0, this->Mesh.Cells.Tuples, mesh.Triangles);
    return mesh;
  }

  SeriesNodes readTriangles(const TakeTriangles& take) override
  {
    SeriesNodes nodes;
    const std::int64_t count = this->Mesh.Points.Tuples;
    for (std::int64_t begin = 0; begin < count; begin += block)
    {
      const std::int64_t end = std::min(begin + block, count);
      const auto component = [&](int axis)
      { return readComponent(this->Mesh.Points, axis, begin, end); };
      nodes.add(interleaved(component(0), component(1)), count - end);
    }
    CellReader cells(this->Mesh);
    SeriesTriangles triangles;
    for (std::int64_t begin = 0; begin < this->Mesh.Cells.Tuples; begin += block)
    {
      triangles.FirstCell = begin;
      cells.read(begin, std::min(block, this->Mesh.Cells.Tuples - begin), triangles.Nodes);
      take(nodes, triangles);
    }
    return nodes;
  }

  void read(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    const Source& source = this->Sources[variable];
    values =
      readComponent(source.Steps[this->Variables[variable].Varies ? step : 0], source.Component);
    removeMarks(this->Variables[variable], values);
  }

  void readAt(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
    std::vector<double>& values) override
  {
    const Source& source = this->Sources[variable];
    const RawArray& array = source.Steps[this->Variables[variable].Varies ? step : 0];
    values.resize(at.size());
    for (std::size_t i = 0; i < at.size();)
    {
      const std::int64_t begin = at[i] / block * block;
      const std::int64_t end = std::min(begin + block, array.Tuples);
      const std::vector<double> read = readComponent(array, source.Component, begin, end);
      for (; i < at.size() && at[i] < end; ++i)
      {
        values[i] = read[std::size_t(at[i] - begin)];
      }
    }
    removeMarks(this->Variables[variable], values);
  }

private:
  static constexpr std::int64_t block = std::int64_t(1) << 20; ///< tuples that are read at once

  /// Where a variable is: its array at each step.
  struct Source
  {
    std::vector<RawArray> Steps;
    int Component;
  };

  void add(const std::vector<RawArray>& steps, bool onCells, bool varies)
  {
    const RawArray& first = steps.front();
    addVariables(
      *this, { first.Name, first.Type, first.Components, onCells, varies }, this->Mesh.Description);
    for (int i = 0; i < first.Components; ++i)
    {
      this->Sources.push_back({ steps, i });
    }
  }

  FlatMesh Mesh;
  std::vector<Source> Sources; ///< by variable
};

} // namespace

std::unique_ptr<MeshSeries> openFlatSeries(const std::string& path)
{
  return std::make_unique<FlatSeries>(path);
}

} // namespace tipp

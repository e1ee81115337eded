// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/PiecesSeries.h"

#include "Files/IOError.h"
#include "Files/RawValues.h"
#include "Flat/DescribedSeries.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/FlattenPieces.h"
#include "Series/VariableNames.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tipp
{
namespace
{

class PiecesSeries : public MeshSeries
{
public:
  explicit PiecesSeries(const std::string& path)
    : Mesh(openPartitionedMesh(path))
  {
    if (this->Mesh.CellSize != 3)
    {
      throw IOError(
        path, "has tetrahedra, and time steps are resampled in the plane; give triangles.");
    }
    this->Content = flattenPieces(this->Mesh);
    this->Path = path;
    this->Kind = "partitioned mesh";
    this->Nodes = this->Mesh.Points;
    this->Times = this->Mesh.Times;
    describeTimes(*this, this->Mesh.Description);
    for (const FlatArray& array : this->Content.PointData)
    {
      this->add(array, false);
    }
    for (const FlatArray& array : this->Content.CellData)
    {
      this->add(array, true);
    }
    const std::vector<PieceSummary>& pieces = this->Mesh.Pieces;
    if (std::any_of(pieces.begin(), pieces.end(),
          [](const PieceSummary& piece)
          { return piece.Extent.Min.z < 0 || piece.Extent.Max.z > 0; }))
    {
      this->Sources.push_back({ &this->Content.Points, 2 });
      this->Variables.push_back(
        { heightName(this->Variables), "", "", this->Content.Points.Type, false, false });
    }
  }

  SeriesMesh readMesh() override
  {
    SeriesMesh mesh;
    mesh.Triangles = this->Content.Cells;
    const FlatArray& points = this->Content.Points;
    mesh.XY =
      interleaved(componentOf(points, points.Values, 0), componentOf(points, points.Values, 1));
    return mesh;
  }

  void read(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    const auto [array, component] = this->Sources.at(variable);
    const bool varies = this->Variables[variable].Varies;
    values = componentOf(*array,
      array->StepValues ? array->StepValues(std::int64_t(varies ? step : 0)) : array->Values,
      component);
    removeMarks(this->Variables[variable], values);
  }

private:
  /// Where a variable is.
  struct Source
  {
    const FlatArray* Array;
    int Component;
  };

  static std::vector<double> componentOf(const FlatArray& array, const void* from, int component)
  {
    std::vector<double> values(std::size_t(array.Tuples));
    withScalar(array.Type,
      [&](auto type)
      {
        using T = decltype(type);
        const char* at = static_cast<const char*>(from) + std::size_t(component) * sizeof(T);
        for (double& value : values)
        {
          value = double(valueAt<T>(at));
          at += std::size_t(array.Components) * sizeof(T);
        }
      });
    return values;
  }

  void add(const FlatArray& array, bool onCells)
  {
    addVariables(*this, { array.Name, array.Type, array.Components, onCells, array.Steps > 0 },
      this->Mesh.Description);
    for (int i = 0; i < array.Components; ++i)
    {
      this->Sources.push_back({ &array, i });
    }
  }

  const PartitionedMesh Mesh;
  FlatContent Content;         ///< refers to Mesh
  std::vector<Source> Sources; ///< by variable
};

} // namespace

std::unique_ptr<MeshSeries> openPiecesSeries(const std::string& path)
{
  return std::make_unique<PiecesSeries>(path);
}

} // namespace tipp

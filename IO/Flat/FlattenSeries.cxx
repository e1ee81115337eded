// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Series/MeshSeries.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// An array that owns its values.
template <typename T>
FlatArray ownedArray(std::string name, Scalar type, std::vector<T> values, int components)
{
  const auto kept = std::make_shared<std::vector<T>>(std::move(values));
  const auto tuples = std::int64_t(kept->size()) / components;
  return { std::move(name), type, components, tuples, 0, kept->data(), kept };
}

/// Whole numbers can have no NaN, so they are written as floats that represent all of them.
Scalar storedType(Scalar type)
{
  const bool fitsFloat = type == Scalar::Float32 || type == Scalar::Int8 || type == Scalar::UInt8 ||
    type == Scalar::Int16 || type == Scalar::UInt16;
  return fitsFloat ? Scalar::Float32 : Scalar::Float64;
}

/// Reads a variable, or all components of a vector, step by step, in the type to be written.
class StepReader
{
public:
  StepReader(MeshSeries& series, std::size_t first, int components, Scalar type)
    : Series(series)
    , First(first)
    , Components(std::size_t(components))
    , Type(type)
  {
  }

  const void* read(std::int64_t step)
  {
    for (std::size_t c = 0; c < this->Components; ++c)
    {
      this->Series.read(this->First + c, std::size_t(step), this->Values);
      this->mark(this->Series.Variables[this->First + c].Mark);
      if (this->Components == 1 && this->Type == Scalar::Float64)
      {
        return this->Values.data();
      }
      this->Bytes.resize(this->Values.size() * this->Components * scalarSize(this->Type));
      this->Type == Scalar::Float32 ? this->put<float>(c) : this->put<double>(c);
    }
    return this->Bytes.data();
  }

private:
  void mark(double mark)
  {
    if (!std::isnan(mark))
    {
      std::replace_if(
        this->Values.begin(), this->Values.end(), [](double value) { return std::isnan(value); },
        mark);
    }
  }

  template <typename T>
  void put(std::size_t component)
  {
    char* to = this->Bytes.data() + component * sizeof(T);
    for (const double value : this->Values)
    {
      const auto stored = T(value);
      std::memcpy(to, &stored, sizeof stored);
      to += this->Components * sizeof(T);
    }
  }

  MeshSeries& Series;
  const std::size_t First;
  const std::size_t Components;
  const Scalar Type;
  std::vector<double> Values;
  std::vector<char> Bytes;
};

/// The array of a variable, or of the vector whose components begin with it.
FlatArray arrayOf(MeshSeries& series, std::size_t first, std::int64_t tuples)
{
  const SeriesVariable& variable = series.Variables[first];
  int components = 1;
  while (!variable.Vector.empty() && first + std::size_t(components) < series.Variables.size() &&
    series.Variables[first + std::size_t(components)].Vector == variable.Vector)
  {
    ++components;
  }
  FlatArray array;
  array.Name = variable.Vector.empty() ? variable.Name : variable.Vector;
  array.Type = storedType(variable.Type);
  array.Components = components;
  array.Tuples = tuples;
  array.Steps = variable.Varies ? std::int64_t(series.Times.size()) : 0;
  const auto reader = std::make_shared<StepReader>(series, first, components, array.Type);
  array.StepValues = [reader](std::int64_t step) { return reader->read(step); };
  return array;
}

} // namespace

FlatContent flattenSeries(MeshSeries& series)
{
  SeriesMesh mesh = series.readMesh();
  FlatContent content;
  content.Cells = std::move(mesh.Triangles);
  content.Points = ownedArray("points", Scalar::Float64, std::move(mesh.XY), 2);
  const auto cells = std::int64_t(content.Cells.size() / 3);
  for (std::size_t i = 0; i < series.Variables.size();)
  {
    const bool isOnCells = series.Variables[i].OnCells;
    FlatArray array = arrayOf(series, i, isOnCells ? cells : content.Points.Tuples);
    i += std::size_t(array.Components);
    (isOnCells ? content.CellData : content.PointData).push_back(std::move(array));
  }
  if (!mesh.OriginalCells.empty())
  {
    content.CellData.push_back(
      ownedArray("OriginalCellId", Scalar::Int64, std::move(mesh.OriginalCells), 1));
  }
  content.Times = series.Times;
  return content;
}

} // namespace tipp

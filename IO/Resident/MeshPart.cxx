// SPDX-License-Identifier: BSD-3-Clause
#include "Resident/MeshPart.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace tipp
{

MeshPart partOf(Piece piece)
{
  const auto held = std::make_shared<const Piece>(std::move(piece));
  MeshPart part;
  part.Mesh.Points = held->Coordinates.data();
  part.Mesh.Float = held->PointType == Scalar::Float32;
  part.Mesh.Ids = held->Connectivity.data();
  part.Mesh.Wide = held->WideIds;
  part.Mesh.Cells = held->Cells;
  part.Mesh.PointCount = held->Points;
  part.Mesh.Dimension = held->CellSize - 1;
  part.OwnedCells = held->OwnedCells;
  part.CellIds = held->CellIds.as<std::int64_t>();
  part.PointIds = held->PointIds.as<std::int64_t>();
  part.Ghosts = held->PointGhosts.as<std::uint8_t>();
  for (const Piece::Attribute& attribute : held->Attributes)
  {
    part.Arrays.push_back({ attribute.Description, attribute.Values.data() });
  }
  part.Keeps = held;
  return part;
}

PartValues::PartValues(const MeshPart& part, const StoredArray* array)
  : Part(part)
{
  if (!array)
  {
    this->Description.Type = part.Mesh.Float ? Scalar::Float32 : Scalar::Float64;
    this->Values = part.Mesh.Points;
    this->Stride = 3;
    this->First = 2;
    return;
  }
  const auto found = std::find_if(part.Arrays.begin(), part.Arrays.end(),
    [array](const MeshPart::Array& a)
    {
      return a.Description.Name == array->Name && a.Description.OfPoints == array->OfPoints &&
        a.Description.Step == array->Step;
    });
  if (found == part.Arrays.end())
  {
    throw std::logic_error("the array '" + array->Name + "' is not in memory");
  }
  this->Description = *array;
  this->Values = found->Values;
  this->Stride = array->Components;
}

template <typename Value>
Value PartValues::valueAt(const CellLocation& at, int component) const
{
  const auto* const values = static_cast<const Value*>(this->Values) + this->First + component;
  const int corners = this->Part.Mesh.Dimension + 1;
  if (!this->Description.OfPoints)
  {
    return values[this->Part.row(at.Cell) * this->Stride];
  }
  if constexpr (std::is_floating_point_v<Value>)
  {
    double sum = 0;
    for (int i = 0; i < corners; ++i)
    {
      // A corner with weight 0 may have the value NaN, which must not count.
      const double value = double(values[this->corner(at.Cell, i) * this->Stride]);
      sum += at.Weights[i] == 0 ? 0 : at.Weights[i] * value;
    }
    return Value(sum);
  }
  else
  {
    const double* const most = std::max_element(at.Weights, at.Weights + corners);
    return values[this->corner(at.Cell, int(most - at.Weights)) * this->Stride];
  }
}

void PartValues::sample(
  const CellLocation* at, const std::int64_t* tuples, std::int64_t count, char* values) const
{
  withScalar(this->Description.Type,
    [&](auto zero)
    {
      using Value = decltype(zero);
      const auto components = std::size_t(this->Description.Components);
      constexpr std::int64_t ahead = 32; // values are accessed at random
      for (std::int64_t i = 0; i < count; ++i)
      {
        // Prefetches this many at once, so that the accesses to their pages overlap.
        for (std::int64_t next = i == 0 ? 0 : i + ahead;
             i % ahead == 0 && this->Description.OfPoints && next < std::min(i + 2 * ahead, count);
             ++next)
        {
          for (int k = 0; k <= this->Part.Mesh.Dimension; ++k)
          {
            __builtin_prefetch(static_cast<const Value*>(this->Values) +
              this->corner(at[next].Cell, k) * this->Stride);
          }
        }
        char* const to = values + std::size_t(tuples[i]) * components * sizeof(Value);
        for (std::size_t k = 0; k < components; ++k)
        {
          const Value value = this->valueAt<Value>(at[i], int(k));
          std::memcpy(to + k * sizeof value, &value, sizeof value);
        }
      }
    });
}

double PartValues::atPoint(std::int64_t point, int component) const
{
  double result = 0;
  withScalar(this->Description.Type,
    [&](auto zero)
    {
      const auto* const values = static_cast<const decltype(zero)*>(this->Values);
      result = double(values[point * this->Stride + this->First + component]);
    });
  return result;
}

namespace
{

/// A map from global ids to local indices; none if the ids are the indices.
std::optional<GlobalIdMap> mapOf(const std::int64_t* ids, std::int64_t count)
{
  if (!ids)
  {
    return std::nullopt;
  }
  const auto size = std::size_t(count);
  if (std::is_sorted(ids, ids + size))
  {
    return GlobalIdMap(ids, nullptr, size);
  }
  std::vector<std::int64_t> order(size);
  std::iota(order.begin(), order.end(), std::int64_t(0));
  std::sort(order.begin(), order.end(), [ids](auto a, auto b) { return ids[a] < ids[b]; });
  std::vector<std::int64_t> sorted(size);
  std::transform(order.begin(), order.end(), sorted.begin(), [ids](auto i) { return ids[i]; });
  return GlobalIdMap(sorted.data(), order.data(), size);
}

} // namespace

PartTopology::PartTopology(const MeshPart& part)
  : Mesh(part.Mesh)
  , PointMap(mapOf(part.PointIds, part.Mesh.PointCount))
  , CellMap(mapOf(part.CellIds, part.Mesh.Cells))
{
  if (this->Mesh.Cells > std::numeric_limits<std::int32_t>::max())
  {
    throw std::length_error("More than 2147483647 cells in one piece; partition the mesh first.");
  }
  this->AtPoints = { std::size_t(this->Mesh.PointCount), 1,
    [&](const auto& visit)
    {
      for (std::int64_t cell = 0; cell < this->Mesh.Cells; ++cell)
      {
        for (int i = 0; i < this->corners() && !part.isHidden(cell); ++i)
        {
          const std::int64_t point = this->corner(cell, i);
          bool isRepeated = false;
          for (int k = 0; k < i; ++k)
          {
            isRepeated = isRepeated || this->corner(cell, k) == point;
          }
          if (!isRepeated)
          {
            visit(std::size_t(point), std::int32_t(cell));
          }
        }
      }
    } };
}

} // namespace tipp

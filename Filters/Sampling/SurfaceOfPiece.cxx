// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/SurfaceOfPiece.h"

#include "Sampling/SampleNames.h"

#include <algorithm>
#include <cmath>
#include <list>
#include <memory>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

constexpr int hiddenCell = 32; // VTK's vtkDataSetAttributes::HIDDENCELL

/// A piece, and what a surface of it refers to.
struct KeptPiece
{
  Piece Cells;
  std::vector<unsigned char> Hidden;
  std::list<std::vector<double>> Values; ///< stay where they are
};

const double* valuesOf(KeptPiece& kept, const SurfaceArray& array)
{
  const auto found = std::find_if(kept.Cells.Attributes.begin(), kept.Cells.Attributes.end(),
    [&array](const Piece::Attribute& attribute)
    {
      return attribute.Description.Name == array.Name &&
        attribute.Description.OfPoints != array.OfCells;
    });
  kept.Values.emplace_back();
  return doublesOf(*found, kept.Values.back());
}

} // namespace

SimplexMesh meshOf(const Piece& piece, const std::vector<int>& axes)
{
  SimplexMesh mesh;
  mesh.Points = piece.Coordinates.data();
  mesh.Float = piece.PointType == Scalar::Float32;
  mesh.Ids = piece.Connectivity.data();
  mesh.Wide = piece.WideIds;
  mesh.Cells = piece.OwnedCells;
  mesh.PointCount = piece.Points;
  mesh.Dimension = piece.CellSize - 1;
  mesh.Axes[0] = axes[0];
  mesh.Axes[1] = axes[1];
  return mesh;
}

bool markNotFinite(const Piece& piece, const std::vector<int>& axes, std::vector<bool>& marked)
{
  bool isAny = false;
  withScalar(piece.PointType,
    [&](auto zero)
    {
      const auto* const points = piece.Coordinates.as<decltype(zero)>();
      for (std::size_t i = 0; i < marked.size(); ++i)
      {
        for (const int axis : axes)
        {
          if (!std::isfinite(double(points[3 * i + std::size_t(axis)])))
          {
            marked[i] = true;
            isAny = true;
          }
        }
      }
    });
  return isAny;
}

std::vector<unsigned char> hiddenCells(const Piece& piece)
{
  std::vector<unsigned char> hidden(std::size_t(piece.OwnedCells), 0);
  for (const Piece::Attribute& attribute : piece.Attributes)
  {
    const StoredArray& array = attribute.Description;
    if (array.Name == ghostArrayName && !array.OfPoints && array.Type == Scalar::UInt8 &&
      array.Components == 1)
    {
      const std::uint8_t* const ghosts = attribute.Values.as<std::uint8_t>();
      std::transform(ghosts, ghosts + hidden.size(), hidden.begin(),
        [](std::uint8_t ghost) { return (unsigned char)((ghost & hiddenCell) != 0); });
    }
  }
  return hidden;
}

std::int64_t hideAt(
  const Piece& piece, const std::vector<bool>& marked, std::vector<unsigned char>& hidden)
{
  std::int64_t count = 0;
  for (std::int64_t cell = 0; cell < piece.OwnedCells; ++cell)
  {
    bool isMarked = false;
    for (int i = 0; i < piece.CellSize; ++i)
    {
      isMarked = isMarked || marked[std::size_t(piece.corner(cell, i))];
    }
    count += isMarked && !hidden[std::size_t(cell)] ? 1 : 0;
    hidden[std::size_t(cell)] |= (unsigned char)(isMarked);
  }
  return count;
}

const double* doublesOf(const Piece::Attribute& attribute, std::vector<double>& copy)
{
  const StoredArray& array = attribute.Description;
  if (array.Type == Scalar::Float64)
  {
    return attribute.Values.as<double>();
  }
  withScalar(array.Type,
    [&](auto zero)
    {
      using T = decltype(zero);
      const T* const values = attribute.Values.as<T>();
      copy.assign(values, values + attribute.Values.size() / sizeof(T));
    });
  return copy.data();
}

SurfacePart surfaceOf(Piece piece, const std::string& name, const std::vector<int>& axes)
{
  if (piece.CellSize != 3 && piece.OwnedCells > 0)
  {
    throw std::runtime_error(name + " has cells with a volume: give a surface.");
  }
  const auto kept = std::make_shared<KeptPiece>();
  kept->Cells = std::move(piece);
  const Piece& cells = kept->Cells;
  SurfacePart surface;
  kept->Hidden = hiddenCells(cells);
  std::vector<bool> marked(std::size_t(cells.Points), false);
  if (markNotFinite(cells, axes, marked))
  {
    surface.NotFinite = hideAt(cells, marked, kept->Hidden);
  }
  surface.Mesh = meshOf(cells, { 0, 1 });
  surface.Mesh.Hidden = kept->Hidden.data();
  surface.Cells = cells.OwnedCells;
  for (const bool ofCells : { true, false })
  {
    for (const Piece::Attribute& attribute : cells.Attributes)
    {
      const StoredArray& array = attribute.Description;
      if (array.OfPoints != ofCells && array.Name != ghostArrayName && !array.Name.empty())
      {
        surface.Arrays.push_back({ array.Name, array.Components, ofCells });
      }
    }
  }
  surface.Values = [kept = kept.get()](const SurfaceArray& array)
  { return valuesOf(*kept, array); };
  surface.Owner = kept;
  return surface;
}

} // namespace tipp

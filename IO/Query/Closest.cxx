// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Closest.h"

#include "Locate/CellLocator.h"
#include "Query/ForPieces.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

template <int D>
std::array<double, D> arrayOf(const Point3& p)
{
  std::array<double, D> result;
  const double coordinates[3] = { p.x, p.y, p.z };
  std::copy_n(coordinates, D, result.begin());
  return result;
}

/// Finds the pieces near points by their boxes. Each location of the mesh is in the box of a piece
/// that has all cells there.
template <int D>
class NearPieces
{
public:
  explicit NearPieces(const ResidentMesh& mesh)
    : Pieces(mesh.mesh().Pieces)
    , IsStored(mesh.isStored())
    , Tree(std::int64_t(Pieces.size()), 1, [this](std::int64_t i) { return this->box(i); })
  {
  }

  /// The nearest piece that has cells; -1: none.
  std::int32_t nearest(const Point3& point) const
  {
    if (!this->IsStored)
    {
      return this->Pieces[0].Cells > 0 ? 0 : -1;
    }
    std::int32_t found = -1;
    double least = std::numeric_limits<double>::infinity();
    this->Tree.searchNear(arrayOf<D>(point),
      [&](std::int32_t piece)
      {
        const double apart = this->distance(piece, point);
        if (apart < least || (apart == least && piece < found))
        {
          found = piece;
          least = apart;
        }
        return least;
      });
    return found;
  }

  /// Calls visit(piece) for all pieces but `but` that may be within the distance `most`.
  template <typename Visit>
  void visitOthers(const Point3& point, std::int32_t but, double most, const Visit& visit) const
  {
    if (this->IsStored)
    {
      this->Tree.searchNear(arrayOf<D>(point),
        [&](std::int32_t piece)
        {
          piece != but&& this->distance(piece, point) <= most ? visit(piece) : void();
          return most;
        });
    }
  }

private:
  Box<D> box(std::int64_t piece) const
  {
    const PieceSummary& summary = this->Pieces[std::size_t(piece)];
    Box<D> box = Box<D>::empty();
    for (std::size_t axis = 0; axis < D && summary.Cells + summary.BorrowedCells > 0; ++axis)
    {
      box.Low[axis] = summary.Box[2 * axis];
      box.High[axis] = summary.Box[2 * axis + 1];
    }
    return box;
  }

  /// At most the distance of a point from a piece's box.
  double distance(std::int32_t piece, const Point3& point) const
  {
    const Box<D> box = this->box(piece);
    const std::array<double, D> at = arrayOf<D>(point);
    double apart[3] = { 0, 0, 0 };
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      apart[axis] = std::max({ box.Low[axis] - at[axis], at[axis] - box.High[axis], 0.0 });
    }
    return std::hypot(apart[0], apart[1], apart[2]) * (1 - 1e-14);
  }

  const std::vector<PieceSummary>& Pieces;
  const bool IsStored;
  BoxTree<D> Tree;
};

/// Searches the pieces of the items, pieces[i] for the point with the index asked[i].
void searchPieces(const ResidentMesh& mesh, const std::vector<std::int32_t>& pieces,
  const std::vector<std::int64_t>& asked, const Point3* points, std::vector<NearCell>& best)
{
  PieceNeeds needs;
  needs.Locator = true;
  std::array<std::mutex, 64> locks; // several pieces may search for one point
  const PieceGroups groups = groupByPiece(pieces, mesh.mesh().Pieces.size());
  forPieces(mesh, groups, needs,
    [&](const ResidentPiece& piece, std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const auto item = std::size_t(asked[std::size_t(groups.Items[std::size_t(i)])]);
        NearCell found;
        {
          const std::lock_guard<std::mutex> lock(locks[item % locks.size()]);
          found = best[item];
        }
        piece.Locator->findNearest(points[item], found);
        const std::lock_guard<std::mutex> lock(locks[item % locks.size()]);
        if (found.Id >= 0 && found.isBetterThan(best[item], points[item]))
        {
          best[item] = found;
        }
      }
    });
}

template <int D>
void findOutside(
  const ResidentMesh& mesh, const std::vector<Point3>& points, std::vector<NearCell>& best)
{
  const NearPieces<D> near(mesh);
  std::vector<std::int32_t> first;
  std::vector<std::int64_t> asked;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    first.push_back(near.nearest(points[i]));
    asked.push_back(std::int64_t(i));
  }
  searchPieces(mesh, first, asked, points.data(), best);
  std::vector<std::int32_t> others;
  asked.clear();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    near.visitOthers(points[i], first[i], best[i].High,
      [&](std::int32_t piece)
      {
        others.push_back(piece);
        asked.push_back(std::int64_t(i));
      });
  }
  searchPieces(mesh, others, asked, points.data(), best);
}

} // namespace

ClosestLocations closestTo(const ResidentMesh& mesh, const Point3* points, std::int64_t count)
{
  const bool inSpace = mesh.mesh().CellSize == 4;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ClosestLocations result;
  result.Cells = mesh.answer(points, count).Cells;
  result.Points.assign(std::size_t(count), { nan, nan, nan });
  result.Distances.assign(std::size_t(count), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> indices;
  std::vector<Point3> outside;
  for (std::size_t i = 0; i < std::size_t(count); ++i)
  {
    const Point3 p{ points[i].x, points[i].y, inSpace ? points[i].z : 0 };
    if (result.Cells[i] >= 0)
    {
      result.Points[i] = p;
      result.Distances[i] = 0;
    }
    else if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z))
    {
      indices.push_back(i);
      outside.push_back(p);
    }
  }
  std::vector<NearCell> best(outside.size());
  inSpace ? findOutside<3>(mesh, outside, best) : findOutside<2>(mesh, outside, best);
  for (std::size_t k = 0; k < best.size(); ++k)
  {
    if (best[k].Id >= 0)
    {
      result.Cells[indices[k]] = best[k].Id;
      result.Distances[indices[k]] = best[k].distance(outside[k]);
      result.Points[indices[k]] = best[k].At;
    }
  }
  return result;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Query/Queries.h"

#include "Locate/CellLocator.h"
#include "Query/RankAnswer.h"
#include "Resident/ForPieces.h"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace tipp
{
namespace
{

/// Finds pieces of a stored mesh near points by their boxes. Every location of the mesh is in the
/// box of a piece that has all cells there.
template <int D>
class NearPieces
{
public:
  explicit NearPieces(const ResidentMesh& mesh)
    : Pieces(mesh.mesh().Pieces)
    , Tree(std::int64_t(Pieces.size()), 1, [this](std::int64_t i) { return this->box(i); })
  {
  }

  /// The piece with cells whose box is nearest to the point, or -1.
  std::int32_t nearest(const Point3& point) const
  {
    std::int32_t found = -1;
    double least = std::numeric_limits<double>::infinity();
    this->Tree.searchNear(projected<D>(point),
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

  /// Calls visit(piece) for all pieces except `but` whose boxes may be within the distance `most`
  /// of the point.
  template <typename Visit>
  void visitOthers(const Point3& point, std::int32_t but, double most, const Visit& visit) const
  {
    this->Tree.searchNear(projected<D>(point),
      [&](std::int32_t piece)
      {
        if (piece != but && this->distance(piece, point) <= most)
        {
          visit(piece);
        }
        return most;
      });
  }

private:
  Box<D> box(std::int64_t piece) const
  {
    const PieceSummary& summary = this->Pieces[std::size_t(piece)];
    return summary.Cells + summary.BorrowedCells > 0 ? projected<D>(summary.Box) : Box<D>::empty();
  }

  /// A lower bound of the distance between a point and a piece's box.
  double distance(std::int32_t piece, const Point3& point) const
  {
    const Box<D> box = this->box(piece);
    const Point<D> at = projected<D>(point);
    double apart[3] = { 0, 0, 0 };
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      apart[axis] = std::max({ box.Min[axis] - at[axis], at[axis] - box.Max[axis], 0.0 });
    }
    return std::hypot(apart[0], apart[1], apart[2]) * (1 - 1e-14);
  }

  const std::vector<PieceSummary>& Pieces;
  BoxTree<D> Tree;
};

/// Keeps the nearer one of two cells in `best`.
void keepBetter(const NearCell& found, const Point3& point, NearCell& best)
{
  if (found.Id >= 0 && found.isBetterThan(best, point))
  {
    best = found;
  }
}

/// Searches pieces[i] for the cell nearest to the point with the index asked[i], and keeps it in
/// `best` if it is nearer than the cell there.
void searchPieces(const ResidentMesh& mesh, const std::vector<std::int32_t>& pieces,
  const std::vector<std::int64_t>& asked, const Point3* points, std::vector<NearCell>& best)
{
  PieceNeeds needs;
  needs.Locator = true;
  std::array<std::mutex, 64> locks; // several threads may search for the same point
  const PieceGroups groups = groupByPiece(pieces);
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
        keepBetter(found, points[item], best[item]);
      }
    });
}

/// Searches the pieces of a mesh, or of those of all ranks. Of meshes in memory, piece i is that of
/// rank i.
class PieceSearch
{
public:
  PieceSearch(Communicator* ranks, const ResidentMesh& mesh, std::int64_t firstCell)
    : Ranks(areSeveral(ranks) ? ranks : nullptr)
    , Mesh(mesh)
    , FirstCell(firstCell)
  {
  }

  /// As searchPieces(). Several ranks send their points to the ranks that have the pieces.
  /// Collective.
  void operator()(const std::vector<std::int32_t>& pieces, const std::vector<std::int64_t>& asked,
    const Point3* points, std::vector<NearCell>& best) const
  {
    if (!this->Ranks)
    {
      searchPieces(this->Mesh, pieces, asked, points, best);
      return;
    }
    const bool isStored = this->Mesh.isStored();
    std::vector<Question> questions;
    std::vector<std::size_t> rankOf;
    std::vector<std::size_t> items;
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      if (pieces[i] >= 0)
      {
        items.push_back(std::size_t(asked[i]));
        questions.push_back({ points[items.back()], isStored ? pieces[i] : 0, best[items.back()] });
        rankOf.push_back(
          isStored ? rankOfPiece(*this->Ranks, this->Mesh, pieces[i]) : std::size_t(pieces[i]));
      }
    }
    const std::vector<NearCell> answers = askRanks(*this->Ranks, rankOf, std::move(questions),
      [this](const std::vector<Question>& received) { return this->answer(received); });
    for (std::size_t i = 0; i < items.size(); ++i)
    {
      keepBetter(answers[i], points[items[i]], best[items[i]]);
    }
  }

private:
  struct Question
  {
    Point3 Position;
    std::int32_t Piece;
    NearCell Best; ///< the nearest cell found so far
  };

  std::vector<NearCell> answer(const std::vector<Question>& questions) const
  {
    std::vector<std::int32_t> pieces;
    std::vector<std::int64_t> asked;
    std::vector<Point3> points;
    std::vector<NearCell> best;
    for (const Question& question : questions)
    {
      asked.push_back(std::int64_t(points.size()));
      pieces.push_back(question.Piece);
      points.push_back(question.Position);
      best.push_back(question.Best);
    }
    searchPieces(this->Mesh, pieces, asked, points.data(), best);
    for (NearCell& cell : best)
    {
      cell.Id += cell.Id >= 0 ? this->FirstCell : 0;
    }
    return best;
  }

  Communicator* const Ranks; ///< null: this process alone
  const ResidentMesh& Mesh;
  const std::int64_t FirstCell; ///< added to this rank's cell ids; 0 if these are global
};

/// Finds the nearest cells to points outside a stored mesh.
template <int D>
void findOutside(const ResidentMesh& mesh, const std::vector<Point3>& points,
  const PieceSearch& search, std::vector<NearCell>& best)
{
  const NearPieces<D> near(mesh);
  std::vector<std::int32_t> first;
  std::vector<std::int64_t> asked;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    first.push_back(near.nearest(points[i]));
    asked.push_back(std::int64_t(i));
  }
  search(first, asked, points.data(), best);
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
  search(others, asked, points.data(), best);
}

} // namespace

ClosestLocations closestTo(
  const ResidentMesh& mesh, const Point3* points, std::int64_t count, Communicator* ranks)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  ClosestLocations result;
  result.Cells = answerOf(mesh, points, count, {}, ranks).Cells;
  result.Points.assign(result.Cells.size(), { nan, nan, nan });
  result.Distances.assign(result.Cells.size(), std::numeric_limits<double>::infinity());
  const RankParts parts(ranks, mesh, {});
  const bool inSpace = parts.Common.CellSize == 4;
  std::vector<std::size_t> indices; // of the finite points that no cell contains
  std::vector<Point3> outside;      // their positions
  for (std::size_t i = 0; i < result.Cells.size(); ++i)
  {
    const Point3 p{ points[i].x, points[i].y, inSpace ? points[i].z : 0 };
    if (result.Cells[i] >= 0)
    {
      result.Points[i] = p;
      result.Distances[i] = 0;
    }
    else if (isFinite(p))
    {
      indices.push_back(i);
      outside.push_back(p);
    }
  }
  std::vector<NearCell> best(outside.size());
  const PieceSearch search(ranks, mesh, ranks ? parts.firstCell(*ranks, mesh) : 0);
  if (mesh.isStored())
  {
    inSpace ? findOutside<3>(mesh, outside, search, best)
            : findOutside<2>(mesh, outside, search, best);
  }
  else
  {
    // Each rank may have the nearest cell.
    std::vector<std::int32_t> pieces;
    std::vector<std::int64_t> asked;
    for (std::size_t rank = 0; rank < parts.All.size(); ++rank)
    {
      for (std::size_t i = 0; i < outside.size() && parts.All[rank].Cells > 0; ++i)
      {
        pieces.push_back(std::int32_t(rank));
        asked.push_back(std::int64_t(i));
      }
    }
    search(pieces, asked, outside.data(), best);
  }
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

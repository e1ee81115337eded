// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankAround.h"

#include "Files/IOError.h"
#include "Query/RankQuestions.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace tipp
{
namespace
{

/// Lists that are found by id.
class ListsById
{
public:
  /// `ids` are ascending.
  ListsById(const Ids& ids, IdLists lists)
    : Sorted(ids)
    , Lists(std::move(lists))
  {
  }
  Ids of(std::int64_t id) const
  {
    const auto found = std::lower_bound(this->Sorted.begin(), this->Sorted.end(), id);
    return listOf(this->Lists, std::size_t(found - this->Sorted.begin()));
  }

private:
  const Ids& Sorted;
  const IdLists Lists;
};

/// As ringsInMemory(), for rings that need the cells of several ranks. All grow together, step by
/// step.
IdLists ringsAcrossRanks(const RankQuestions& questions, const Ids& seeds, int k, bool ofPoints)
{
  struct Ring
  {
    Ids Points; ///< found so far, ascending
    Ids Cells;  ///< found so far, ascending
    Ids Front;
  };
  std::vector<Ring> rings(seeds.size());
  const IdLists corners = ofPoints ? IdLists() : questions.corners(seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    rings[i].Points = ofPoints ? Ids{ seeds[i] } : sortedUnique(listOf(corners, i));
    rings[i].Front = rings[i].Points;
  }
  const auto merged = [&rings](const auto& listOfRing)
  {
    Ids all;
    for (const Ring& ring : rings)
    {
      const Ids& list = listOfRing(ring);
      all.insert(all.end(), list.begin(), list.end());
    }
    return sortedUnique(std::move(all));
  };
  const auto hasFront = [](const Ring& ring) { return !ring.Front.empty(); };
  for (int step = 0; step < k && questions.any(std::any_of(rings.begin(), rings.end(), hasFront));
       ++step)
  {
    const Ids front = merged([](const Ring& ring) -> const Ids& { return ring.Front; });
    const ListsById stars(front, questions.stars(front));
    for (Ring& ring : rings)
    {
      Ids cells;
      for (const std::int64_t point : ring.Front)
      {
        const Ids star = stars.of(point);
        cells.insert(cells.end(), star.begin(), star.end());
      }
      // Until the end of this step, the front consists of cells.
      ring.Front = without(sortedUnique(std::move(cells)), ring.Cells);
      ring.Cells.insert(ring.Cells.end(), ring.Front.begin(), ring.Front.end());
      std::sort(ring.Cells.begin(), ring.Cells.end());
    }
    const Ids reached = merged([](const Ring& ring) -> const Ids& { return ring.Front; });
    const ListsById points(reached, questions.corners(reached));
    for (Ring& ring : rings)
    {
      Ids next;
      for (const std::int64_t cell : ring.Front)
      {
        const Ids list = points.of(cell);
        next.insert(next.end(), list.begin(), list.end());
      }
      ring.Front = without(sortedUnique(std::move(next)), ring.Points);
      ring.Points.insert(ring.Points.end(), ring.Front.begin(), ring.Front.end());
      std::sort(ring.Points.begin(), ring.Points.end());
    }
  }
  IdLists result;
  for (std::size_t i = 0; i < rings.size(); ++i)
  {
    append(result, without(ofPoints ? rings[i].Points : rings[i].Cells, { seeds[i] }));
  }
  return result;
}

/// For parts in memory: the ids that are reached in k steps from each seed, without the seed.
IdLists ringsInMemory(const RankQuestions& questions, const Ids& seeds, int k, bool ofPoints)
{
  IdLists within = questions.ringsWithinParts(seeds, k, ofPoints);
  const auto leaves = [&within](std::size_t i)
  {
    return within.Starts[i] < within.Starts[i + 1] &&
      within.Ids[std::size_t(within.Starts[i])] == -1;
  };
  Ids others;
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    leaves(i) ? others.push_back(seeds[i]) : void();
  }
  const IdLists across = ringsAcrossRanks(questions, others, k, ofPoints);
  if (others.empty())
  {
    return within;
  }
  IdLists result;
  result.Ids.reserve(within.Ids.size() + across.Ids.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < seeds.size(); ++i)
  {
    leaves(i) ? append(result, across, next++) : append(result, within, i);
  }
  return result;
}

/// As neighborsOf(), for parts in memory.
IdLists neighborsInMemory(const RankQuestions& questions, const Ids& cells)
{
  const IdLists corners = questions.corners(cells);
  const Ids points = sortedUnique(corners.Ids);
  const ListsById stars(points, questions.stars(points));
  IdLists result;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    const Ids own = listOf(corners, i);
    Ids lowest;
    for (std::size_t face = 0; face < own.size(); ++face)
    {
      Ids across;
      bool isFirst = true;
      for (std::size_t k = 0; k < own.size(); ++k)
      {
        if (k != face)
        {
          const Ids star = stars.of(own[k]);
          Ids common;
          std::set_intersection(
            across.begin(), across.end(), star.begin(), star.end(), std::back_inserter(common));
          across = std::exchange(isFirst, false) ? star : common;
        }
      }
      across = without(across, { cells[i] });
      lowest.push_back(across.empty() ? -1 : across.front());
    }
    append(result, lowest);
  }
  return result;
}

} // namespace

void requireIdsOnRanks(Communicator& ranks, const ResidentMesh& mesh)
{
  const bool hasCells = mesh.mesh().Cells > 0;
  bool hasIds = true;
  if (hasCells && !mesh.isStored())
  {
    const ResidentPieces::Lease piece = mesh.pieces().get(0, {});
    hasIds = piece->Part->CellIds && piece->Part->PointIds;
  }
  std::vector<std::int64_t> sums = { hasCells ? 1 : 0, hasIds ? 0 : 1 };
  ranks.sum(sums);
  if (sums[0] > 1 && sums[1] > 0)
  {
    throw IOError("A rank's part of the mesh has no global ids of points and cells, which this "
                  "query needs; make them, as by vtkGenerateGlobalIds.");
  }
}

std::vector<std::int64_t> neighborsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells)
{
  const RankQuestions questions(ranks, mesh);
  if (!questions.isStored())
  {
    return neighborsInMemory(questions, cells).Ids;
  }
  return questions
    .askOwners(cells, false,
      [&](const Ids& own, const std::vector<std::int32_t>& pieces)
      {
        const std::vector<std::int64_t> found = neighborsOf(mesh, own, pieces);
        const auto corners = std::size_t(mesh.mesh().CellSize);
        IdLists lists;
        for (std::size_t at = 0; at < found.size(); at += corners)
        {
          append(lists, { found.data() + at, found.data() + at + corners });
        }
        return lists;
      })
    .Ids;
}

IdLists starsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points)
{
  const RankQuestions questions(ranks, mesh);
  return questions.isStored()
    ? questions.askOwners(points, true,
        [&](const Ids& own, const auto& pieces) { return starsOf(mesh, own, pieces); })
    : questions.stars(points);
}

IdLists ringsOfPointsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points, int k)
{
  const RankQuestions questions(ranks, mesh);
  return questions.isStored()
    ? questions.askOwners(points, true,
        [&](const Ids& own, const auto& pieces) { return ringsOfPoints(mesh, own, k, pieces); })
    : ringsInMemory(questions, points, k, true);
}

IdLists ringsOfCellsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, int k)
{
  const RankQuestions questions(ranks, mesh);
  return questions.isStored()
    ? questions.askOwners(cells, false,
        [&](const Ids& own, const auto& pieces) { return ringsOfCells(mesh, own, k, pieces); })
    : ringsInMemory(questions, cells, k, false);
}

} // namespace tipp

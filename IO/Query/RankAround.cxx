// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankAround.h"

#include "Files/IOError.h"
#include "Query/ForPieces.h"
#include "Query/RankAnswer.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace tipp
{
namespace
{

using Ids = std::vector<std::int64_t>;

/// A list for each id that a rank is asked for.
struct ListReply
{
  std::vector<char> Known; ///< whether the rank has it
  IdLists Lists;
};

template <typename Archive>
void serialize(Archive& archive, ListReply& reply)
{
  archive(reply.Known, reply.Lists.Starts, reply.Lists.Ids);
}

Ids sortedUnique(Ids ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

Ids without(const Ids& ids, const Ids& others)
{
  Ids result;
  std::set_difference(
    ids.begin(), ids.end(), others.begin(), others.end(), std::back_inserter(result));
  return result;
}

Ids listOf(const IdLists& lists, std::size_t i)
{
  return { lists.Ids.begin() + lists.Starts[i], lists.Ids.begin() + lists.Starts[i + 1] };
}

void append(IdLists& lists, const Ids& list)
{
  lists.Ids.insert(lists.Ids.end(), list.begin(), list.end());
  lists.Starts.push_back(std::int64_t(lists.Ids.size()));
}

/// Asks all ranks for lists of ids.
class RankQuestions
{
public:
  RankQuestions(Communicator& ranks, const ResidentMesh& mesh)
    : Ranks(ranks)
    , Mesh(mesh)
  {
    requireIdsOnRanks(ranks, mesh);
  }

  /// For each id the list of the first rank that has it, which answer(ids) makes of any ids as a
  /// ListReply; or, if `united`, what the ranks' lists have together, ascending.
  template <typename Answer>
  IdLists ask(const Ids& ids, bool ofPoints, bool united, const Answer& answer) const
  {
    std::vector<ListReply> replies;
    for (const Ids& asked : this->Ranks.allGather(ids))
    {
      replies.push_back(asked.empty() ? ListReply() : answer(asked));
    }
    replies = this->Ranks.allToAll(replies);
    IdLists result;
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      Ids list;
      bool isKnown = false;
      for (const ListReply& reply : replies)
      {
        if (reply.Known[i] && (united || !isKnown))
        {
          const Ids part = listOf(reply.Lists, i);
          list.insert(list.end(), part.begin(), part.end());
          isKnown = true;
        }
      }
      isKnown ? void() : this->Mesh.refuseId(ids[i], ofPoints);
      append(result, united ? sortedUnique(std::move(list)) : list);
    }
    return result;
  }

  /// Of a stored mesh: lists that work(ids) makes on the rank that has their pieces.
  template <typename Work>
  IdLists askOwners(const Ids& ids, bool ofPoints, const Work& work) const
  {
    const std::int64_t count = ofPoints ? this->Mesh.mesh().Points : this->Mesh.mesh().Cells;
    for (const std::int64_t id : ids)
    {
      id < 0 || id >= count ? this->Mesh.refuseId(id, ofPoints) : void();
    }
    const auto [first, end] = piecesOfRank(this->Ranks, this->Mesh);
    return this->ask(ids, ofPoints, false,
      [&, firstPiece = first, endPiece = end](const Ids& asked)
      {
        const std::vector<std::int32_t> pieces =
          this->Mesh.findIds(asked, ofPoints, firstPiece, endPiece);
        Ids own;
        for (std::size_t i = 0; i < asked.size(); ++i)
        {
          pieces[i] >= 0 ? own.push_back(asked[i]) : void();
        }
        const IdLists lists = own.empty() ? IdLists() : work(own);
        ListReply reply;
        std::size_t next = 0;
        for (const std::int32_t piece : pieces)
        {
          reply.Known.push_back(char(piece >= 0));
          append(reply.Lists, piece >= 0 ? listOf(lists, next++) : Ids());
        }
        return reply;
      });
  }

  /// Of parts in memory: the cells at points, ascending.
  IdLists stars(const Ids& points) const
  {
    return this->ask(points, true, true,
      [this](const Ids& asked)
      {
        const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
        ListReply reply;
        for (const std::int64_t id : asked)
        {
          Ids list;
          const std::int64_t index = piece->Topology->findPoint(id);
          if (index >= 0)
          {
            for (const std::int32_t cell : piece->Topology->cellsAt(index))
            {
              list.push_back(piece->Part->cellId(cell));
            }
          }
          reply.Known.push_back(char(index >= 0));
          append(reply.Lists, list);
        }
        return reply;
      });
  }

  /// Of parts in memory: the points of cells, in the cells' order.
  IdLists corners(const Ids& cells) const
  {
    return this->ask(cells, false, false,
      [this](const Ids& asked)
      {
        const ResidentPieces::Lease piece = this->Mesh.pieces().get(0, topologyNeeded());
        ListReply reply;
        for (const std::int64_t id : asked)
        {
          Ids list;
          const std::int64_t index = piece->Topology->findCell(id);
          for (int i = 0; i < piece->Topology->corners() && index >= 0; ++i)
          {
            list.push_back(piece->Part->pointId(piece->Topology->corner(index, i)));
          }
          reply.Known.push_back(char(index >= 0));
          append(reply.Lists, list);
        }
        return reply;
      });
  }

  bool isStored() const { return this->Mesh.isStored(); }
  const ResidentMesh& mesh() const { return this->Mesh; }
  /// Whether it is so on any rank.
  bool any(bool isSo) const
  {
    std::vector<std::int64_t> count = { isSo ? 1 : 0 };
    this->Ranks.sum(count);
    return count[0] > 0;
  }

private:
  Communicator& Ranks;
  const ResidentMesh& Mesh;
};

/// Lists by id.
class ListsById
{
public:
  ListsById(const Ids& ids, IdLists lists)
    : Lists(std::move(lists))
  {
    for (std::size_t i = 0; i < ids.size(); ++i)
    {
      this->Places[ids[i]] = i;
    }
  }
  Ids of(std::int64_t id) const { return listOf(this->Lists, this->Places.at(id)); }

private:
  IdLists Lists;
  std::map<std::int64_t, std::size_t> Places;
};

/// What k steps reach from each seed in parts in memory, without the seed.
IdLists ringsInMemory(const RankQuestions& questions, const Ids& seeds, int k, bool ofPoints)
{
  struct Ring
  {
    Ids Points; ///< ascending
    Ids Cells;  ///< ascending
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
      ring.Front = without(sortedUnique(std::move(cells)), ring.Cells); // cells until the next loop
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

/// In parts in memory, as neighborsOf().
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
      [&](const Ids& own)
      {
        const std::vector<std::int64_t> found = neighborsOf(mesh, own);
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
    ? questions.askOwners(points, true, [&](const Ids& own) { return starsOf(mesh, own); })
    : questions.stars(points);
}

IdLists ringsOfPointsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& points, int k)
{
  const RankQuestions questions(ranks, mesh);
  return questions.isStored()
    ? questions.askOwners(points, true, [&](const Ids& own) { return ringsOfPoints(mesh, own, k); })
    : ringsInMemory(questions, points, k, true);
}

IdLists ringsOfCellsOnRanks(
  Communicator& ranks, const ResidentMesh& mesh, const std::vector<std::int64_t>& cells, int k)
{
  const RankQuestions questions(ranks, mesh);
  return questions.isStored()
    ? questions.askOwners(cells, false, [&](const Ids& own) { return ringsOfCells(mesh, own, k); })
    : ringsInMemory(questions, cells, k, false);
}

} // namespace tipp

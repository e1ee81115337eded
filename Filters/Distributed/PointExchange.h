// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPointExchange_h
#define tippPointExchange_h

#include "Distributed/CellExchange.h"
#include "Parallel/ParallelFor.h"
#include "Predicates/Geometry.h"
#include "Ranks/Communicator.h"
#include "Triangulation/PointBuckets.h"
#include "Triangulation/PointsView.h"
#include "Triangulation/PopulatePages.h"
#include "Triangulation/Tiling.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The arrays of points and their data, as sent in messages. Does not own the memory.
template <typename Position>
struct PointArrays
{
  Position* Positions;
  PointId* Ids;
  char* Rows;

  explicit PointArrays(PointTuplesOf<Position>& points)
    : Positions(points.Positions.data())
    , Ids(points.GlobalIds.data())
    , Rows(points.Rows.data())
  {
  }
  /// The arrays of `points` points that are stored one after the other in `memory`.
  PointArrays(char* memory, std::size_t points)
    : Positions(reinterpret_cast<Position*>(memory))
    , Ids(reinterpret_cast<PointId*>(this->Positions + points))
    , Rows(reinterpret_cast<char*>(this->Ids + points))
  {
  }

  void advance(std::size_t points, std::size_t rowSize)
  {
    this->Positions += points;
    this->Ids += points;
    this->Rows += points * rowSize;
  }

  /// The size of a message with `points` points, in bytes.
  static std::size_t bytes(std::size_t points, std::size_t rowSize)
  {
    return points * (sizeof(Position) + sizeof(PointId) + rowSize);
  }
};

/// The order of a rank's points: by leaf, and within each leaf by source rank.
struct PointLayout
{
  /// Sends the number of points in each leaf to the leaf's owner. Collective.
  PointLayout(Communicator& ranks, const std::vector<std::int32_t>& owners,
    const std::vector<std::int64_t>& counts)
    : Rank(ranks.rank())
    , Counts(exchangeCounts(ranks, owners, counts))
    , Firsts(this->Counts.size())
    , Starts(1, 0)
  {
    std::size_t own = 0;
    for (const std::int32_t owner : owners)
    {
      std::size_t end = this->Starts.back();
      if (owner == this->Rank)
      {
        for (std::size_t source = 0; source < this->Counts.size(); ++source)
        {
          this->Firsts[source].push_back(end);
          end += this->Counts[source][own];
        }
        ++own;
      }
      this->Starts.push_back(end);
    }
  }

  std::int32_t Rank;
  std::vector<std::vector<std::uint64_t>>
    Counts; ///< number of points, by source rank and leaf of this rank
  std::vector<std::vector<std::size_t>> Firsts; ///< index of the first of these points
  std::vector<std::size_t> Starts;              ///< index of each leaf's first point, and the end

private:
  /// Sends the counts to the leaves' owners; returns by rank the counts of this rank's leaves.
  /// Collective.
  static std::vector<std::vector<std::uint64_t>> exchangeCounts(Communicator& ranks,
    const std::vector<std::int32_t>& owners, const std::vector<std::int64_t>& counts)
  {
    std::vector<std::vector<std::uint64_t>> countsOf(static_cast<std::size_t>(ranks.size()));
    for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
    {
      countsOf[std::size_t(owners[leaf])].push_back(std::uint64_t(counts[leaf]));
    }
    const std::size_t leaves = countsOf[std::size_t(ranks.rank())].size();
    std::vector<std::vector<std::uint64_t>> received = ranks.allToAll(countsOf);
    for (const std::vector<std::uint64_t>& of : received)
    {
      if (of.size() != leaves)
      {
        throw std::runtime_error("Points from another rank are damaged: there are counts for " +
          std::to_string(of.size()) + " partitions instead of " + std::to_string(leaves) + ".");
      }
    }
    return received;
  }
};

/// Copies what is received from another rank, part by part, to its position.
class PointReceiver
{
public:
  template <typename Position>
  PointReceiver(const PointLayout& layout, std::size_t source, PointTuplesOf<Position>& destination,
    std::size_t rowSize)
  {
    this->add(layout, source, destination.Positions.data(), sizeof(Position));
    this->add(layout, source, destination.GlobalIds.data(), sizeof(PointId));
    this->add(layout, source, destination.Rows.data(), rowSize);
    std::reverse(this->ToFill.begin(), this->ToFill.end());
  }

  /// Copies the next part. Throws std::runtime_error if the rank sent more than it announced.
  void take(const char* part, std::size_t size)
  {
    while (size > 0)
    {
      if (this->ToFill.empty())
      {
        throw std::runtime_error(
          "Points from another rank are damaged: they are more than it announced.");
      }
      ByteRange& range = this->ToFill.back();
      const std::size_t taken = std::min(size, range.Size);
      std::memcpy(range.To, part, taken);
      part += taken;
      size -= taken;
      range = { range.To + taken, range.Size - taken };
      if (range.Size == 0)
      {
        this->ToFill.pop_back();
      }
    }
  }

  /// Throws std::runtime_error if the rank sent less than it announced.
  void requireComplete() const
  {
    if (!this->ToFill.empty())
    {
      throw std::runtime_error(
        "Points from another rank are damaged: they are fewer than it announced.");
    }
  }

private:
  void add(const PointLayout& layout, std::size_t source, void* array, std::size_t itemSize)
  {
    const std::vector<std::uint64_t>& counts = layout.Counts[source];
    for (std::size_t leaf = 0; leaf < counts.size(); ++leaf)
    {
      if (counts[leaf] > 0 && itemSize > 0)
      {
        this->ToFill.push_back({ static_cast<char*>(array) + layout.Firsts[source][leaf] * itemSize,
          counts[leaf] * itemSize });
      }
    }
  }

  /// A byte range of the destination that is not filled yet.
  struct ByteRange
  {
    char* To;
    std::size_t Size;
  };

  std::vector<ByteRange> ToFill; ///< in reverse order
};

/// Commits the pages of memory that will be used completely.
template <typename Item>
void populate(Buffer<Item>& memory, int threads)
{
  parallelFor(threads, threads,
    [&](std::int64_t part)
    {
      const auto [begin, end] = evenShare(memory.size(), int(part), threads);
      populatePages(memory.data() + begin, (end - begin) * sizeof(Item));
    });
}

/// Sends points to the ranks that own their leaves in one all-to-all exchange. `View` has the
/// points' coordinates: size(), and forEach() as in PointsView.
template <typename Position, typename View>
class PointSender
{
public:
  /// Calls label(begin, end, labels, counts) in each thread: sets the leaves of the points [begin,
  /// end), PartitionFinder::None for those that are not sent, and adds to the number of points in
  /// each leaf. `data` must outlive this object.
  template <typename Label>
  PointSender(const RankPointData& data, const View& points, std::size_t leaves, int threads,
    const Label& label)
    : Threads(threads)
    , Data(data)
    , Points(points)
    , Leaves(leaves)
    , Labels(points.size())
    , CountsOf(static_cast<std::size_t>(threads), std::vector<std::size_t>(leaves, 0))
  {
    populate(this->Labels, threads);
    this->forParts([&](std::size_t part, std::size_t begin, std::size_t end)
      { label(begin, end, this->Labels.data(), this->CountsOf[part]); });
  }

  /// The number of this rank's points in each leaf.
  std::vector<std::int64_t> counts() const
  {
    std::vector<std::int64_t> counts(this->Leaves, 0);
    for (const std::vector<std::size_t>& part : this->CountsOf)
    {
      std::transform(part.begin(), part.end(), counts.begin(), counts.begin(),
        [](std::size_t more, std::int64_t count) { return count + std::int64_t(more); });
    }
    return counts;
  }

  /// Returns memory for all points of a layout.
  PointTuplesOf<Position> makeRoom(const PointLayout& layout) const
  {
    PointTuplesOf<Position> room(layout.Starts.back(), this->Data.RowSize);
    populate(room.Positions, this->Threads);
    populate(room.GlobalIds, this->Threads);
    return room;
  }

  /// The layout of the outgoing messages.
  struct Packing
  {
    std::vector<std::size_t> Sizes;  ///< number of points to each rank
    std::vector<std::size_t> Begins; ///< index of each leaf's first point in its owner's message
    std::vector<Communicator::ByteRange> Messages;
    std::size_t Size = 0; ///< bytes of all messages
  };

  /// `owners` has the rank of each leaf.
  Packing plan(const std::vector<std::int32_t>& owners, const PointLayout& layout) const
  {
    const std::vector<std::int64_t> counts = this->counts();
    Packing packing;
    packing.Sizes.assign(layout.Counts.size(), 0);
    packing.Begins.resize(this->Leaves);
    const auto me = std::size_t(layout.Rank);
    for (std::size_t leaf = 0, own = 0; leaf < this->Leaves; ++leaf)
    {
      const auto owner = std::size_t(owners[leaf]);
      packing.Begins[leaf] = owner == me ? layout.Firsts[me][own++] : packing.Sizes[owner];
      packing.Sizes[owner] += std::size_t(counts[leaf]);
    }
    for (std::size_t to = 0; to < packing.Sizes.size(); ++to)
    {
      constexpr std::size_t alignment = alignof(std::max_align_t);
      const std::size_t size =
        to == me ? 0 : PointArrays<Position>::bytes(packing.Sizes[to], this->Data.RowSize);
      packing.Messages.push_back({ packing.Size, size });
      packing.Size += (size + alignment - 1) / alignment * alignment;
    }
    return packing;
  }

  /// Sends each point to its leaf's owner, and sets this rank's points. `messages`: memory for the
  /// outgoing messages, which is returned. Collective. Throws RankFailure.
  Bytes send(Communicator& ranks, const std::vector<std::int32_t>& owners,
    const PointLayout& layout, const Packing& packing, Bytes messages,
    PointTuplesOf<Position>& destination) const
  {
    std::vector<PointArrays<Position>> leaves;
    leaves.reserve(owners.size());
    for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
    {
      const auto owner = std::size_t(owners[leaf]);
      leaves.push_back(packing.Messages[owner].Size == 0
          ? PointArrays<Position>(destination)
          : PointArrays<Position>(
              messages.data() + packing.Messages[owner].Begin, packing.Sizes[owner]));
      leaves.back().advance(packing.Begins[leaf], this->Data.RowSize);
    }
    this->scatter(leaves);
    std::vector<PointReceiver> receivers;
    for (std::size_t source = 0; source < layout.Counts.size(); ++source)
    {
      receivers.emplace_back(layout, source, destination, this->Data.RowSize);
    }
    messages = ranks.allToAllInParts(std::move(messages), packing.Messages,
      [&receivers](int from, const char* part, std::size_t size)
      { receivers[std::size_t(from)].take(part, size); });
    for (std::size_t source = 0; source < receivers.size(); ++source)
    {
      if (source != std::size_t(ranks.rank()))
      {
        receivers[source].requireComplete();
      }
    }
    return messages;
  }

protected:
  const int Threads;

private:
  template <typename Work>
  void forParts(const Work& work) const
  {
    parallelFor(this->Threads, this->Threads,
      [&](std::int64_t part)
      {
        const auto [begin, end] = evenShare(this->Points.size(), int(part), this->Threads);
        work(std::size_t(part), begin, end);
      });
  }

  /// Copies the points to the arrays of their leaves.
  void scatter(const std::vector<PointArrays<Position>>& leaves) const
  {
    const std::size_t rowSize = this->Data.RowSize;
    this->forParts(
      [&](std::size_t part, std::size_t begin, std::size_t end)
      {
        std::vector<PointArrays<Position>> cursors = leaves;
        for (std::size_t leaf = 0; leaf < this->Leaves; ++leaf)
        {
          for (std::size_t before = 0; before < part; ++before)
          {
            cursors[leaf].advance(this->CountsOf[before][leaf], rowSize);
          }
        }
        this->Points.forEach(begin, end,
          [&](std::size_t i, const Position& p)
          {
            if (this->Labels[i] == PartitionFinder::None)
            {
              return;
            }
            PointArrays<Position>& cursor = cursors[this->Labels[i]];
            *cursor.Positions++ = p;
            *cursor.Ids++ = this->Data.globalId(i);
            if (rowSize > 0)
            {
              this->Data.PackRow(i, cursor.Rows);
              cursor.Rows += rowSize;
            }
          });
      });
  }

  const RankPointData& Data;
  const View Points;
  const std::size_t Leaves;
  Buffer<std::uint32_t> Labels;
  std::vector<std::vector<std::size_t>> CountsOf; ///< number of points, by thread and leaf
};

/// A rank's input points in D dimensions. Does not own the memory.
template <int D>
struct RankPointsOf : RankPointData
{
  PointsViewOf<D> Points; ///< coordinates of this rank's points
};

using RankPoints = RankPointsOf<2>;

/// The points of the leaves that a rank owns, ordered by leaf.
template <typename Id>
struct OwnedPoints : PointTuplesOf<Point2>
{
  PointBuckets<Id> Buckets;           ///< one bucket per leaf; empty for leaves of other owners
  std::vector<std::int64_t> FirstIds; ///< first internal id of each rank, and the end
};

/// Sends points in the plane to their owners.
class PointExchange : public PointSender<Point2, PointsView>
{
public:
  /// Finds each point's leaf. `points` must outlive this object.
  PointExchange(const RankPoints& points, const Tiling& leaves, int threads)
    : PointSender(points, points.Points, std::size_t(leaves.size()), threads,
        [&points, finder = PartitionFinder(leaves)](std::size_t begin, std::size_t end,
          std::uint32_t* labels, std::vector<std::size_t>& counts)
        { finder.label(points.Points, begin, end, labels, counts); })
  {
  }

  /// Sends each point to its leaf's owner and returns the points received. `owners` has the rank of
  /// each leaf. Collective.
  template <typename Id>
  OwnedPoints<Id> exchange(Communicator& ranks, const std::vector<std::int32_t>& owners) const
  {
    const PointLayout layout(ranks, owners, this->counts());
    for (std::size_t leaf = 0; leaf < owners.size(); ++leaf)
    {
      requireFitsKernel(layout.Starts[leaf + 1] - layout.Starts[leaf]);
    }
    OwnedPoints<Id> owned;
    static_cast<PointTuplesOf<Point2>&>(owned) = this->makeRoom(layout);
    // Triangles with other ranks' points are in addition to two per point. Untouched pages are not
    // committed.
    owned.Buckets = PointBuckets<Id>(layout.Starts, owned.Positions.data(), owned.size() / 8);
    parallelFor(this->Threads, this->Threads,
      [&](std::int64_t part) { owned.Buckets.populate(int(part), this->Threads); });
    const Packing packing = this->plan(owners, layout);
    // Messages are packed into the triangles' memory if they fit: fresh memory takes time.
    Bytes messages(owned.Buckets.release());
    const bool fits = packing.Size <= messages.size();
    if (!fits)
    {
      owned.Buckets.takeBack(Buffer<Id>(std::move(messages)));
      messages = Bytes(packing.Size);
    }
    messages = this->send(ranks, owners, layout, packing, std::move(messages), owned);
    if (fits)
    {
      owned.Buckets.takeBack(Buffer<Id>(std::move(messages)));
    }
    owned.FirstIds = firstIndices(ranks, std::int64_t(owned.size()));
    return owned;
  }
};

} // namespace tipp

#endif

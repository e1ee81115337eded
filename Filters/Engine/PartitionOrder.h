// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionOrder_h
#define tippPartitionOrder_h

#include "Triangulation/Tiling.h"
#include "vtkTIPPFiltersModule.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace tipp
{

/// An undirected graph: which partitions, or which pieces (sets of partitions), conflict.
class VTKTIPPFILTERS_EXPORT ConflictGraph
{
public:
  using Pair = std::pair<PartitionIndex, PartitionIndex>;

  /// A graph of `count` nodes without conflicts.
  explicit ConflictGraph(std::size_t count = 0)
    : Neighbours(count)
  {
  }

  /// A graph of known neighbours, each node's in ascending order.
  explicit ConflictGraph(std::vector<std::vector<PartitionIndex>> neighbours)
    : Neighbours(std::move(neighbours))
  {
    for (const auto& those : this->Neighbours)
    {
      this->Count += those.size();
    }
  }

  /// Adds conflicts; repetitions are allowed.
  void add(const std::vector<Pair>& pairs);

  std::size_t size() const { return this->Neighbours.size(); }
  /// The sum of all nodes' neighbour counts.
  std::size_t neighbourCount() const { return this->Count; }

  /// @name The neighbours of p: in ascending order, until the caller sorts them
  ///@{
  std::vector<PartitionIndex>& neighbours(PartitionIndex p)
  {
    return this->Neighbours[std::size_t(p)];
  }
  const std::vector<PartitionIndex>& neighbours(PartitionIndex p) const
  {
    return this->Neighbours[std::size_t(p)];
  }
  ///@}

  /// Returns each node's colour, counted from 0; conflicting nodes have different colours. Greedy,
  /// nodes with most conflicts first.
  std::vector<std::uint32_t> colours() const;

private:
  std::vector<std::vector<PartitionIndex>> Neighbours;
  std::size_t Count = 0;
};

struct MetPartitions;

/// Returns the conflicts of `partitions` partitions (Lemma 5, below). Returns nullopt if nearly all
/// conflict, as with co-circular points: the caller then treats all pairs as conflicting.
VTKTIPPFILTERS_EXPORT std::optional<ConflictGraph> findConflicts(
  const MetPartitions& initialMesh, std::size_t partitions);

/// The largest total number of neighbours for which findConflicts() returns a graph.
std::size_t mostConflicts(std::size_t partitions);

/// Which partitions conflict, and the order in which conflicting ones are triangulated. Both
/// depend only on the initial mesh, so every rank computes the same.
///
/// Lemma 5: P and Q conflict if one triangle of the initial mesh meets both, or of two triangles
/// with a common edge one meets P and the other Q. If they do not conflict, no disk that is empty
/// of the initial mesh's vertices meets both, now or later. (Proof. Grow the disk about its centre
/// until it touches a first vertex a. The centres of empty disks through a form a's Voronoi cell F;
/// those whose disk holds a point p of P form a half-plane H_p, and H_q likewise; F, H_p and H_q
/// have a point in common. If no vertex of F were in both half-planes, and no edge of F had an end
/// in each, then two vertices u, w of F in neither would lie between those in H_p and those in H_q,
/// and the line uw would separate H_p from H_q inside F: a contradiction. A vertex of F is a
/// triangle at a, an edge of F two triangles with a common edge. Where F is unbounded, no unbounded
/// direction helps inside the hull, which holds all regions.) So no later triangle and no later
/// edge joins them, and their workers commute. Additional conflicts are harmless.
///
/// Partitions are coloured; a colour is a stage of the dissertation. They are ordered by window, if
/// windows are given, then by colour and index. Windows may be chosen freely: the triangles do not
/// depend on the order.
class VTKTIPPFILTERS_EXPORT PartitionOrder
{
public:
  struct Range
  {
    const PartitionIndex* First;
    const PartitionIndex* Last;

    const PartitionIndex* begin() const { return this->First; }
    const PartitionIndex* end() const { return this->Last; }
    std::size_t size() const { return std::size_t(this->Last - this->First); }
  };

  /// Orders the partitions that are to be triangulated. `isUsed` has one entry for each partition:
  /// 0 if it has no points.
  PartitionOrder(const std::vector<char>& isUsed, const MetPartitions& initialMesh)
    : PartitionOrder(isUsed, findConflicts(initialMesh, isUsed.size()))
  {
  }

  /// As above, with the conflicts given; nullopt: every partition conflicts with every other.
  PartitionOrder(const std::vector<char>& isUsed, std::optional<ConflictGraph> conflicts);

  /// Orders the partitions by window first. `windows` has one entry for each partition.
  void setWindows(const std::vector<std::int32_t>& windows);

  /// The number of all partitions, used or not.
  std::size_t partitionCount() const { return this->Positions.size(); }

  /// All used partitions, in order.
  const std::vector<PartitionIndex>& sequence() const { return this->Sequence; }

  /// The same partitions by urgency: within a window, partitions that the longest chains of
  /// conflicting later partitions wait for come first, as in critical-path list scheduling.
  const std::vector<PartitionIndex>& byUrgency() const { return this->Urgency; }

  std::size_t position(PartitionIndex p) const { return this->Positions[std::size_t(p)]; }

  /// The conflicting partitions that come after p, in order.
  Range later(PartitionIndex p) const;

  /// The first partition, in the order, of the non-empty range [begin, end).
  PartitionIndex first(const PartitionIndex* begin, const PartitionIndex* end) const;

  std::size_t colourCount() const { return this->ColourSizes.size(); }
  /// The number of partitions of a colour, counted from 0; partitions of a colour do not conflict.
  std::size_t colourSize(std::size_t colour) const { return this->ColourSizes[colour]; }
  std::size_t colourOf(PartitionIndex p) const { return this->Colours[std::size_t(p)]; }

  /// The conflicts; empty if isTotal().
  const ConflictGraph& conflicts() const { return this->Conflicts; }

  /// True if every partition counts as conflicting with every other.
  bool isTotal() const { return this->Total; }

private:
  void colour();
  void sort(const std::vector<std::int32_t>& windows);
  void sortByUrgency(const std::vector<std::int32_t>& windows);

  std::vector<PartitionIndex> Sequence;
  std::vector<PartitionIndex> Urgency;
  std::vector<std::uint32_t> Positions;
  std::vector<std::uint32_t> Colours;
  std::vector<std::size_t> ColourSizes;
  ConflictGraph Conflicts;
  std::vector<std::size_t> EarlierCounts; ///< conflicting partitions before each
  bool Total = false;
};

} // namespace tipp

#endif

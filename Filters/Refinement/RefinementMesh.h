// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRefinementMesh_h
#define tippRefinementMesh_h

#include "Arrays/ReservedArray.h"
#include "Files/PagedMemory.h"
#include "Predicates/Geometry.h"
#include "Triangulation/PopulatePages.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <unordered_map>
#include <utility>
#include <vector>

namespace tipp
{

/// A segment of the input between two of its points. The edges that it is split into are its
/// subsegments.
struct InputSegment
{
  std::array<std::int32_t, 2> Ids; ///< of the points
  std::array<Point2, 2> Ends;
  /// Whether another segment leaves the end at an angle below 60 degrees.
  std::array<bool, 2> IsSharp{};
  std::int64_t Constraint = -1; ///< number of the constraint; -1: an edge of the convex hull
};

/// A constrained Delaunay triangulation that threads refine in different places at once. It has
/// only the triangles of the domain, whose border consists of subsegments: no infinite vertex, no
/// artificial points. Arrays never move, so that a thread can append while others read.
class RefinementMesh
{
public:
  using Index = std::int32_t;

  /// A link to the triangle across an edge: 8 t + i, where i is the index of the opposite corner
  /// there, plus IsSegment if the edge is a subsegment; Outside if there is no triangle.
  using Link = std::uint32_t;
  static constexpr Link IsSegment = 4;
  /// It has the bit IsSegment: a border is a subsegment. No corner has the index 3.
  static constexpr Link Outside = 0xffffffff;
  static Link linkTo(Index triangle, int corner) { return 8 * Link(triangle) + Link(corner); }
  static Index triangleOf(Link link) { return Index(link >> 3); }
  static int cornerOf(Link link) { return int(link & 3); }
  static bool isSegment(Link link) { return (link & IsSegment) != 0; }

  static int next(int corner) { return corner == 2 ? 0 : corner + 1; }
  static int previous(int corner) { return corner == 0 ? 2 : corner - 1; }

  enum State : std::uint32_t
  {
    IsLive = 1,
    IsInCavity = 2,
    IsGivenUp = 4,     ///< it stays as it is
    KeepsSegments = 8, ///< a subsegment that its vertex encroaches upon cannot be split
    RegionShift = 8    ///< the bits from here on are the number of its region
  };

  /// 32 bytes: half of a cache line.
  struct Triangle
  {
    std::array<Index, 3> Corner; ///< counter-clockwise
    std::uint32_t Version;       ///< changes whenever the slot gets another triangle
    std::array<Link, 3> Across;  ///< by the opposite corner
    std::uint32_t State;
  };

  ///@{
  /// The origin of a vertex. NoVertex: the place is not in use.
  static constexpr Index NoVertex = 0;
  static constexpr Index Free = 1; ///< added inside the domain
  static Index onSegment(Index segment) { return segment + 2; }
  static bool isOnSegment(Index origin) { return origin >= 2; }
  static Index segmentNumber(Index origin) { return origin - 2; }
  static Index ofInput(Index id) { return -1 - id; }
  static bool isInput(Index origin) { return origin < 0; }
  static Index inputId(Index origin) { return -1 - origin; }
  ///@}

  ///@{
  /// Places of triangles and of points are taken in groups of so many. So those that one thread
  /// adds lie together, and the order of the groups can be the same for any number of threads.
  static constexpr Index TrianglesInGroup = 64;
  static constexpr Index PointsInGroup = 32;
  ///@}

  static constexpr std::size_t MostTriangles = std::size_t(1) << 29; ///< links have 32 bits

  /// `memory`: where the arrays are, and outlives the mesh; null: the process's own.
  explicit RefinementMesh(PagedMemory* memory)
    : Triangles(arrayIn<Triangle>(memory))
    , Points(arrayIn<Point2>(memory))
    , Origins(arrayIn<Index>(memory))
  {
  }

  bool isLive(Index t, std::uint32_t version) const
  {
    const Triangle& triangle = this->Triangles[std::size_t(t)];
    return (triangle.State & IsLive) != 0 && triangle.Version == version;
  }

  std::array<Point2, 3> cornersOf(const Triangle& triangle) const
  {
    return { this->Points[std::size_t(triangle.Corner[0])],
      this->Points[std::size_t(triangle.Corner[1])],
      this->Points[std::size_t(triangle.Corner[2])] };
  }

  /// The input segment that the subsegment between two vertices is part of.
  Index segmentOf(Index a, Index b) const
  {
    const Index originA = this->Origins[std::size_t(a)];
    const Index originB = this->Origins[std::size_t(b)];
    if (isOnSegment(originA))
    {
      return segmentNumber(originA);
    }
    if (isOnSegment(originB))
    {
      return segmentNumber(originB);
    }
    return this->segmentBetween(inputId(originA), inputId(originB));
  }

  /// The number of the input segment between two input points.
  Index segmentBetween(Index idA, Index idB) const { return this->Whole.at(key(idA, idB)); }

  /// Adds an input segment.
  void add(const InputSegment& segment)
  {
    this->Whole.emplace(key(segment.Ids[0], segment.Ids[1]), Index(this->Segments.size()));
    this->Segments.push_back(segment);
  }
  bool has(Index idA, Index idB) const { return this->Whole.count(key(idA, idB)) > 0; }

  ReservedArray<Triangle> Triangles;
  ReservedArray<Point2> Points;
  ReservedArray<Index> Origins; ///< by vertex
  std::vector<InputSegment> Segments;
  std::atomic<std::int64_t> TriangleEnd{ 0 }; ///< one past the last group that is taken
  std::atomic<std::int64_t> PointEnd{ 0 };
  ///@{
  /// The first places of the groups, in an order that does not depend on the threads.
  std::vector<Index> TriangleGroups;
  std::vector<Index> PointGroups;
  ///@}

private:
  template <typename T>
  static ReservedArray<T> arrayIn(PagedMemory* memory)
  {
    return memory ? memory->reservedArray<T>(MostTriangles) : ReservedArray<T>(MostTriangles);
  }

  static std::uint64_t key(Index a, Index b)
  {
    const auto [low, high] = std::minmax(a, b);
    return std::uint64_t(std::uint32_t(low)) << 32 | std::uint32_t(high);
  }

  std::unordered_map<std::uint64_t, Index> Whole; ///< input segments by their ends
};

/// Takes places of an array for one thread, a group at a time.
class ArrayPlaces
{
public:
  /// `end`: one past the groups of `array` that all threads have taken.
  template <typename T>
  std::int32_t take(ReservedArray<T>& array, std::atomic<std::int64_t>& end, std::int32_t group)
  {
    if (this->Left == 0)
    {
      const std::int64_t first = end.fetch_add(group, std::memory_order_relaxed);
      if (std::size_t(first + group) > array.capacity())
      {
        throw std::length_error("The mesh would have too many triangles for the memory.");
      }
      array.grow(std::size_t(first + group));
      constexpr std::int64_t committed = 8192; // at once
      if (first % committed == 0)
      {
        const std::int64_t last = std::min(first + committed, std::int64_t(array.capacity()));
        array.grow(std::size_t(last));
        populatePages(array.data() + first, std::size_t(last - first) * sizeof(T));
      }
      this->Next = std::int32_t(first);
      this->Left = group;
      this->Groups.push_back(this->Next);
    }
    --this->Left;
    return this->Next++;
  }

  /// Returns the groups taken since the last call. The next place will be in a new one.
  std::vector<std::int32_t> finish()
  {
    this->Left = 0;
    return std::exchange(this->Groups, {});
  }

private:
  std::int32_t Next = 0;
  std::int32_t Left = 0;
  std::vector<std::int32_t> Groups;
};

} // namespace tipp

#endif

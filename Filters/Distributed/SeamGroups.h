// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeamGroups_h
#define tippSeamGroups_h

#include "Messages/Bytes.h"
#include "Triangulation/SeamTriangles.h"
#include "vtkTIPPFiltersModule.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

/// A vertex as it is sent: its label follows from its place.
struct PlainVertex
{
  Point2 Place;
  std::int64_t Id; ///< negative for an artificial one
};

/// Boundary triangles for a master, in groups whose circumdisks meet the same partitions. All of a
/// group are superseded together and become final together, so that a master handles some ten
/// groups a partition where it would handle some hundred triangles.
class VTKTIPPFILTERS_EXPORT SeamGroups
{
public:
  struct Group
  {
    std::uint32_t MetEnd; ///< ends in the arrays below
    std::uint32_t LabelEnd;
    std::uint32_t VertexEnd;
    std::uint32_t TriangleEnd;
    std::uint32_t HasArtificial;
  };
  using Corners = std::array<std::uint32_t, 3>; ///< places among the group's vertices

  std::vector<Group> Groups;
  std::vector<PartitionIndex> Met;   ///< of each group
  std::vector<std::uint32_t> Labels; ///< of each group's vertices, each once
  std::vector<PlainVertex> Vertices;
  std::vector<Corners> Triangles;

  std::size_t size() const { return this->Groups.size(); }

  template <typename T>
  struct Range
  {
    const T* First;
    const T* Last;
    const T* begin() const { return this->First; }
    const T* end() const { return this->Last; }
    std::size_t size() const { return std::size_t(this->Last - this->First); }
    const T& operator[](std::size_t i) const { return this->First[i]; }
  };
  Range<PartitionIndex> met(std::size_t g) const { return range(this->Met, g, &Group::MetEnd); }
  Range<std::uint32_t> labels(std::size_t g) const
  {
    return range(this->Labels, g, &Group::LabelEnd);
  }
  Range<PlainVertex> vertices(std::size_t g) const
  {
    return range(this->Vertices, g, &Group::VertexEnd);
  }
  Range<Corners> triangles(std::size_t g) const
  {
    return range(this->Triangles, g, &Group::TriangleEnd);
  }

  /// Adds some of other groups, but for their triangles, to none. Takes just the memory they need.
  void copyWithoutTriangles(const SeamGroups& others, const std::vector<std::uint32_t>& which);
  /// Adds one.
  void append(const SeamGroups& others, std::size_t g);

  void write(ByteWriter& writer) const;
  /// Throws std::runtime_error if the groups are not what write() wrote.
  static SeamGroups read(ByteReader& reader);

private:
  template <typename T>
  Range<T> range(const std::vector<T>& all, std::size_t g, std::uint32_t Group::*end) const
  {
    return { all.data() + (g == 0 ? 0 : this->Groups[g - 1].*end),
      all.data() + this->Groups[g].*end };
  }
  void check() const;
};

/// Groups triangles. Keeps its memory for the next time.
class VTKTIPPFILTERS_EXPORT SeamGrouping
{
public:
  /// A partition that is left out of what the triangles meet, or -1.
  SeamGroups group(const SeamTriangles& seams, PartitionIndex finished = -1);

private:
  void findGroups(const SeamTriangles& seams, PartitionIndex finished);
  void orderByGroup();
  void reserve(const SeamTriangles& seams, SeamGroups& groups);
  void addGroup(const SeamTriangles& seams, std::uint32_t g, SeamGroups& groups);

  /// The group that a vertex was last put into, and its place there.
  struct Slot
  {
    std::uint32_t Group = ~0U;
    std::uint32_t Place = 0;
  };
  PartitionSets Met;                  ///< of each group, without the finished partition
  std::vector<std::uint32_t> GroupOf; ///< of each triangle
  std::vector<std::uint32_t> Begins;  ///< of each group, in Order
  std::vector<std::uint32_t> Order;   ///< triangles by group
  std::vector<Slot> Slots;            ///< of each vertex
  std::vector<std::uint32_t> Labels;
};

} // namespace tipp

#endif

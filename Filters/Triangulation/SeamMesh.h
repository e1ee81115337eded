// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeamMesh_h
#define tippSeamMesh_h

#include "Triangulation/PartitionSets.h"
#include "Triangulation/Tiling.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace tipp
{

/// A vertex that knows enough to be sent to any worker.
struct SeamVertex
{
  Point2 Place;
  std::int64_t Id; ///< of the input point; negative for an artificial one
  /// Where it lies: four times its partition, plus its quadrant there. Two triangles that share a
  /// vertex share its label, which is what independence is decided on.
  std::uint32_t Label;

  PartitionIndex partition() const { return static_cast<PartitionIndex>(this->Label / 4); }
  bool isArtificial() const { return this->Id < 0; }
};

SeamVertex makeSeamVertex(
  const Tiling& tiling, PartitionIndex partition, Point2 p, std::int64_t id);

using SeamTriangle = std::array<SeamVertex, 3>;

/// Triangles, and for each the partitions its circumdisk meets. Small: where points lie on a circle
/// there are as many as points, and each meets all partitions.
struct SeamTriangles
{
  using Corners = std::array<std::uint32_t, 3>; ///< places among the vertices

  std::vector<SeamVertex> Vertices; ///< each once; some perhaps of no triangle
  std::vector<Corners> Triangles;
  std::vector<std::uint32_t> SetOf; ///< of each triangle: the partitions that it meets
  PartitionSets Sets;

  std::size_t size() const { return this->Triangles.size(); }
  SeamTriangle operator[](std::size_t i) const
  {
    const Corners& corners = this->Triangles[i];
    return { this->Vertices[corners[0]], this->Vertices[corners[1]], this->Vertices[corners[2]] };
  }

  void clear();
  /// A triangle of vertices that are there, or that will be.
  void add(const Tiling& tiling, const Corners& corners, const Circumdisk& disk);
  void add(const Corners& corners, const PartitionIndex* metBegin, const PartitionIndex* metEnd);
  /// Another one's triangles, of the same vertices.
  void appendTriangles(const SeamTriangles& others);

  const PartitionIndex* metBegin(std::size_t i) const { return this->Sets.begin(this->SetOf[i]); }
  const PartitionIndex* metEnd(std::size_t i) const { return this->Sets.end(this->SetOf[i]); }

private:
  std::vector<PartitionIndex> Found;
};

/// What independence is decided on.
class ReachSource
{
public:
  virtual ~ReachSource() = default;

  /// The labels of the vertices of the partition's triangles, each once; and perhaps of some that
  /// were superseded since triangles were last added to it.
  virtual const std::vector<std::uint32_t>& reach(PartitionIndex partition) = 0;

  virtual PartitionIndex partitions() const = 0;
  std::size_t labelEnd() const { return 4 * static_cast<std::size_t>(this->partitions()); }
};

/// The part of the global mesh that is not final: every triangle with a circumdisk that meets an
/// unfinished partition. The master's data; not thread-safe.
class SeamMesh : public ReachSource
{
public:
  explicit SeamMesh(PartitionIndex partitions);

  /// The triangles that belong to a partition.
  void gather(PartitionIndex partition, std::vector<SeamTriangle>& triangles) const;

  /// Takes triangles in, and hands back those that are final (Lemma 2).
  void add(const SeamTriangles& triangles, std::vector<SeamTriangle>& final);

  /// The partition's triangles are superseded by its worker's, which are to be added next.
  void finish(PartitionIndex partition);

  bool isFinished(PartitionIndex p) const { return this->Finished[std::size_t(p)]; }

  const std::vector<std::uint32_t>& reach(PartitionIndex partition) override;

  PartitionIndex partitions() const override
  {
    return static_cast<PartitionIndex>(this->Members.size());
  }

  /// Unfinished triangles in memory.
  std::size_t size() const { return this->Live; }

private:
  struct Entry
  {
    std::uint32_t Slot;
    std::array<std::uint32_t, 3> Labels;
  };
  struct Membership
  {
    std::vector<Entry> Entries; ///< some of which may be superseded
    std::vector<std::uint32_t> Reach;
    bool ReachIsCurrent = false;
  };

  std::uint32_t allocate(const SeamTriangle& triangle);
  void release(std::uint32_t slot);

  std::deque<SeamTriangle> Pool;
  std::vector<std::uint32_t> References; ///< how many partitions' entries name the slot
  std::vector<char> Alive;
  std::vector<std::uint32_t> FreeSlots;
  std::vector<Membership> Members;
  std::vector<char> Finished;
  std::vector<std::uint64_t> LabelSeen; ///< the epoch in which reach() last met each label
  std::uint64_t Epoch = 0;
  std::size_t Live = 0;
};

} // namespace tipp

#endif

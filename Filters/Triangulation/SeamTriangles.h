// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeamTriangles_h
#define tippSeamTriangles_h

#include "Triangulation/PartitionSets.h"
#include "Triangulation/Tiling.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace tipp
{

/// A vertex that knows enough to be sent to any worker.
struct SeamVertex
{
  Point2 Place;
  std::int64_t Id;          ///< of the input point; negative for an artificial one
  PartitionIndex Partition; ///< where it lies

  bool isArtificial() const { return this->Id < 0; }
};

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
  /// The sets of two triangles with a common edge, where they differ. Only triangulateVertices()
  /// fills it.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> AdjacentSets;

  std::size_t size() const { return this->Triangles.size(); }
  SeamTriangle operator[](std::size_t i) const
  {
    const Corners& corners = this->Triangles[i];
    return { this->Vertices[corners[0]], this->Vertices[corners[1]], this->Vertices[corners[2]] };
  }

  /// A triangle of vertices that are there, or that will be; Boxes: a Tiling, or Regions.
  template <typename Boxes>
  void add(const Boxes& boxes, const Corners& corners, const Circumdisk& disk)
  {
    this->Found.clear();
    boxes.visitMet(disk, [this](PartitionIndex partition) { this->Found.push_back(partition); });
    this->add(corners, this->Found.data(), this->Found.data() + this->Found.size());
  }
  void add(const Corners& corners, const PartitionIndex* metBegin, const PartitionIndex* metEnd);
  /// Another one's triangles, of the same vertices.
  void appendTriangles(const SeamTriangles& others);

  const PartitionIndex* metBegin(std::size_t i) const { return this->Sets.begin(this->SetOf[i]); }
  const PartitionIndex* metEnd(std::size_t i) const { return this->Sets.end(this->SetOf[i]); }

private:
  std::vector<PartitionIndex> Found;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNodeStrips_h
#define tippNodeStrips_h

#include "Arrays/Buffer.h"
#include "Files/PagedMemory.h"
#include "Meshes/MeshOptions.h"
#include "Resident/MeshPart.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

/// Divides the nodes of a mesh into horizontal strips with about equally many nodes, so that a mesh
/// larger than memory can be searched strip by strip. A strip has all triangles at its nodes.
class NodeStrips
{
public:
  /// `count`: about the number of strips. `memory`: for an array with four bytes a triangle. Nodes
  /// and triangles must outlive this.
  NodeStrips(
    const NodesView& nodes, TrianglesView triangles, std::size_t count, PagedMemory* memory);

  std::size_t size() const { return this->Ranges.size(); }
  /// The lowest and the highest y of the strip's triangles.
  std::array<double, 2> range(std::size_t strip) const { return this->Ranges[strip]; }
  /// The strip as a mesh. MeshPart::owns() says which nodes are the strip's own.
  MeshPart part(std::size_t strip) const;

private:
  std::size_t stripOf(double y) const;
  template <typename Visit>
  void forStripsOf(std::size_t triangle, const Visit& visit) const;
  void chooseCuts(std::size_t count);
  void groupTriangles(PagedMemory* memory);

  const NodesView& Nodes;
  const TrianglesView Triangles;
  std::vector<double> Cuts; ///< between strips, ascending
  std::vector<std::array<double, 2>> Ranges;
  std::vector<std::size_t> Begins; ///< by strip, and one more: index in Grouped
  Buffer<std::int32_t> Grouped;    ///< triangles by strip, ascending; empty if there is one strip
};

/// Returns the number of strips so that one takes up at most a part of a limit on memory; 1 without
/// a limit.
std::size_t stripsFor(std::size_t triangles, const PagedMemory* memory);

} // namespace tipp

#endif

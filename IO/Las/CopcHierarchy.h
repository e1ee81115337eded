// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCopcHierarchy_h
#define tippCopcHierarchy_h

#include "Las/LasHeader.h"
#include "Laz/LazFormat.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// The octree of a COPC file (specification 1.0 at copc.io): the points of each node are a chunk of
/// the LAZ file that it also is. Coarse levels have few points of the whole area.
struct CopcInfo
{
  Point3 Centre{};
  double HalfSize = 0; ///< of the cube of level 0
  double Spacing = 0;  ///< distance of points at level 0; half of that at each further level
  std::uint64_t RootOffset = 0; ///< of the first page of the hierarchy, in bytes
  std::uint64_t RootBytes = 0;

  Box3 bounds() const;
  /// The first level whose points, with those above, are at most `spacing` apart; 0: the last one
  /// possible.
  int levelFor(double spacing) const;
};

/// The highest number of a level that a hierarchy may have here.
constexpr int LastCopcLevel = 30;

/// A node with points.
struct CopcNode
{
  int Level = 0;
  std::array<std::int32_t, 3> Position{}; ///< in cubes of its level, along x, y and z
  std::size_t Chunk = 0;                  ///< index of its chunk
  std::uint64_t Points = 0;

  Box3 bounds(const CopcInfo& info) const;
};

/// Which nodes are asked for.
struct CopcRequest
{
  std::optional<Box2> Region; ///< nodes that meet this box; nullopt: all
  double Spacing = 0;         ///< see CopcInfo::levelFor()
};

/// Understands the record of a file with LasHeader::Copc. Throws IOError if it is damaged.
VTKTIPPIO_EXPORT CopcInfo readCopcInfo(const std::string& path, const LasHeader& header);

/// Finds the nodes with points, ascending by chunk. `chunks` are all chunks of the file. Of the
/// hierarchy, only the pages are read that can have such nodes. It is believed for where points
/// are; nodes that are no chunks of the file, or that are there twice, are an error. Throws
/// IOError, which names the node or the page.
VTKTIPPIO_EXPORT std::vector<CopcNode> findCopcNodes(const std::string& path,
  const LasHeader& header, const std::vector<LazChunkPlace>& chunks, const CopcRequest& request);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRouting_h
#define tippRouting_h

#include "Engine/Inbox.h"
#include "Engine/PartitionOrder.h"
#include "Engine/Regions.h"
#include "Triangulation/TriangleSink.h"
#include "Triangulation/Worker.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{

/// Takes a message for a partition.
using DeliverMessage = std::function<void(PartitionIndex, VertexMessage&&)>;

/// Takes triangles on the boundaries of partitions that have become final.
class FinalTaker
{
public:
  virtual ~FinalTaker() = default;
  virtual void add(const SeamTriangle& triangle) = 0;
};

/// What final triangles on the boundaries of partitions come to: the triangles of true points, and
/// the true corners of those at artificial points, which the hull repair takes.
template <typename Id>
struct FinalBoundary : public FinalTaker
{
  std::vector<typename TriangleSink<Id>::Seam> Triangles;
  std::vector<SeamVertex> HullVertices; ///< some more than once

  void add(const SeamTriangle& triangle) override;
  void append(FinalBoundary&& other);
};

/// If the triangle is at artificial points, adds its true corners to `vertices`, which the hull
/// repair takes, and returns true.
bool takeHullVertices(const SeamTriangle& triangle, std::vector<SeamVertex>& vertices);

/// Leaves each vertex once, by id.
void keepUnique(std::vector<SeamVertex>& vertices);

/// Adds the triangles that take the place of those at artificial points (Lemma 3, HullRepair.h);
/// `vertices` are the true corners of these.
VTKTIPPFILTERS_EXPORT void repairHull(
  std::vector<SeamVertex> vertices, const std::vector<SeamVertex>& artificial, FinalTaker& final);

/// Sends the boundary triangles of one partition after another on their way.
///
/// Lemma 6: the partitions that a triangle meets conflict pairwise, so the order is total on them.
/// The triangle goes to the next of them alone, and is final if there is none. (Proof. Two
/// partitions that one triangle of any later mesh meets conflict by Lemma 5. At any time the inbox
/// of q holds each triangle of the mesh before q that meets q exactly once, sent by the last
/// earlier partition that it meets, or by the initial mesh: it exists there, for its vertices are
/// initial or lie in partitions that it meets, and partitions in between do not meet it, so it
/// survives them. When q is done, what is still true of it has come out of q's worker again.)
template <typename Id>
class Routing : public BoundaryTaker
{
public:
  Routing(const PartitionOrder& order, const Regions& regions);

  /// The triangles that come next are those of this partition's worker.
  void setPartition(PartitionIndex p);

  void begin(DelaunayKernel::Index vertexEnd) override;
  void add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk) override;

  /// Hands the message for each later partition that gets one to `deliver`, and adds the triangles
  /// that nobody gets to the final ones. Returns how many triangles were delivered.
  std::int64_t send(const Worker<Id>& worker, const DeliverMessage& deliver, FinalTaker& final);

private:
  struct Triangle
  {
    std::uint32_t Recipient; ///< its position in Later; its size: none
    std::array<DelaunayKernel::Index, 3> Corners;
  };

  void sortByRecipient();
  VertexMessage messageTo(std::uint32_t recipient, const Worker<Id>& worker);

  const PartitionOrder& Order;
  const Regions& Boxes;
  PartitionIndex Sender = 0;
  PartitionOrder::Range Later{ nullptr, nullptr };
  std::vector<Triangle> Triangles;
  std::vector<std::array<DelaunayKernel::Index, 3>> Sorted; ///< by recipient
  std::vector<std::size_t> Ends;     ///< in Sorted, of each recipient and of the final triangles
  std::vector<std::uint32_t> SentTo; ///< of each vertex, the recipient it was last sent to
};

/// The same for the triangles of the initial mesh: each goes to the first partition that it meets.
std::int64_t sendInitialMesh(const SeamTriangles& mesh, const PartitionOrder& order,
  const DeliverMessage& deliver, FinalTaker& final);

} // namespace tipp

#endif

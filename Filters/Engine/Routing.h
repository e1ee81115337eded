// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRouting_h
#define tippRouting_h

#include "Engine/Inbox.h"
#include "Engine/PartitionOrder.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"
#include "Triangulation/TriangleSink.h"
#include "Triangulation/Worker.h"

#include <array>
#include <cstdint>
#include <vector>

namespace tipp
{

using VertexMessage = VertexMessageOf<BoundaryVertex>;
using SentMessages = SentMessagesOf<BoundaryVertex>;
using Inbox = MessageInbox<VertexMessage>;

/// Collects the vertices of several messages, each once.
class UniqueVertices
{
public:
  std::vector<BoundaryVertex> collect(const std::vector<VertexMessage>& messages);

private:
  std::vector<std::uint32_t> HashTable; ///< vertex indices; a member to reuse its memory
};

/// Receives boundary triangles that have become final.
class FinalTriangleConsumer
{
public:
  virtual ~FinalTriangleConsumer() = default;
  virtual void add(const BoundaryTriangle& triangle) = 0;
};

/// Collects final boundary triangles: triangles without artificial corners as they are, and of the
/// others the true corners, which the hull repair needs.
template <typename Id>
struct FinalBoundary : public FinalTriangleConsumer
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> Triangles;
  std::vector<BoundaryVertex> HullVertices; ///< may contain repetitions

  void add(const BoundaryTriangle& triangle) override;
  void append(FinalBoundary&& other);
};

/// Removes the artificial points (Lemma 3): triangulates `vertices`, the true corners of triangles
/// with artificial corners (repetitions allowed), and adds those triangles to `final` that are in
/// conflict with an artificial point. They fill the space of the triangles with artificial corners.
VTKTIPPFILTERS_EXPORT void repairHull(std::vector<BoundaryVertex> vertices,
  const std::vector<BoundaryVertex>& artificial, FinalTriangleConsumer& final);

/// Routes the boundary triangles of a partition, one partition after another.
///
/// Lemma 6: the partitions that a triangle meets conflict pairwise, so the order is total on them.
/// The triangle is sent to the next of them only, and is final if there is none. (Proof. Two
/// partitions that one triangle of any later mesh meets conflict by Lemma 5. At any time the inbox
/// of q holds each triangle of the mesh before q that meets q exactly once, sent by the last
/// earlier partition that it meets, or by the initial mesh. It exists there, because its vertices
/// are initial or lie in partitions that it meets. Partitions in between do not meet it, so it
/// survives them. When q is done, its triangles that still exist are among the output of q's
/// worker.)
template <typename Id>
class Routing : public BoundaryConsumer
{
public:
  using Corners = std::array<DelaunayKernel::Index, 3>;

  Routing(const PartitionOrder& order, const Regions& regions);

  /// Sets the partition whose worker passes the next triangles.
  void setPartition(PartitionIndex p);

  void begin(DelaunayKernel::Index vertexEnd) override;
  void add(const Corners& corners, const Circumdisk& disk) override;

  /// Returns the messages to later partitions, and passes the triangles that meet none to `final`.
  SentMessages send(const Worker<Id>& worker, FinalTriangleConsumer& final) const;

private:
  const PartitionOrder& Order;
  const Regions& Boxes;
  PartitionIndex Sender = 0;
  PartitionOrder::Range Later{ nullptr, nullptr };
  std::size_t VertexEnd = 0;
  std::vector<std::vector<Corners>> Outgoing; ///< triangles by their recipient's index in Later
  std::vector<Corners> Final;                 ///< triangles without recipient
};

} // namespace tipp

#endif

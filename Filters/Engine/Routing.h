// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRouting_h
#define tippRouting_h

#include "Engine/Inbox.h"
#include "Engine/PartitionOrder.h"
#include "Ranks/Archive.h"
#include "Triangulation/BoundaryTriangles.h"
#include "Triangulation/Tiling.h"
#include "Triangulation/TriangleSink.h"
#include "Triangulation/Worker.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace tipp
{

/// A message with the vertices of boundary triangles.
struct VertexMessage : VertexMessageOf<BoundaryVertex>
{
  std::int64_t Triangles = 0; ///< the number of triangles that these are the vertices of
};

template <typename Archive>
void serialize(Archive& archive, VertexMessage& message)
{
  archive(message.Sender, message.Triangles, message.Vertices);
}

/// All messages of a finished partition, each with its recipient.
using SentMessages = std::vector<std::pair<PartitionIndex, VertexMessage>>;

/// Collects the vertices of several messages, each once.
class UniqueVertices
{
public:
  std::vector<BoundaryVertex> collect(const std::vector<VertexMessage>& messages);

private:
  std::vector<std::uint32_t> HashTable; ///< vertex indices; a member to reuse its memory
};

using Inbox = MessageInbox<VertexMessage>;

/// Delivers a message to a partition's inbox.
using DeliverMessage = std::function<void(PartitionIndex, VertexMessage&&)>;

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

/// Triangles to be sent, each to one recipient, by their vertices' indices.
class OutgoingTriangles
{
public:
  using Corners = std::array<DelaunayKernel::Index, 3>;

  /// Removes all triangles. Those added next have vertex indices below `vertexEnd`.
  void clear(std::size_t vertexEnd);

  void add(std::size_t recipient, const Corners& corners)
  {
    this->Triangles.push_back({ static_cast<std::uint32_t>(recipient), corners });
  }

  /// Calls deliver(recipient, message) for each recipient that gets triangles, in ascending order.
  /// Triangles whose recipient is `recipients` have no recipient and are passed to `final`.
  /// vertexOf(index) returns a vertex. Returns the number of triangles delivered.
  template <typename VertexOf, typename Deliver>
  std::int64_t send(PartitionIndex sender, std::size_t recipients, const VertexOf& vertexOf,
    const Deliver& deliver, FinalTriangleConsumer& final);

private:
  struct Triangle
  {
    std::uint32_t Recipient;
    Corners Vertices;
  };

  std::vector<Triangle> Triangles;
  std::vector<std::size_t> Ends;     ///< by recipient: end of its triangles in Sorted
  std::vector<Corners> Sorted;       ///< triangles, sorted by recipient
  std::vector<std::uint32_t> SentTo; ///< by vertex: the last recipient it was sent to
};

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
  Routing(const PartitionOrder& order, const Regions& regions);

  /// Sets the partition whose worker passes the next triangles.
  void setPartition(PartitionIndex p);

  void begin(DelaunayKernel::Index vertexEnd) override;
  void add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk) override;

  /// Passes the message for each later partition that gets one to `deliver`, and the triangles
  /// without recipient to `final`. Returns the number of triangles delivered.
  std::int64_t send(
    const Worker<Id>& worker, const DeliverMessage& deliver, FinalTriangleConsumer& final);

private:
  const PartitionOrder& Order;
  const Regions& Boxes;
  PartitionIndex Sender = 0;
  PartitionOrder::Range Later{ nullptr, nullptr };
  OutgoingTriangles Triangles; ///< recipients are indices in Later; its size: none
};

/// Sends each triangle of the initial mesh to the first partition that it meets, or to `final` if
/// there is none. Returns the number of triangles delivered.
std::int64_t sendInitialMesh(const BoundaryTriangles& mesh, const PartitionOrder& order,
  const DeliverMessage& deliver, FinalTriangleConsumer& final);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataflow3_h
#define tippDataflow3_h

#include "Engine/Inbox.h"
#include "Engine/PartitionOrder.h"
#include "Kernel3D/DelaunayKernel3.h"
#include "Predicates/Circumball.h"
#include "Triangulation/Triangulate.h"
#include "Triangulation3D/InitialMesh3.h"
#include "Triangulation3D/OrderCells.h"
#include "Triangulation3D/Tiling3.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace tipp
{

/// What a partition sends to a later one: the vertices of the tetrahedra that it passes on (Lemma
/// 6, see Routing.h), each once.
struct VertexMessage3
{
  PartitionIndex Sender = -1; ///< -1: the initial mesh
  std::vector<Vertex3> Vertices;
};

using Inbox3 = MessageInbox<VertexMessage3>;

/// Tetrahedra that no later partition can change.
struct FinalCells
{
  std::vector<CellIds> Cells;
  /// True corners of tetrahedra that have artificial corners; with repetitions.
  std::vector<Vertex3> HullVertices;

  void add(const Vertex3& a, const Vertex3& b, const Vertex3& c, const Vertex3& d);
};

/// Triangulates partitions, one at a time, on one thread.
class Worker3
{
public:
  Worker3(const PointBuckets3& buckets, const PartitionOrder& order, std::vector<Inbox3>& inboxes)
    : Buckets(buckets)
    , Order(order)
    , Inboxes(inboxes)
  {
  }

  /// Triangulates a partition's points and the vertices in its inbox. Of the tetrahedra that meet
  /// the partition, those that meet no later one are final; of the others the next one's inbox gets
  /// the vertices.
  void triangulate(PartitionIndex p, FinalCells& final);

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  std::size_t vertexCount() const { return this->VertexCount; } ///< of all partitions together

private:
  void collect(PartitionIndex p);
  void route(PartitionIndex p, DelaunayKernel3::Index cell, FinalCells& final);
  void send(PartitionIndex p);
  Vertex3 vertex(PartitionIndex p, DelaunayKernel3::Index v) const;

  const PointBuckets3& Buckets;
  const PartitionOrder& Order;
  std::vector<Inbox3>& Inboxes;
  DelaunayKernel3 Kernel;
  std::vector<Point3> Points;  ///< the partition's own, then those of Others
  std::vector<Vertex3> Others; ///< from the inbox
  std::vector<std::vector<DelaunayKernel3::Index>> Outgoing; ///< corners, by later partition
  std::vector<std::int32_t> Ids;                             ///< by vertex: the point's id
  std::vector<std::uint32_t> SentTo; ///< by vertex: the last recipient, counted from 1
  std::vector<Duplicate> Duplicates;
  std::size_t VertexCount = 0;
};

/// Sends the initial mesh's tetrahedra to the first partition that each meets; those that meet none
/// are final.
void sendInitialMesh(const InitialMesh3& mesh, const PartitionOrder& order,
  std::vector<Inbox3>& inboxes, FinalCells& final);

/// Removes the artificial points (Lemma 3): tetrahedralizes HullVertices, and adds those tetrahedra
/// that are in conflict with an artificial point. They fill the space of the tetrahedra with
/// artificial corners.
void repairHull(const std::vector<Vertex3>& artificial, FinalCells& final);

} // namespace tipp

#endif

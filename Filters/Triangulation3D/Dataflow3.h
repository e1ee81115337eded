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

template <typename Archive>
void serialize(Archive& archive, VertexMessage3& message)
{
  archive(message.Sender, message.Vertices);
}

using Inbox3 = MessageInbox<VertexMessage3>;

/// All messages of a finished partition, each with its recipient.
using SentMessages3 = std::vector<std::pair<PartitionIndex, VertexMessage3>>;

/// Receives tetrahedra that no later partition can change.
class FinalCellConsumer3
{
public:
  virtual ~FinalCellConsumer3() = default;

  /// One of the partition's own points, whose ball lies in the interior of its region.
  virtual void addInside(const std::array<std::int64_t, 4>& ids) = 0;
  /// Any other one; it may have artificial corners.
  virtual void add(const std::array<Vertex3, 4>& corners) = 0;
};

/// If the tetrahedron has an artificial corner, adds its true corners to `vertices`, which the hull
/// repair needs, and returns true.
bool takeHullVertices(const std::array<Vertex3, 4>& corners, std::vector<Vertex3>& vertices);

/// Keeps them in memory, by point ids.
struct FinalCells : public FinalCellConsumer3
{
  std::vector<CellIds> Cells;
  /// True corners of tetrahedra that have artificial corners; with repetitions.
  std::vector<Vertex3> HullVertices;

  void addInside(const std::array<std::int64_t, 4>& ids) override;
  void add(const std::array<Vertex3, 4>& corners) override;
};

/// Triangulates partitions, one at a time, on one thread.
class Worker3
{
public:
  /// `regions`: of all partitions. Both must outlive this.
  Worker3(const std::vector<Box3>& regions, const PartitionOrder& order)
    : Regions(regions)
    , Order(order)
  {
  }

  /// Triangulates a partition's points and the vertices in its inbox. Of the tetrahedra that meet
  /// the partition, those that meet no later one are final; of the others the vertices are to be
  /// sent to the next one.
  SentMessages3 triangulate(const PartitionPoints3& points,
    const std::vector<VertexMessage3>& inbox, FinalCellConsumer3& final);

  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  std::size_t vertexCount() const { return this->VertexCount; } ///< of all partitions together

private:
  void collect(const std::vector<VertexMessage3>& inbox);
  void route(DelaunayKernel3::Index cell, FinalCellConsumer3& final);
  SentMessages3 send();
  void takeDuplicates();
  Vertex3 vertex(DelaunayKernel3::Index v) const;

  const std::vector<Box3>& Regions;
  const PartitionOrder& Order;
  PartitionPoints3 Own;
  DelaunayKernel3 Kernel;
  std::vector<Point3> Points;  ///< the partition's own, then those of Others
  std::vector<Vertex3> Others; ///< from the inbox
  std::vector<std::vector<DelaunayKernel3::Index>> Outgoing; ///< corners, by later partition
  std::vector<std::int64_t> Ids;                             ///< by vertex: the point's id
  std::vector<double> Slack;         ///< by vertex: the distance from the region's sides
  std::vector<std::uint32_t> SentTo; ///< by vertex: the last recipient, counted from 1
  std::vector<Duplicate> Duplicates;
  std::size_t VertexCount = 0;
};

/// Sends the initial mesh's tetrahedra to the first partition that each meets: returns a message
/// for each partition. One that meets none has no true corner.
std::vector<VertexMessage3> sendInitialMesh(const InitialMesh3& mesh, const PartitionOrder& order);

/// Sorts vertices by id, and removes repetitions.
void keepUnique(std::vector<Vertex3>& vertices);

/// Removes the artificial points (Lemma 3): tetrahedralizes `vertices`, the true corners of
/// tetrahedra with artificial ones, and adds to `final` those tetrahedra that are in conflict with
/// an artificial point. They fill the space of the tetrahedra with artificial corners. The vertices
/// may be repeated.
void repairHull(
  std::vector<Vertex3> vertices, const std::vector<Vertex3>& artificial, FinalCellConsumer3& final);

} // namespace tipp

#endif

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

/// Delivers a message to a partition's inbox.
using DeliverMessage = std::function<void(PartitionIndex, VertexMessage&&)>;

/// Receives boundary triangles that have become final.
class FinalTaker
{
public:
  virtual ~FinalTaker() = default;
  virtual void add(const BoundaryTriangle& triangle) = 0;
};

/// Collects final boundary triangles: triangles without artificial corners as they are, and of the
/// others the true corners, which the hull repair needs.
template <typename Id>
struct FinalBoundary : public FinalTaker
{
  std::vector<typename TriangleSink<Id>::FinalTriangle> Triangles;
  std::vector<BoundaryVertex> HullVertices; ///< may contain repetitions

  void add(const BoundaryTriangle& triangle) override;
  void append(FinalBoundary&& other);
};

/// If the triangle has an artificial corner, adds its true corners to `vertices`, which the hull
/// repair needs, and returns true.
bool takeHullVertices(const BoundaryTriangle& triangle, std::vector<BoundaryVertex>& vertices);

/// Sorts the vertices by id and removes repetitions.
void keepUnique(std::vector<BoundaryVertex>& vertices);

/// Adds to `final` the triangles that replace those with artificial corners (Lemma 3,
/// HullRepair.h). `vertices` are the true corners of these, with repetitions allowed.
VTKTIPPFILTERS_EXPORT void repairHull(std::vector<BoundaryVertex> vertices,
  const std::vector<BoundaryVertex>& artificial, FinalTaker& final);

/// Routes the boundary triangles of a partition, one partition after another.
///
/// Lemma 6: the partitions that a triangle meets conflict pairwise, so the order is total on them.
/// The triangle is sent to the next of them only, and is final if there is none. (Proof. Two
/// partitions that one triangle of any later mesh meets conflict by Lemma 5. At any time the inbox
/// of q holds each triangle of the mesh before q that meets q exactly once, sent by the last
/// earlier partition that it meets, or by the initial mesh: it exists there, because its vertices
/// are initial or lie in partitions that it meets, and partitions in between do not meet it, so it
/// survives them. When q is done, its triangles that still exist are among the output of q's
/// worker.)
template <typename Id>
class Routing : public BoundaryTaker
{
public:
  Routing(const PartitionOrder& order, const Regions& regions);

  /// Sets the partition whose worker passes the next triangles.
  void setPartition(PartitionIndex p);

  void begin(DelaunayKernel::Index vertexEnd) override;
  void add(const std::array<DelaunayKernel::Index, 3>& corners, const Circumdisk& disk) override;

  /// Passes the message for each later partition that gets one to `deliver`, and the triangles
  /// without recipient to `final`. Returns the number of triangles delivered.
  std::int64_t send(const Worker<Id>& worker, const DeliverMessage& deliver, FinalTaker& final);

private:
  struct Triangle
  {
    std::uint32_t Recipient; ///< index in Later; Later's size: none
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
  std::vector<std::size_t> Ends;     ///< per recipient, then of the final ones, in Sorted
  std::vector<std::uint32_t> SentTo; ///< by vertex: the last recipient it was sent to
};

/// Sends each triangle of the initial mesh to the first partition that it meets, or to `final` if
/// there is none. Returns the number of triangles delivered.
std::int64_t sendInitialMesh(const BoundaryTriangles& mesh, const PartitionOrder& order,
  const DeliverMessage& deliver, FinalTaker& final);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataflow3_h
#define tippDataflow3_h

#include "Engine/Inbox.h"
#include "Engine/PartitionSchedule.h"
#include "Kernel/DelaunayKernel3.h"
#include "Triangulation/Hull.h"
#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Partitions3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tipp
{

using VertexMessage3 = VertexMessageOf<Vertex3>;
using Inbox3 = MessageInbox<VertexMessage3>;
using SentMessages3 = SentMessagesOf<Vertex3>;

/// Receives final tetrahedra, most of them without positions. Ids are those of Vertex3.
class FinalCellConsumer3 : public FinalCellConsumer<3>
{
public:
  /// Adds a tetrahedron whose corners are the partition's own points; see InsideCells.
  virtual void addInside(const std::array<std::int64_t, 4>& ids) = 0;
};

/// Which tetrahedra of its own points a worker gives to FinalCellConsumer3::addInside().
enum class InsideCells
{
  OfRegion, ///< those whose circumball lies in the interior of the partition's region
  Any       ///< most of the final ones; fewer circumballs are computed
};

/// Triangulates partitions, one at a time, on one thread.
class Worker3
{
public:
  /// `regions` has the region of each partition. It and `order` must outlive this object.
  Worker3(const std::vector<Box3>& regions, const PartitionOrder& order,
    InsideCells inside = InsideCells::Any)
    : Regions(regions)
    , Order(order)
    , Inside(inside)
  {
  }

  /// Triangulates a partition's points and the vertices in its inbox. Tetrahedra that meet the
  /// partition and no later one go to `final`. The vertices of those that meet a later one are
  /// returned as messages to the next partition that the tetrahedron meets.
  SentMessages3 triangulate(const PartitionPoints3& points,
    const std::vector<VertexMessage3>& inbox, FinalCellConsumer3& final);

  ///@{
  /// The same in two steps: the points alone can be triangulated before the inbox is complete.
  /// Call finish() only if `proceed` has not returned false.
  void begin(const PartitionPoints3& points, const DelaunayKernel3::Monitor& proceed);
  SentMessages3 finish(const std::vector<VertexMessage3>& inbox, FinalCellConsumer3& final);
  ///@}

  /// The duplicates of all partitions triangulated so far, by point ids.
  const std::vector<Duplicate>& duplicates() const { return this->Duplicates; }
  /// The number of vertices triangulated in all partitions so far.
  std::size_t vertexCount() const { return this->VertexCount; }

private:
  using Index = DelaunayKernel3::Index;

  void collect(const std::vector<VertexMessage3>& inbox);
  Box3 boxBesideLater() const;
  SentMessages3 routeAll(FinalCellConsumer3& final);
  void measureVertices();
  void test(Index cell);
  void findBorder(Index cell);
  void addInside(Index cell, FinalCellConsumer3& final) const;
  void route(Index cell, FinalCellConsumer3& final);
  SentMessages3 send();
  void takeDuplicates();
  Vertex3 vertex(Index v) const;

  struct Measured
  {
    std::int64_t Id; ///< the point's
    double Slack;    ///< the distance from the sides of Interior; -1: another partition's point
  };

  const std::vector<Box3>& Regions;
  const PartitionOrder& Order;
  const InsideCells Inside;
  PartitionPoints3 Own;
  Box3 Beside;   ///< contains the own region; no later region reaches into its interior
  Box3 Interior; ///< Beside or the own region, see InsideCells
  DelaunayKernel3 Kernel;
  std::vector<Vertex3> Others; ///< from the inbox
  /// By later partition: the tetrahedra for it.
  std::vector<std::vector<std::array<Index, 4>>> Outgoing;
  std::vector<Measured> Vertices; ///< by vertex
  std::vector<char> IsTested;     ///< by tetrahedron
  std::vector<Index> ToTest;      ///< whose circumballs are tested, in this order
  std::vector<Duplicate> Duplicates;
  std::size_t VertexCount = 0;
};

} // namespace tipp

#endif

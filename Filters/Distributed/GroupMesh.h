// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGroupMesh_h
#define tippGroupMesh_h

#include "Distributed/SeamGroups.h"
#include "Distributed/VertexFile.h"
#include "Triangulation/IndependentPartitions.h"
#include "vtkTIPPFiltersModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace tipp
{

/// A master's mesh: the groups of triangles whose circumdisks meet an unfinished partition. What
/// inboxes are to threads, but its unit is the group, as it came from a worker. Of triangles it
/// keeps the vertices and the number: which are which is asked only of those that are final. The
/// vertices may be in a file; all methods may then throw IOError.
class VTKTIPPFILTERS_EXPORT GroupMesh : public ReachSource
{
public:
  /// Partitions without points are finished from the start.
  GroupMesh(PartitionIndex partitions, const std::vector<PartitionIndex>& withPoints);

  /// From now on vertices go to this file where all in memory take more than so many bytes.
  void spillTo(VertexFile& file, std::uint64_t most);
  /// Bytes of vertices, in memory and in the file.
  std::uint64_t vertexBytes() const { return this->Held + (this->File ? this->File->used() : 0); }

  /// Groups whose partitions are all finished, and what holds them.
  struct Final
  {
    std::shared_ptr<const SeamGroups> Groups;
    std::vector<std::uint32_t> Indices;
  };

  /// Takes groups in, and tells those that are final.
  Final add(SeamGroups groups);

  /// The partition's triangles are superseded by its worker's, which are to be added next.
  void finish(PartitionIndex partition);

  /// The vertices of the partition's triangles; one may come once for each of its groups.
  void gather(PartitionIndex partition, std::vector<PlainVertex>& vertices) const;

  const std::vector<std::uint32_t>& reach(PartitionIndex partition) override;
  PartitionIndex partitions() const override
  {
    return static_cast<PartitionIndex>(this->Members.size());
  }

  /// Triangles that are not final.
  std::size_t size() const { return this->Live; }

  /// Whether a group that is not final meets the partition, be this finished or not.
  bool isMet(PartitionIndex partition) const { return this->Meeting[std::size_t(partition)] > 0; }

  /// All groups that are not final: restored in an empty mesh with the same finished partitions
  /// they make this one again.
  void save(ByteWriter& writer) const;
  void restore(ByteReader& reader);

  bool isFinished(PartitionIndex partition) const
  {
    return this->Finished[std::size_t(partition)] != 0;
  }

  /// The vertices of every group that is not final and meets one of the partitions from `begin` to
  /// `end`.
  void visitVertices(PartitionIndex begin, PartitionIndex end,
    const std::function<void(const PlainVertex&)>& visit) const;

private:
  static constexpr std::uint32_t Gone = ~0U;

  /// Groups that came together, those that are not final.
  struct Batch
  {
    SeamGroups Groups;
    std::vector<std::uint32_t> Triangles;  ///< of each group: how many
    std::vector<std::uint32_t> Places;     ///< of what was added: among the groups, or Gone
    std::vector<VertexFile::Part> Spilled; ///< each group's vertices, if they are in the file
    std::size_t Alive = 0;

    std::uint64_t held() const { return this->Groups.Vertices.size() * sizeof(PlainVertex); }
  };
  struct Reference
  {
    std::shared_ptr<Batch> Of;
    std::uint32_t Group;
    std::uint32_t place() const { return this->Of->Places[this->Group]; }
    bool isAlive() const { return this->place() != Gone; }
  };
  struct Membership
  {
    std::vector<Reference> References; ///< some of which may be superseded
    std::vector<std::uint32_t> Reach;
    bool ReachIsCurrent = false;
  };

  bool isLive(const SeamGroups& groups, std::size_t g) const;
  void visitLive(const std::function<void(const Batch&, std::uint32_t)>& visit) const;
  std::size_t vertexCount(const Batch& batch, std::uint32_t place) const;
  void addVertices(
    const Batch& batch, std::uint32_t place, std::vector<PlainVertex>& vertices) const;
  void dropGone(Batch& batch);
  void spillIfTooMuch(Batch& batch);
  /// Those of the groups that are live, and the number of triangles of each.
  void enter(const SeamGroups& groups, const std::vector<std::uint32_t>& live,
    std::vector<std::uint32_t> triangles);

  std::vector<Membership> Members;
  std::vector<char> Finished;
  std::vector<std::uint32_t> Meeting; ///< of each partition: groups that are not final and meet it
  std::vector<std::uint64_t> LabelSeen; ///< the epoch in which reach() last met each label
  std::uint64_t Epoch = 0;
  std::size_t Live = 0;
  VertexFile* File = nullptr;
  std::uint64_t MostHeld = 0;
  std::uint64_t Held = 0; ///< bytes of vertices in memory
};

} // namespace tipp

#endif

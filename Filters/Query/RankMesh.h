// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankMesh_h
#define tippRankMesh_h

#include "Query/Queries.h"
#include "Ranks/Communicator.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace tipp
{

using Ids = std::vector<std::int64_t>;

/// A mesh whose parts are in the memory of several ranks, as one rank sees it during a query. Piece
/// 0 is this rank's part; it owns the points at which no other rank has cells. If a query needs the
/// cells at other points, all ranks send theirs, and these become a new piece that owns these
/// points. Queries then work as on a stored mesh.
///
/// The constructor and all methods declared here are collective.
class RankMesh : public ResidentMesh
{
public:
  /// `part` must outlive this. Throws IOError if a part has no global ids, or if parts have
  /// different types of cells.
  RankMesh(Communicator& ranks, const ResidentMesh& part);

  std::vector<std::int32_t> piecesAround(
    const Ids& points, const std::vector<Point3>& positions = {}) const override;
  bool isTrueOnAnyRank(bool condition) const override;

  /// Adds a piece that owns the shared points for which this rank is the lowest that has cells
  /// there. Returns the number of pieces.
  std::size_t addFirstShared() const;

  /// The lowest rank whose part has each id, or -1.
  std::vector<std::int32_t> firstRanksOf(const Ids& ids, bool ofPoints) const;

private:
  std::int32_t addCellsAt(const Ids& points) const;

  Communicator& Ranks;
  const ResidentMesh& Part;
  /// The number of the piece that owns a point, by global id, except for piece 0.
  mutable std::unordered_map<std::int64_t, std::int32_t> Owners;
};

/// Returns a list for each id; pieces[i] has all cells at ids[i] (points) or owns ids[i] (cells).
using ListWork = std::function<IdLists(
  const ResidentMesh& mesh, const Ids& ids, const std::vector<std::int32_t>& pieces)>;

/// Returns the lists of this rank's ids. With several ranks, one rank that has an id computes its
/// list: `work` runs on every rank, for the ids that the ranks ask of it, possibly none. Collective
/// if there are several ranks. Throws IOError for an id that no rank has.
IdLists listsOf(const ResidentMesh& mesh, const Ids& ids, bool ofPoints, Communicator* ranks,
  const ListWork& work);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResidentMesh_h
#define tippResidentMesh_h

#include "Parallel/CountingSort.h"
#include "Partitioned/PartitionedMesh.h"
#include "Predicates/Geometry.h"
#include "Resample/CellKey.h"
#include "Resident/MeshPart.h"
#include "Resident/ResidentPieces.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{
class IdDirectory;
class PieceFinder;

struct ResidentOptions
{
  /// Limit in bytes for the pieces of a stored mesh in memory, and for the structures to search
  /// them. The answers count too, as long as they leave space for one piece. If a single piece
  /// exceeds the limit, a query throws IOError.
  std::uint64_t MemoryLimit = std::uint64_t(1) << 30;
  int Threads = 0; ///< 0: defaultThreads()
  int Step = 0;    ///< time step of a stored mesh's arrays that vary in time
};

/// Cells and values of a mesh at some points.
struct MeshAnswer
{
  struct Array : StoredArray
  {
    /// `Components` values per point. Outside the mesh they are NaN, or 0 in integer arrays.
    Buffer<char> Values;

    std::size_t tupleBytes() const
    {
      return std::size_t(this->Components) * scalarSize(this->Type);
    }
  };

  std::vector<std::int64_t> Cells; ///< global id of the cell that contains each point; -1: none
  /// Barycentric coordinates per point, in the order of the cell's corners; zeros outside the mesh.
  /// Empty if they were not requested.
  std::vector<double> Weights;
  std::vector<CellKey> Keys; ///< keyAt() of the cells, if requested
  std::vector<Array> Arrays; ///< in the order of the request
};

/// Indices of items, grouped by the pieces that they belong to.
struct PieceGroups
{
  struct Group
  {
    std::size_t Piece;
    std::int64_t Begin; ///< index in Items
    std::int64_t End;
  };
  std::vector<Group> Groups; ///< only pieces with items, in ascending order
  GroupedItems<std::int64_t> Items;
};

/// Groups items by pieces: pieces[i] is the piece of item i, or -1 to leave it out.
PieceGroups groupByPiece(const std::vector<std::int32_t>& pieces);

/// An answer, with these arrays, for points that are all outside the mesh.
MeshAnswer emptyAnswer(std::int64_t count, const std::vector<StoredArray>& arrays, int corners,
  bool withWeights, bool withKeys);

/// What to compute for points, in addition to their cells.
struct AnswerOptions
{
  std::vector<std::string> Arrays; ///< names from ResidentMesh::names()
  bool Weights = false;
  bool Keys = false;
};

/// A mesh of triangles or tetrahedra for queries: a partitioned mesh on disk, whose pieces are read
/// when a query needs them, or arrays in memory. Points are located in triangles by x and y.
///
/// A point on an edge, a face or a corner belongs to one cell, by the rule of the resampling
/// (CellLocator). So results do not depend on pieces, threads or the order of queries. Thread-safe.
class VTKTIPPIO_EXPORT ResidentMesh
{
public:
  /// Opens a partitioned mesh. Throws IOError.
  explicit ResidentMesh(const std::string& path, const ResidentOptions& options = {});
  /// Uses a mesh in memory, and keeps a copy of `part`.
  explicit ResidentMesh(const MeshPart& part, const ResidentOptions& options = {});
  virtual ~ResidentMesh() = default;
  ResidentMesh(const ResidentMesh&) = delete;
  ResidentMesh& operator=(const ResidentMesh&) = delete;

  /// Counts, arrays and pieces. A mesh in memory has one piece.
  const PartitionedMesh& mesh() const { return this->Mesh; }
  const ResidentOptions& options() const { return this->Options; }
  bool isStored() const { return this->InMemory.empty(); }
  /// Whether cells have global ids; otherwise, their ids are indices.
  bool hasCellIds() const { return this->isStored() || this->InMemory[0].Part->CellIds; }
  /// The names of all arrays, each once. For triangles also "elevation", the z of points, unless an
  /// array has this name.
  std::vector<std::string> names() const;
  /// The array of this name, at the time step of the options; null for the elevation. Throws
  /// IOError if there is no such array.
  const StoredArray* find(const std::string& name) const;
  /// The array of this name, at the time step of the options; null for the elevation. Throws
  /// IOError if there is no such array, the mesh has tetrahedra, the array has no such component,
  /// or the array is at the cells and `allowsCells` is false.
  const StoredArray* fieldOf(
    const std::string& name, int component, bool allowsCells = false) const;
  /// Describes the arrays of these names, and the elevation like an array. Throws
  /// IOError for an unknown name.
  std::vector<StoredArray> describe(const std::vector<std::string>& names) const;

  /// Locates points and evaluates arrays there. Reads the pieces that contain points, each once.
  /// Throws IOError, also for a name that is not in names(), and WorkAborted.
  /// `pieceOf`: the result of piecesOf() for the points, if it is known.
  MeshAnswer answer(const Point3* points, std::int64_t count, const AnswerOptions& options = {},
    std::vector<std::int32_t> pieceOf = {}) const;

  /// For each point, the first piece whose closed box contains it, or -1.
  std::vector<std::int32_t> piecesOf(const Point3* points, std::int64_t count) const;

  /// For each global id of a cell or point, the piece of [first, end) that owns it, or -1. Throws
  /// IOError for an id that is out of the range of ids. For a mesh in memory, all are 0.
  std::vector<std::int32_t> piecesOfIds(
    const std::vector<std::int64_t>& ids, bool ofPoints, std::size_t first, std::size_t end) const;
  /// For each mesh point, given by id and position, a piece that has all cells there. Collective if
  /// the mesh is a RankMesh.
  virtual std::vector<std::int32_t> piecesAround(
    const std::vector<std::int64_t>& points, const std::vector<Point3>& positions) const;
  /// Whether `condition` is true on any rank of the query. Collective if the mesh is a RankMesh.
  virtual bool isTrueOnAnyRank(bool condition) const { return condition; }
  [[noreturn]] void refuseId(std::int64_t id, bool ofPoints) const;
  /// Throws IOError: "PATH: PROBLEM", or "The mesh PROBLEM" for a mesh in memory.
  [[noreturn]] void refuse(const std::string& problem) const;

  /// What a query of these arrays needs from a piece. Throws IOError for an unknown name.
  PieceNeeds needsOf(const std::vector<std::string>& names) const;
  /// Bytes per point, or per cell, in the needed arrays.
  std::uint64_t bytesOf(const PieceNeeds& needs, bool ofPoints) const;
  /// The pieces in memory.
  ResidentPieces& pieces() const { return this->Resident; }

  /// What is known about the other ranks' parts of a mesh in memory. Queries on ranks keep it here
  /// for the next one.
  struct OtherParts
  {
    const vtkMultiProcessController* Controller = nullptr; ///< null: nothing is known
    std::vector<std::uint8_t> Sharing;         ///< ghost flag per point of this part, for RankMesh
    std::shared_ptr<const IdDirectory> Points; ///< null: not made yet
    std::shared_ptr<const IdDirectory> Cells;
  };
  OtherParts& otherParts() const { return this->Others; }

protected:
  /// The same mesh, but with this piece in memory.
  ResidentMesh(const ResidentMesh& mesh, ResidentPiece piece);
  /// Adds a piece in memory, and returns its number.
  std::int32_t addPiece(MeshPart part) const;

  mutable std::vector<ResidentPiece> InMemory; ///< empty: stored mesh

private:
  ResidentMesh(
    PartitionedMesh mesh, std::vector<ResidentPiece> inMemory, const ResidentOptions& options);
  ResidentPiece load(
    std::size_t number, const PieceNeeds& needs, const ResidentPiece& before) const;
  std::uint64_t estimate(std::size_t number, const PieceNeeds& needs) const;
  [[noreturn]] void refusePiece(std::size_t number, std::uint64_t bytes) const;

  PartitionedMesh Mesh;
  ResidentOptions Options;
  std::unordered_map<std::string, std::size_t> ByName; ///< the mesh's arrays at Options.Step
  std::shared_ptr<const PieceFinder> Finder;           ///< null: mesh in memory
  mutable ResidentPieces Resident;
  mutable OtherParts Others;
};

} // namespace tipp

#endif

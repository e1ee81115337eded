// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResidentMesh_h
#define tippResidentMesh_h

#include "Partitioned/PartitionedMesh.h"
#include "Predicates/Points.h"
#include "Query/MeshPart.h"
#include "Query/PieceIds.h"
#include "Query/ResidentPieces.h"
#include "Resample/Claims.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

struct AskedPoints;
class PieceBoxes;
using TakeLocations =
  std::function<void(const std::int64_t* points, const CellLocation* at, std::int64_t count)>;

struct ResidentOptions
{
  /// In bytes, for the pieces of a stored mesh that are in memory and what is made to search them.
  /// Answers of points count, too, as far as one piece has room beside them. A query that needs
  /// more for one piece is refused.
  std::uint64_t MemoryLimit = std::uint64_t(1) << 30;
  int Threads = 0; ///< 0: OpenMP's default
  int Step = 0;    ///< the step of arrays that vary in time
};

/// What a mesh has at some points.
struct MeshAnswer
{
  struct Array
  {
    std::string Name;
    Scalar Type = Scalar::Float64;
    int Components = 1;
    /// `Components` a point; outside of the mesh NaN, in arrays of whole numbers 0.
    Buffer<char> Values;

    std::size_t tupleBytes() const
    {
      return std::size_t(this->Components) * scalarSize(this->Type);
    }
  };

  std::vector<std::int64_t> Cells; ///< global id of the cell that holds each point; -1: outside
  /// Barycentric weights, as many a point as a cell has corners, in the order of its corners; zeros
  /// outside. Empty if they were not wanted.
  std::vector<double> Weights;
  std::vector<CellKey> Keys; ///< keyAt() of the cells, if they were wanted
  std::vector<Array> Arrays; ///< in the order asked for
};

/// Items by the piece that they concern.
struct PieceGroups
{
  struct Group
  {
    std::size_t Piece;
    std::int64_t Begin; ///< in Items
    std::int64_t End;
  };
  std::vector<Group> Groups; ///< those that have items, by piece
  std::vector<std::int64_t> Items;
};

/// pieces[i] is that of item i, of `count` pieces; items with -1 are left out.
PieceGroups groupByPiece(const std::vector<std::int32_t>& pieces, std::size_t count);

/// An answer for points outside of a mesh; of the arrays' descriptions name, type and components
/// count.
MeshAnswer emptyAnswer(std::int64_t count, const std::vector<StoredArray>& arrays, int corners,
  bool withWeights, bool withKeys);

/// What to compute at points besides their cells.
struct AnswerOptions
{
  std::vector<std::string> Arrays; ///< of ResidentMesh::names()
  bool Weights = false;
  bool Keys = false;
};

/// A mesh of triangles or tetrahedra that answers queries: a partitioned mesh on disk, whose pieces
/// are read when a query needs them, or arrays in memory. Triangles are found by x and y.
///
/// A point on an edge, a face or a corner belongs to one cell, by the rule of the resampling
/// (CellLocator). So answers depend neither on pieces nor on threads nor on the order of queries.
/// Several threads may use it at once.
class VTKTIPPIO_EXPORT ResidentMesh
{
public:
  /// Opens a partitioned mesh; throws IOError.
  explicit ResidentMesh(const std::string& path, const ResidentOptions& options = {});
  /// A mesh in memory, which `part` keeps.
  explicit ResidentMesh(MeshPart part, const ResidentOptions& options = {});
  ResidentMesh(const ResidentMesh&) = delete;
  ResidentMesh& operator=(const ResidentMesh&) = delete;

  /// Counts, arrays and pieces; a mesh in memory is one piece.
  const PartitionedMesh& mesh() const { return this->Mesh; }
  const ResidentOptions& options() const { return this->Options; }
  bool isStored() const { return !this->InMemory; }
  /// Whether cells have global ids of their own; else these are indices.
  bool hasCellIds() const { return !this->InMemory || this->InMemory->CellIds; }
  /// The names of arrays, each once, and "elevation", the z of the points of triangles, if no array
  /// has this name.
  std::vector<std::string> names() const;
  /// The array of that name at the step of the options; null: the elevation. Throws IOError if
  /// there is none.
  const StoredArray* find(const std::string& name) const;

  /// Locates points and evaluates arrays there. Reads the pieces that points lie in, each once.
  /// Throws IOError, also for a name that is not among names(), and WorkAborted.
  /// `pieceOf` may be what piecesOf() says of the points.
  MeshAnswer answer(const Point3* points, std::int64_t count, const AnswerOptions& options = {},
    std::vector<std::int32_t> pieceOf = {}) const;

  /// The piece that each point belongs to, the first whose closed box holds it; -1: none.
  std::vector<std::int32_t> piecesOf(const Point3* points, std::int64_t count) const;

  /// The pieces that own cells or points by their global ids. Throws IOError for an id that the
  /// mesh does not have.
  std::vector<std::int32_t> piecesOfIds(const std::vector<std::int64_t>& ids, bool ofPoints) const;
  /// As piecesOfIds(), of a stored mesh and the pieces [first, end); -1: none owns it.
  std::vector<std::int32_t> findIds(
    const std::vector<std::int64_t>& ids, bool ofPoints, std::size_t first, std::size_t end) const;
  [[noreturn]] void refuseId(std::int64_t id, bool ofPoints) const;

  /// What queries of these arrays need of a piece. Throws IOError.
  PieceNeeds needsOf(const std::vector<std::string>& names) const;
  /// The pieces in memory.
  ResidentPieces& pieces() const { return this->Resident; }

  /// Of a part of a mesh in memory: whether another rank of `Of` has each point, too. Queries on
  /// ranks keep it here for the next one.
  struct SharedPoints
  {
    const vtkMultiProcessController* Of = nullptr; ///< null: not known
    std::vector<std::uint8_t> Are;
  };
  SharedPoints& sharedPoints() const { return this->Shared; }

private:
  void answerPiece(std::size_t number, const AskedPoints& asked, const AnswerOptions& options,
    int threads, bool mayStay, MeshAnswer& answer) const;
  using Locate = std::function<bool(const TakeLocations&)>;
  bool answerPart(const MeshPart& part, const AskedPoints& asked, const AnswerOptions& options,
    const Locate& locate, MeshAnswer& answer) const;
  bool answerInOnePass(const MeshPart& part, const AskedPoints& asked, const AnswerOptions& options,
    int threads, MeshAnswer& answer) const;
  void answerBy(const CellLocator* locator, const MeshPart& part, const AskedPoints& asked,
    const AnswerOptions& options, int threads, MeshAnswer& answer) const;
  bool wantsNear(
    std::size_t number, const PieceNeeds& needs, const AskedPoints& asked, bool mayStay) const;
  bool answerNear(std::size_t number, const PieceNeeds& needs, const AskedPoints& asked,
    const AnswerOptions& options, int threads, MeshAnswer& answer) const;
  ResidentPiece load(
    std::size_t number, const PieceNeeds& needs, const ResidentPiece& before) const;
  std::uint64_t estimate(std::size_t number, const PieceNeeds& needs) const;
  std::uint64_t estimateNear(
    std::size_t number, const PieceNeeds& needs, std::int64_t most, std::int64_t asked) const;
  [[noreturn]] void refusePiece(std::size_t number, std::uint64_t bytes) const;

  PartitionedMesh Mesh;
  ResidentOptions Options;
  std::shared_ptr<const MeshPart> InMemory; ///< null: stored
  std::shared_ptr<const PieceBoxes> Boxes;  ///< null: in memory
  PieceIds Ids;
  mutable ResidentPieces Resident;
  mutable SharedPoints Shared;
};

} // namespace tipp

#endif

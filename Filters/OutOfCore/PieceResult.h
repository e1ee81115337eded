// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceResult_h
#define tippPieceResult_h

#include "Constraints/Insertion/CrossedPart.h"
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/PiecePlan3.h"
#include "OutOfCore/ScratchFiles.h"
#include "OutOfCore/SpilledPoints.h"
#include "OutOfCore/SpilledSegments.h"
#include "OutOfCore/TriangleConsumer.h"
#include "Parallel/ParallelFor.h"
#include "Partitioned/GrowingPiece.h"
#include "Partitioned/PieceFile.h"
#include "Triangulation/Dataflow.h"
#include "Triangulation/ResolveDuplicates.h"
#include "Triangulation/Tiling.h"
#include "Triangulation3D/Dataflow3.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{

/// The input and the destination of the work on a run's pieces, of triangles or tetrahedra. It is
/// the same on all ranks. References are not owned.
template <typename PlanType, typename ResultType>
struct PieceWorkOf
{
  using Result = ResultType; ///< reads parts of a piece's result

  const PlanType& Plan;
  const SpilledPoints& Points;
  const PointRowLayout& Rows;
  const PartitionedMesh& Mesh;
  std::string Results; ///< prefix of the paths of results
  double Factor = 1;   ///< multiplies the points' coordinates to give the plan's

  std::string resultPath(PartitionIndex piece) const
  {
    return this->Results + "." + std::to_string(this->Plan.number(piece));
  }
  std::string finishedPath(PartitionIndex piece) const
  {
    return this->resultPath(piece) + ".finished";
  }
};

/// Triangles (3 corners) or tetrahedra (4 corners) at the border of the piece that owns them.
/// Corners are indices among all spilled points.
template <std::size_t CornerCount>
struct BorderCells
{
  using Cell = std::array<std::int64_t, CornerCount>;

  std::vector<Cell> Corners;
  std::vector<std::int32_t> Borrowers;     ///< ascending per cell; pieces are indices in the mesh
  std::vector<std::uint64_t> BorrowerEnds; ///< by cell: the end of its entries in Borrowers

  /// `met`: the pieces that the cell meets, as indices in the mesh, ascending. The first owns the
  /// cell.
  void add(const Cell& cell, const std::vector<std::int32_t>& met)
  {
    this->Corners.push_back(cell);
    this->Borrowers.insert(this->Borrowers.end(), met.begin() + 1, met.end());
    this->BorrowerEnds.push_back(this->Borrowers.size());
  }
};

template <typename Archive, std::size_t CornerCount>
void serialize(Archive& archive, BorderCells<CornerCount>& border)
{
  archive(border.Corners, border.Borrowers, border.BorrowerEnds);
}

template <std::size_t CornerCount>
using BordersOf = std::map<PartitionIndex, BorderCells<CornerCount>>;

/// The result of a piece whose partitions are all triangulated: the data that others need, besides
/// the interior's part of the mesh file. It is written once and never changed; the set of these
/// files is the state from which a run is resumed. `Message` has the vertices that one partition
/// sends to another.
///
/// In the plane, a triangle belongs to the piece's interior if its circumdisk meets no other piece,
/// and otherwise to a border. A piece's points are interface points if they are corners of border
/// triangles, of triangles that are not final, or of triangles with an artificial corner. All of
/// them are known when the piece is done: by Lemma 6, the last partition of the piece that a
/// triangle meets has sent the triangle if it is not final, and triangles that are made later
/// replace triangles like these.
template <std::size_t CornerCount, typename Message>
struct PieceResultOf
{
  using Vertex = typename decltype(Message::Vertices)::value_type;
  using Messages = std::vector<std::pair<PartitionIndex, Message>>;

  PieceInterior Interior;
  PieceFigures Figures;
  std::vector<Vertex> HullVertices; ///< true corners of cells with artificial corners
  BordersOf<CornerCount> Borders;
  /// In the plane: the interior triangles that are crossed by constraints not complete in the
  /// interior. They are left out of the interior, and their corners are interface points.
  CrossedPart Crossed;
  std::map<PartitionIndex, Messages> Sent; ///< by the recipient's piece
};

/// Writes a result to a file, and reads parts of it. All methods except hasBorder() and sentBytes()
/// throw IOError if the file is damaged or missing.
template <std::size_t CornerCount, typename Message>
class StoredResultOf
{
public:
  using Content = PieceResultOf<CornerCount, Message>;

  explicit StoredResultOf(const std::string& path)
    : File(path)
  {
  }

  static void write(const std::string& path, const Content& result)
  {
    SectionFileWriter file(path);
    const PieceInterior& interior = result.Interior;
    file.add({ InterfaceSection, 0 }, packed(interior.InterfacePoints, interior.InterfaceRows));
    file.add({ InteriorSection, 0 }, packed(interior));
    file.add({ FiguresSection, 0 }, packed(result.Figures));
    file.add({ HullSection, 0 }, packed(result.HullVertices));
    for (const auto& [owner, cells] : result.Borders)
    {
      file.add({ BorderSection, owner }, packed(cells));
    }
    if (!result.Crossed.Triangles.empty() || !result.Crossed.Touches.empty())
    {
      file.add({ CrossedSection, 0 }, packed(result.Crossed));
    }
    for (const auto& [to, messages] : result.Sent)
    {
      SaveArchive writer;
      for (const auto& [partition, message] : messages)
      {
        writer(partition, message);
      }
      file.add({ MessageSection, to }, writer.take());
    }
    file.finish();
  }

  /// Returns the size of the messages to the piece `to`; 0 if there are none.
  std::uint64_t sentBytes(PartitionIndex to) const
  {
    return this->File.bytes({ MessageSection, to });
  }
  /// `to`: the piece that receives the messages.
  typename Content::Messages readMessages(PartitionIndex to) const
  {
    const Bytes bytes = this->File.read({ MessageSection, to });
    typename Content::Messages messages;
    for (LoadArchive reader(bytes); reader.left() > 0;)
    {
      messages.emplace_back(reader.get<PartitionIndex>(), Message{});
      reader(messages.back().second);
    }
    return messages;
  }

  /// `owner`: the piece that owns the cells.
  bool hasBorder(PartitionIndex owner) const { return this->File.has({ BorderSection, owner }); }
  BorderCells<CornerCount> readBorder(PartitionIndex owner) const
  {
    return unpacked<BorderCells<CornerCount>>(this->File.read({ BorderSection, owner }));
  }
  std::vector<typename Content::Vertex> readHullVertices() const
  {
    return unpacked<std::vector<typename Content::Vertex>>(this->File.read({ HullSection, 0 }));
  }
  CrossedPart readCrossed() const
  {
    return this->File.has({ CrossedSection, 0 })
      ? unpacked<CrossedPart>(this->File.read({ CrossedSection, 0 }))
      : CrossedPart();
  }
  PieceFigures readFigures() const
  {
    return unpacked<PieceFigures>(this->File.read({ FiguresSection, 0 }));
  }

  /// Returns the interior of the piece with this result. If not `all`, reads only the interface
  /// points and their rows.
  PieceInterior readInterior(const SpilledPoints& points, PartitionIndex piece, bool all) const
  {
    PieceInterior interior =
      all ? unpacked<PieceInterior>(this->File.read({ InteriorSection, 0 })) : PieceInterior();
    interior.First = points.first(piece);
    interior.OwnPoints = points.count(piece);
    const Bytes bytes = this->File.read({ InterfaceSection, 0 });
    LoadArchive reader(bytes);
    reader(interior.InterfacePoints, interior.InterfaceRows);
    return interior;
  }

private:
  enum SectionKind : std::uint32_t
  {
    InterfaceSection,
    InteriorSection,
    FiguresSection,
    HullSection,
    BorderSection,
    CrossedSection,
    MessageSection
  };

  SectionFile File;
};

using BorderTriangles = BorderCells<3>;
using BordersByOwner = BordersOf<3>;
using PieceResult = PieceResultOf<3, VertexMessage>;
using StoredResult = StoredResultOf<3, VertexMessage>;

using BorderCells3 = BorderCells<4>;
using BordersByOwner3 = BordersOf<4>;
using PieceResult3 = PieceResultOf<4, VertexMessage3>;
using StoredResult3 = StoredResultOf<4, VertexMessage3>;
using PieceWork3 = PieceWorkOf<PiecePlan3, StoredResult3>;

/// The work on pieces of triangles. Pointers are not owned.
struct PieceWork : PieceWorkOf<PiecePlan, StoredResult>
{
  TriangleConsumer* Consumer = nullptr; ///< null: triangles are written to the mesh
  double MaximumEdge = 0; ///< triangles with a longer edge are left out; 0: all are kept
  DuplicateRule Duplicates = DuplicateRule::First;
  const SpilledSegments* Constraints = nullptr; ///< null: no constraints
  /// Its index among the columns; the number of columns if there is none.
  std::size_t Elevation = 0;

  /// Returns whether Consumer gets the triangles between pieces as soon as these pieces are done.
  /// With constraints it does not, because they may change or remove these triangles.
  bool takesBordersEarly() const { return this->Consumer && !this->Constraints; }

  /// Returns the longest edge of triangles at borders, in the plan's unit; 0: no limit. With
  /// constraints, which change triangles, long ones are left out later instead.
  double longestAtBorder() const
  {
    return this->Constraints ? 0 : this->MaximumEdge * this->Factor;
  }
};

/// The paths of a piece's files, besides its part of the mesh.
struct StoredPiece
{
  std::size_t Number;   ///< the piece's index in the mesh
  std::string Result;   ///< the SectionFile written when the piece's own points are triangulated
  std::string Finished; ///< the record of finishOnce(), written when the border is written, too
};

/// Returns for each piece whether an earlier process left its result and its part of the mesh
/// undamaged. Reads all of these files. Removes damaged ones, so that their pieces are made again,
/// and passes a sentence about them to `warn`, if that is set. `interior`: reads the interior of a
/// piece. `report` throws to stop the run.
std::vector<char> verifyPieces(const PartitionedMesh& mesh, const std::vector<StoredPiece>& pieces,
  const std::function<PieceInterior(PartitionIndex)>& interior, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn);

/// The same for a PieceWork or PieceWork3.
template <typename Work>
std::vector<char> verifyResults(const Work& work, int threads, const Report& report,
  const std::function<void(const std::string&)>& warn)
{
  std::vector<StoredPiece> pieces;
  pieces.reserve(std::size_t(work.Plan.pieces()));
  for (PartitionIndex piece = 0; piece < work.Plan.pieces(); ++piece)
  {
    pieces.push_back({ work.Plan.number(piece), work.resultPath(piece), work.finishedPath(piece) });
  }
  return verifyPieces(
    work.Mesh, pieces,
    [&](PartitionIndex piece) {
      return typename Work::Result(work.resultPath(piece)).readInterior(work.Points, piece, true);
    },
    threads, report, warn);
}

/// Reads a finished piece from its record at `path`. If there is no record, calls finish() and
/// writes its result as the record. Throws IOError.
FinishedPiece finishOnce(const std::string& path, const std::function<FinishedPiece()>& finish);

} // namespace tipp

#endif

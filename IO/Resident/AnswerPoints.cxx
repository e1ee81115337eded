// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Locate/CellLocator.h"
#include "Locate/PointGrid.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace tipp
{
namespace
{

/// A locator is made for a piece after this many searches without one, or for a search with more
/// than one point per `cellsPerPoint` cells.
constexpr int searchesWithoutLocator = 4;
constexpr std::int64_t cellsPerPoint = 8;

/// For a search with more than one point per this many cells, a pass over all cells is fastest.
constexpr std::int64_t cellsPerPointOfPass = 2;
constexpr std::uint64_t bytesOfPass = 40; ///< of memory, per point

/// Cells near the points are read without the others if they are at most one in this many.
constexpr std::int64_t cellsPerNearOne = 3;

/// Selects the cells whose bounding boxes may contain one of the points. Stops if there are more
/// than `most`.
template <int D>
class NearCells
{
public:
  NearCells(const AskedPoints& asked, std::int64_t most)
    : Grid(asked.Count, 1, [&asked](std::int64_t i) { return projected<D>(asked.at(i)); })
    , Most(most)
  {
  }

  bool operator()(const Piece& piece, std::int64_t first, std::int64_t count, const void* ids,
    bool wide, std::vector<std::int64_t>& chosen)
  {
    if (this->Positions.empty())
    {
      piece.PointType == Scalar::Float32
        ? this->findPositions(piece.Coordinates.as<float>(), piece.Points)
        : this->findPositions(piece.Coordinates.as<double>(), piece.Points);
    }
    wide ? this->choose(first, count, static_cast<const std::int64_t*>(ids), chosen)
         : this->choose(first, count, static_cast<const std::int32_t*>(ids), chosen);
    return std::int64_t(chosen.size()) <= this->Most;
  }

private:
  template <typename Coordinate>
  void findPositions(const Coordinate* coordinates, std::int64_t points)
  {
    this->Positions.resize(std::size_t(points));
    for (auto& position : this->Positions)
    {
      Point<D> at;
      std::copy_n(coordinates, D, &at.x);
      position = this->Grid.position(at);
      coordinates += 3;
    }
  }

  template <typename Id>
  void choose(
    std::int64_t first, std::int64_t count, const Id* ids, std::vector<std::int64_t>& chosen) const
  {
    constexpr std::int64_t ahead = 16; // prefetch distance, since positions are accessed at random
    for (std::int64_t i = 0; i < count; ++i)
    {
      for (int k = 0; k <= D && i + ahead < count; ++k)
      {
        __builtin_prefetch(&this->Positions[std::size_t(ids[(i + ahead) * (D + 1) + k])]);
      }
      if (this->Grid.template mayHold<D + 1>(this->Positions, ids + i * (D + 1)))
      {
        chosen.push_back(first + i);
      }
    }
  }

  PointGrid<D> Grid;
  std::vector<typename PointGrid<D>::Position> Positions; ///< of the piece's points, by local index
  std::int64_t Most;
};

/// Whether the bounding box of the points covers less than half of a box.
template <int D>
bool areNarrow(const AskedPoints& asked, const Box3& box)
{
  const auto are = [&](std::int64_t count)
  {
    const Box<D> around = boundsOf<D>(
      count, 1, [&asked](std::int64_t i) { return Box<D>::of(projected<D>(asked.at(i))); });
    double share = 1;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      share *= around.width(axis) / box.width(axis);
    }
    return share < 0.5;
  };
  constexpr std::int64_t some = 1 << 10; // in most cases, so many show that all are not narrow
  return (asked.Count <= some || are(some)) && are(asked.Count);
}

/// Answers the points of a query, one piece per call. Several threads may call it for different
/// pieces.
class PointQuery
{
public:
  PointQuery(const ResidentMesh& mesh, const AnswerOptions& options, MeshAnswer& answer)
    : Mesh(mesh)
    , Options(options)
    , Needs(mesh.needsOf(options.Arrays))
    , Answer(answer)
  {
  }

  /// `mayStay` says whether all pieces of the query fit into memory together.
  void answerPiece(std::size_t number, const AskedPoints& asked, int threads, bool mayStay) const
  {
    if (this->wantsNear(number, asked, mayStay) && this->answerNear(number, asked, threads))
    {
      return;
    }
    ResidentPieces& pieces = this->Mesh.pieces();
    const PieceSummary& summary = this->Mesh.mesh().Pieces[number];
    const std::int64_t cells = summary.Cells + summary.BorrowedCells;
    if (asked.Count > cells / cellsPerPointOfPass)
    {
      const ResidentPieces::Lease piece = pieces.get(number, this->Needs);
      if (this->answerInOnePass(*piece->Part, asked, threads))
      {
        return;
      }
    }
    PieceNeeds needs = this->Needs;
    needs.Locator = true;
    needs.Locator = pieces.fits(number, needs) &&
      (asked.Count > cells / cellsPerPoint || pieces.uses(number) >= searchesWithoutLocator);
    const ResidentPieces::Lease piece = pieces.get(number, needs);
    const MeshPart& part = *piece->Part;
    locatePoints(
      part.Mesh, part.CellIds, piece->Locator.get(), asked, threads, this->taking(part, asked));
  }

private:
  /// A function that stores locations in a part, and the arrays' values there.
  TakeLocations taking(const MeshPart& part, const AskedPoints& asked) const
  {
    std::vector<PartValues> values;
    for (const std::string& name : this->Options.Arrays)
    {
      values.emplace_back(part, this->Mesh.find(name));
    }
    return [this, &part, points = asked.Points, values = std::move(values)](
             const std::int64_t* indices, const CellLocation* at, std::int64_t count)
    {
      const auto corners = std::size_t(this->Mesh.mesh().CellSize);
      for (std::int64_t i = 0; i < count; ++i)
      {
        const auto index = std::size_t(indices[i]);
        this->Answer.Cells[index] = part.cellId(at[i].Cell);
        if (this->Options.Weights)
        {
          std::copy_n(at[i].Weights, corners, this->Answer.Weights.data() + index * corners);
        }
        if (this->Options.Keys)
        {
          this->Answer.Keys[index] = keyAt(part.Mesh, at[i].Cell, points[index]);
        }
      }
      for (std::size_t a = 0; a < values.size(); ++a)
      {
        values[a].sample(at, indices, count, this->Answer.Arrays[a].Values.data());
      }
    };
  }

  /// Answers with a pass over all cells. Returns false if this is not the fastest method; then the
  /// answer may already have some points.
  bool answerInOnePass(const MeshPart& part, const AskedPoints& asked, int threads) const
  {
    if (asked.Count <= part.Mesh.Cells / cellsPerPointOfPass)
    {
      return false;
    }
    const ResidentPieces::Share memory =
      this->Mesh.pieces().note(std::uint64_t(asked.Count) * bytesOfPass);
    return locateInOnePass(part.Mesh, part.CellIds, asked, threads, this->taking(part, asked));
  }

  /// Whether to read only the cells near the points instead of the whole piece.
  bool wantsNear(std::size_t number, const AskedPoints& asked, bool mayStay) const
  {
    ResidentPieces& pieces = this->Mesh.pieces();
    if (!this->Mesh.isStored() || pieces.isResident(number, this->Needs) ||
      (pieces.countQuestion(number) >= searchesWithoutLocator && mayStay))
    {
      return false;
    }
    const PieceSummary& piece = this->Mesh.mesh().Pieces[number];
    return asked.Count <= (piece.Cells + piece.BorrowedCells) / cellsPerPoint ||
      (this->Mesh.mesh().CellSize == 3 ? areNarrow<2>(asked, piece.Box)
                                       : areNarrow<3>(asked, piece.Box));
  }

  /// An upper bound of the bytes that answerNear() needs for all points of the piece, and at most
  /// `most` of its cells.
  std::uint64_t estimateNear(std::size_t number, std::int64_t most, std::int64_t asked) const
  {
    const PartitionedMesh& mesh = this->Mesh.mesh();
    const PieceSummary& piece = mesh.Pieces[number];
    const auto points = std::uint64_t(piece.Points + piece.BorrowedCells);
    const auto cells = std::uint64_t(most + piece.BorrowedCells);
    // A point has its position and, to find borrowed points, its id. A cell has its index.
    const std::uint64_t ofPoint =
      3 * scalarSize(mesh.PointType) + 8 + 6 + this->Mesh.bytesOf(this->Needs, true);
    const std::uint64_t ofCell =
      2 * std::uint64_t(mesh.CellSize) * 4 + 16 + this->Mesh.bytesOf(this->Needs, false);
    constexpr std::uint64_t ofAsked = 128; // bytes of a tree, and of the cells near the point
    constexpr std::uint64_t blocks = 1 << 20;
    return points * ofPoint + cells * ofCell +
      std::uint64_t(CellLocator::bytesFor(std::int64_t(cells), mesh.CellSize - 1)) +
      std::uint64_t(std::min(asked, most)) * ofAsked + blocks;
  }

  /// Reads only the cells near the points and answers with them. Returns false, without any answer,
  /// if there are too many such cells or too little memory.
  bool answerNear(std::size_t number, const AskedPoints& asked, int threads) const
  {
    const std::int64_t most = this->Mesh.mesh().Pieces[number].Cells / cellsPerNearOne + 256;
    const ResidentPieces::Share memory =
      this->Mesh.pieces().take(this->estimateNear(number, most, asked.Count));
    if (!memory)
    {
      return false;
    }
    PieceOptions reading;
    reading.Step = this->Mesh.options().Step;
    reading.Wanted = this->Needs.Arrays;
    reading.Cells = this->Mesh.mesh().CellSize == 3
      ? PieceOptions::Choose(NearCells<2>(asked, most))
      : PieceOptions::Choose(NearCells<3>(asked, most));
    Piece near = readPiece(this->Mesh.mesh(), number, reading);
    reading.Cells = nullptr;
    if (near.IsStopped)
    {
      return false;
    }
    const MeshPart part = partOf(std::move(near));
    if (!this->answerInOnePass(part, asked, threads))
    {
      std::optional<CellLocator> locator;
      if (asked.Count > part.Mesh.Cells / cellsPerPoint)
      {
        locator.emplace(part.Mesh, part.CellIds, threads);
      }
      locatePoints(part.Mesh, part.CellIds, locator ? &*locator : nullptr, asked, threads,
        this->taking(part, asked));
    }
    return true;
  }

  const ResidentMesh& Mesh;
  const AnswerOptions& Options;
  const PieceNeeds Needs;
  MeshAnswer& Answer;
};

} // namespace

MeshAnswer emptyAnswer(std::int64_t count, const std::vector<StoredArray>& arrays, int corners,
  bool withWeights, bool withKeys)
{
  MeshAnswer answer;
  const auto points = std::size_t(count);
  answer.Cells.assign(points, -1);
  answer.Weights.assign(withWeights ? points * std::size_t(corners) : 0, 0);
  answer.Keys.assign(withKeys ? points : 0, noCellKey);
  for (const StoredArray& array : arrays)
  {
    MeshAnswer::Array values{ array, {} };
    values.Values = Buffer<char>(points * values.tupleBytes());
    withScalar(array.Type,
      [&](auto zero)
      {
        using Value = decltype(zero);
        const Value null = toScalar<Value>(std::numeric_limits<double>::quiet_NaN());
        std::fill_n(values.Values.as<Value>(), values.Values.size() / sizeof(Value), null);
      });
    answer.Arrays.push_back(std::move(values));
  }
  return answer;
}

PieceGroups groupByPiece(const std::vector<std::int32_t>& pieces)
{
  const std::int32_t last = pieces.empty() ? -1 : *std::max_element(pieces.begin(), pieces.end());
  const auto count = std::size_t(std::int64_t(last) + 1);
  PieceGroups result;
  result.Items = { count, 1,
    [&pieces](const auto& visit)
    {
      for (std::size_t i = 0; i < pieces.size(); ++i)
      {
        if (pieces[i] >= 0)
        {
          visit(std::size_t(pieces[i]), std::int64_t(i));
        }
      }
    } };
  for (std::size_t p = 0; p < count; ++p)
  {
    const auto begin = std::int64_t(result.Items.start(p));
    const auto end = std::int64_t(result.Items.start(p + 1));
    if (begin < end)
    {
      result.Groups.push_back({ p, begin, end });
    }
  }
  return result;
}

MeshAnswer ResidentMesh::answer(const Point3* points, std::int64_t count,
  const AnswerOptions& options, std::vector<std::int32_t> pieceOf) const
{
  if (count > std::numeric_limits<std::int32_t>::max())
  {
    throw IOError("More than 2147483647 points are asked for at once; ask in parts.");
  }
  const std::vector<StoredArray> arrays = this->describe(options.Arrays);
  std::uint64_t bytes = 3 * sizeof(std::int64_t); // a point, its index and its piece
  bytes += options.Weights ? std::uint64_t(this->Mesh.CellSize) * sizeof(double) : 0;
  bytes += options.Keys ? sizeof(CellKey) : 0;
  for (const StoredArray& array : arrays)
  {
    bytes += std::uint64_t(array.Components) * scalarSize(array.Type);
  }
  const ResidentPieces::Share memory = this->Resident.note(std::uint64_t(count) * bytes);
  MeshAnswer answer =
    emptyAnswer(count, arrays, this->Mesh.CellSize, options.Weights, options.Keys);
  const PointQuery query(*this, options, answer);
  if (!this->isStored())
  {
    query.answerPiece(0, { points, nullptr, count }, threadCount(this->Options.Threads), true);
    return answer;
  }
  pieceOf = pieceOf.empty() ? this->piecesOf(points, count) : std::move(pieceOf);
  PieceGroups groups = groupByPiece(pieceOf);
  pieceOf = {};
  // Pieces that are in memory come first, before others displace them.
  std::stable_partition(groups.Groups.begin(), groups.Groups.end(),
    [&](const PieceGroups::Group& group) { return this->Resident.isResident(group.Piece); });
  PieceNeeds needs = this->needsOf(options.Arrays);
  needs.Locator = true;
  std::uint64_t together = 0;
  for (const PieceGroups::Group& group : groups.Groups)
  {
    together += this->estimate(group.Piece, needs);
  }
  const bool mayStay = together <= this->Options.MemoryLimit;
  sharePieces(*this, groups.Groups.size(),
    [&](std::size_t g, int threads)
    {
      const PieceGroups::Group& group = groups.Groups[g];
      query.answerPiece(group.Piece,
        { points, groups.Items.data() + group.Begin, group.End - group.Begin }, threads, mayStay);
    });
  return answer;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Locate/CellLocator.h"
#include "Locate/CellPass.h"
#include "Locate/PointGrid.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Query/ResidentMesh.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
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
template <int D, typename Coordinate>
class NearCells
{
public:
  NearCells(const AskedPoints& asked, std::int64_t most)
    : Grid(asked.Count, 1, [&asked](std::int64_t i) { return coordinatesOf<D>(asked.at(i)); })
    , Most(most)
  {
  }

  bool operator()(const Piece& piece, std::int64_t first, std::int64_t count, const void* ids,
    bool wide, std::vector<std::int64_t>& chosen)
  {
    this->Positions.empty() ? this->findPositions(piece) : void();
    wide ? this->choose(first, count, static_cast<const std::int64_t*>(ids), chosen)
         : this->choose(first, count, static_cast<const std::int32_t*>(ids), chosen);
    return std::int64_t(chosen.size()) <= this->Most;
  }

private:
  void findPositions(const Piece& piece)
  {
    this->Positions.resize(std::size_t(piece.Points));
    const auto* coordinates = piece.Coordinates.as<Coordinate>();
    for (auto& position : this->Positions)
    {
      std::array<double, D> at;
      std::copy_n(coordinates, D, at.begin());
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

PieceOptions::Choose nearCells(
  const PartitionedMesh& mesh, const AskedPoints& asked, std::int64_t most)
{
  const bool isFloat = mesh.PointType == Scalar::Float32;
  if (mesh.CellSize == 3)
  {
    return isFloat ? PieceOptions::Choose(NearCells<2, float>(asked, most))
                   : PieceOptions::Choose(NearCells<2, double>(asked, most));
  }
  return isFloat ? PieceOptions::Choose(NearCells<3, float>(asked, most))
                 : PieceOptions::Choose(NearCells<3, double>(asked, most));
}

/// Whether the bounding box of the points covers less than half of a box.
template <int D>
bool areNarrow(const AskedPoints& asked, const Bounds& box)
{
  const auto are = [&](std::int64_t count)
  {
    const Box<D> around = boundsOf<D>(
      count, 1, [&asked](std::int64_t i) { return Box<D>::of(coordinatesOf<D>(asked.at(i))); });
    double share = 1;
    for (std::size_t axis = 0; axis < D; ++axis)
    {
      share *= (around.High[axis] - around.Low[axis]) / (box[2 * axis + 1] - box[2 * axis]);
    }
    return share < 0.5;
  };
  constexpr std::int64_t some = 1 << 10; // in most cases, so many show that all are not narrow
  return (asked.Count <= some || are(some)) && are(asked.Count);
}

/// Fills an array with NaN, or with 0 if it is an integer array.
void fillNull(MeshAnswer::Array& array)
{
  withScalar(array.Type,
    [&](auto zero)
    {
      using Value = decltype(zero);
      const Value null = toScalar<Value>(std::numeric_limits<double>::quiet_NaN());
      std::fill_n(array.Values.as<Value>(), array.Values.size() / sizeof(Value), null);
    });
}

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
    MeshAnswer::Array values;
    values.Name = array.Name;
    values.Type = array.Type;
    values.Components = array.Components;
    values.Values = Buffer<char>(points * values.tupleBytes());
    fillNull(values);
    answer.Arrays.push_back(std::move(values));
  }
  return answer;
}

PieceGroups groupByPiece(const std::vector<std::int32_t>& pieces, std::size_t count)
{
  std::vector<std::int64_t> ends(count + 1, 0);
  for (const std::int32_t piece : pieces)
  {
    ends[std::size_t(std::int64_t(piece) + 1)] += 1; // the first entry counts items without a piece
  }
  ends[0] = 0;
  PieceGroups result;
  for (std::size_t p = 0; p < count; ++p)
  {
    const std::int64_t begin = ends[p];
    const std::int64_t end = begin + std::exchange(ends[p + 1], begin + ends[p + 1]);
    end > begin ? result.Groups.push_back({ p, begin, end }) : void();
  }
  result.Items.resize(std::size_t(ends[count]));
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (pieces[i] >= 0)
    {
      result.Items[std::size_t(ends[std::size_t(pieces[i])]++)] = std::int64_t(i);
    }
  }
  return result;
}

/// Evaluates arrays at points in a part of the mesh. locate(take) locates the points and passes the
/// locations to take(); its result is returned.
bool ResidentMesh::answerPart(const MeshPart& part, const AskedPoints& asked,
  const AnswerOptions& options, const Locate& locate, MeshAnswer& answer) const
{
  std::vector<PartValues> values;
  for (const std::string& name : options.Arrays)
  {
    values.emplace_back(part, this->find(name));
  }
  const auto corners = std::size_t(this->Mesh.CellSize);
  return locate(
    [&](const std::int64_t* points, const CellLocation* at, std::int64_t count)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        const auto index = std::size_t(points[i]);
        answer.Cells[index] = part.cellId(at[i].Cell);
        if (options.Weights)
        {
          std::copy_n(at[i].Weights, corners, answer.Weights.data() + index * corners);
        }
        if (options.Keys)
        {
          answer.Keys[index] = keyAt(part.Mesh, at[i].Cell, asked.Points[index]);
        }
      }
      for (std::size_t a = 0; a < values.size(); ++a)
      {
        values[a].sample(at, points, count, answer.Arrays[a].Values.data());
      }
    });
}

/// Answers with a pass over all cells. Returns false if this is not the fastest method; then
/// `answer` may already have some points.
bool ResidentMesh::answerInOnePass(const MeshPart& part, const AskedPoints& asked,
  const AnswerOptions& options, int threads, MeshAnswer& answer) const
{
  if (asked.Count <= part.Mesh.Cells / cellsPerPointOfPass)
  {
    return false;
  }
  const ResidentPieces::Share memory =
    this->Resident.note(std::uint64_t(asked.Count) * bytesOfPass);
  return this->answerPart(
    part, asked, options,
    [&](const TakeLocations& take)
    { return locateInOnePass(part.Mesh, part.CellIds, asked, threads, take); },
    answer);
}

/// Answers with a locator or, if it is null, by searching the cells.
void ResidentMesh::answerBy(const CellLocator* locator, const MeshPart& part,
  const AskedPoints& asked, const AnswerOptions& options, int threads, MeshAnswer& answer) const
{
  this->answerPart(
    part, asked, options,
    [&](const TakeLocations& take)
    {
      locatePoints(part.Mesh, part.CellIds, locator, asked, threads, take);
      return true;
    },
    answer);
}

/// Whether to read only the cells near the points instead of the whole piece. `mayStay` says
/// whether all pieces of this query fit into memory together.
bool ResidentMesh::wantsNear(
  std::size_t number, const PieceNeeds& needs, const AskedPoints& asked, bool mayStay) const
{
  if (this->InMemory || this->Resident.isResident(number, needs) ||
    (this->Resident.countQuestion(number) >= searchesWithoutLocator && mayStay))
  {
    return false;
  }
  const PieceSummary& piece = this->Mesh.Pieces[number];
  return asked.Count <= (piece.Cells + piece.BorrowedCells) / cellsPerPoint ||
    (this->Mesh.CellSize == 3 ? areNarrow<2>(asked, piece.Box) : areNarrow<3>(asked, piece.Box));
}

/// Reads only the cells near the points and answers with them. Returns false, without any answer,
/// if there are too many such cells or too little memory.
bool ResidentMesh::answerNear(std::size_t number, const PieceNeeds& needs, const AskedPoints& asked,
  const AnswerOptions& options, int threads, MeshAnswer& answer) const
{
  const PieceSummary& piece = this->Mesh.Pieces[number];
  const std::int64_t most = piece.Cells / cellsPerNearOne + 256;
  const std::optional<ResidentPieces::Share> memory =
    this->Resident.take(this->estimateNear(number, needs, most, asked.Count));
  if (!memory)
  {
    return false;
  }
  PieceOptions reading;
  reading.Step = this->Options.Step;
  reading.Wanted = needs.Arrays;
  reading.Cells = nearCells(this->Mesh, asked, most);
  Piece near = readPiece(this->Mesh, number, reading);
  reading.Cells = nullptr;
  if (near.IsStopped)
  {
    return false;
  }
  const MeshPart part = partOf(std::move(near));
  if (!this->answerInOnePass(part, asked, options, threads, answer))
  {
    std::optional<CellLocator> locator;
    asked.Count > part.Mesh.Cells / cellsPerPoint
      ? void(locator.emplace(part.Mesh, part.CellIds, threads))
      : void();
    this->answerBy(locator ? &*locator : nullptr, part, asked, options, threads, answer);
  }
  return true;
}

void ResidentMesh::answerPiece(std::size_t number, const AskedPoints& asked,
  const AnswerOptions& options, int threads, bool mayStay, MeshAnswer& answer) const
{
  PieceNeeds needs = this->needsOf(options.Arrays);
  if (this->wantsNear(number, needs, asked, mayStay) &&
    this->answerNear(number, needs, asked, options, threads, answer))
  {
    return;
  }
  const PieceSummary& summary = this->Mesh.Pieces[number];
  const std::int64_t cells = summary.Cells + summary.BorrowedCells;
  if (asked.Count > cells / cellsPerPointOfPass)
  {
    const ResidentPieces::Lease piece = this->Resident.get(number, needs);
    if (this->answerInOnePass(*piece->Part, asked, options, threads, answer))
    {
      return;
    }
  }
  needs.Locator = true;
  needs.Locator = this->Resident.fits(number, needs) &&
    (asked.Count > cells / cellsPerPoint || this->Resident.uses(number) >= searchesWithoutLocator);
  const ResidentPieces::Lease piece = this->Resident.get(number, needs);
  this->answerBy(piece->Locator.get(), *piece->Part, asked, options, threads, answer);
}

MeshAnswer ResidentMesh::answer(const Point3* points, std::int64_t count,
  const AnswerOptions& options, std::vector<std::int32_t> pieceOf) const
{
  if (count > std::numeric_limits<std::int32_t>::max())
  {
    throw IOError("More than 2147483647 points are asked for at once; ask in parts.");
  }
  std::vector<StoredArray> arrays;
  std::uint64_t bytes = 3 * sizeof(std::int64_t); // a point, its index and its piece
  bytes += options.Weights ? std::uint64_t(this->Mesh.CellSize) * sizeof(double) : 0;
  bytes += options.Keys ? sizeof(CellKey) : 0;
  for (const std::string& name : options.Arrays)
  {
    const StoredArray* const array = this->find(name);
    arrays.push_back(array ? *array : StoredArray());
    arrays.back().Type = array ? array->Type : this->Mesh.PointType;
    arrays.back().Name = name;
    bytes += std::uint64_t(arrays.back().Components) * scalarSize(arrays.back().Type);
  }
  const ResidentPieces::Share memory = this->Resident.note(std::uint64_t(count) * bytes);
  MeshAnswer answer =
    emptyAnswer(count, arrays, this->Mesh.CellSize, options.Weights, options.Keys);
  const int threads = threadCount(this->Options.Threads);
  if (this->InMemory)
  {
    this->answerPiece(0, { points, nullptr, count }, options, threads, true, answer);
    return answer;
  }
  pieceOf = pieceOf.empty() ? this->piecesOf(points, count) : std::move(pieceOf);
  PieceGroups groups = groupByPiece(pieceOf, this->Mesh.Pieces.size());
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
  const auto pieces = std::int64_t(groups.Groups.size());
  // If there are many pieces, each thread processes a piece at a time. Otherwise all threads share
  // the points of one piece after the other.
  const bool manyPieces = pieces >= 2 * threads;
  forChunks(pieces, 1, manyPieces ? threads : 1, {},
    [&](std::int64_t g, std::int64_t, int)
    {
      poll();
      const PieceGroups::Group& group = groups.Groups[std::size_t(g)];
      this->answerPiece(group.Piece,
        { points, groups.Items.data() + group.Begin, group.End - group.Begin }, options,
        manyPieces ? 1 : threads, mayStay, answer);
    });
  return answer;
}

} // namespace tipp

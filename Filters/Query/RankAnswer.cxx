// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankAnswer.h"

#include "Files/IOError.h"
#include "Resident/ForPieces.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <type_traits>

namespace tipp
{
namespace
{

/// For each rank, the indices of this rank's points to send to it.
std::vector<std::vector<std::int64_t>> shareOut(const Communicator& communicator,
  const ResidentMesh& mesh, const std::vector<RankPart>& parts,
  const std::vector<std::int32_t>& pieceOf, const Point3* points, std::int64_t count)
{
  std::vector<std::vector<std::int64_t>> asked(parts.size());
  const auto forAsked = [&](const auto& work)
  {
    for (std::int64_t i = 0; i < count; ++i)
    {
      const std::int64_t piece = mesh.isStored() ? pieceOf[std::size_t(i)] : -1;
      if (piece >= 0)
      {
        work(rankOfPiece(communicator, mesh, piece), i);
      }
      for (std::size_t rank = 0; rank < parts.size() && !mesh.isStored(); ++rank)
      {
        const RankPart& part = parts[rank];
        if (part.CellSize != 0 && contains(part.Domain, points[i], part.CellSize - 1))
        {
          work(rank, i);
        }
      }
    }
  };
  std::vector<std::size_t> counts(parts.size(), 0);
  forAsked([&](std::size_t rank, std::int64_t) { counts[rank] += 1; });
  for (std::size_t rank = 0; rank < parts.size(); ++rank)
  {
    asked[rank].reserve(counts[rank]);
  }
  forAsked([&](std::size_t rank, std::int64_t i) { asked[rank].push_back(i); });
  return asked;
}

/// One of the arrays of a MeshAnswer. The order is: cells, keys (if there are any), weights,
/// values.
struct Column
{
  const char* Values;
  std::size_t Width; ///< bytes per point
};

/// The first `count` rows of the columns, column by column.
Bytes messageOf(const std::vector<Column>& columns, std::size_t count)
{
  const std::size_t width = std::accumulate(columns.begin(), columns.end(), std::size_t(0),
    [](std::size_t sum, const Column& column) { return sum + column.Width; });
  Bytes message(width * count);
  char* to = message.data();
  for (const Column& column : columns)
  {
    to = std::copy_n(column.Values, column.Width * count, to);
  }
  return message;
}

/// The columns in a message, with the widths of `columns`. Throws IOError if the message has
/// another size.
std::vector<Column> columnsIn(const Bytes& message, std::vector<Column> columns, std::size_t count)
{
  std::size_t at = 0;
  for (Column& column : columns)
  {
    column.Values = message.data() + at;
    at += column.Width * count;
  }
  if (at != message.size())
  {
    throw IOError("Another rank's answer does not have the points that it was asked for.");
  }
  return columns;
}

std::uint64_t numberAt(const Column& column, std::size_t row)
{
  std::uint64_t number;
  std::memcpy(&number, column.Values + row * sizeof number, sizeof number);
  return number;
}

/// Copies row rows[i] of a column to row to[i] of `values`.
void copyRows(const Column& column, const std::vector<std::size_t>& rows,
  const std::vector<std::size_t>& to, char* values)
{
  const auto copyAll = [&](auto width)
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      std::memcpy(values + to[i] * width, column.Values + rows[i] * width, width);
    }
  };
  column.Width == sizeof(double) ? copyAll(std::integral_constant<std::size_t, sizeof(double)>())
                                 : copyAll(column.Width);
}

/// Copies a rank's answers for the points `asked` to the columns `to` of `answer`, where they are
/// better than the answers there.
void merge(const std::vector<Column>& from, const std::vector<std::int64_t>& asked,
  const std::vector<Column>& to, MeshAnswer& answer)
{
  const bool hasKeys = !answer.Keys.empty();
  constexpr std::size_t block = 1024; // rows; these stay in the processor's cache
  std::vector<std::size_t> rows;
  std::vector<std::size_t> points;
  for (std::size_t begin = 0; begin < asked.size(); begin += block)
  {
    rows.clear();
    points.clear();
    for (std::size_t i = begin; i < std::min(begin + block, asked.size()); ++i)
    {
      const auto at = std::size_t(asked[i]);
      const auto cell = std::int64_t(numberAt(from[0], i));
      const bool isBetter = answer.Cells[at] < 0 ||
        (hasKeys &&
          std::make_pair(CellKey(numberAt(from[1], i)), cell) <
            std::make_pair(answer.Keys[at], answer.Cells[at]));
      if (cell >= 0 && isBetter)
      {
        rows.push_back(i);
        points.push_back(at);
      }
    }
    for (std::size_t k = 0; k < from.size(); ++k)
    {
      copyRows(from[k], rows, points, const_cast<char*>(to[k].Values));
    }
  }
}

/// Sends the points of all ranks to the ranks that may have their cells, and answers the received
/// points.
class PointsOnRanks
{
public:
  PointsOnRanks(Communicator& ranks, const ResidentMesh& mesh, const Point3* points,
    std::int64_t count, const AnswerOptions& options)
    : Options(options)
  {
    const RankParts parts(&ranks, mesh, options.Arrays);
    this->Common = parts.Common;
    const std::int64_t firstCell = parts.firstCell(ranks, mesh);
    // With a stored mesh, each point is sent to only one rank, so no keys are needed.
    this->HasKeys = options.Keys || !mesh.isStored();
    this->Own = std::size_t(ranks.rank());
    const std::vector<std::int32_t> pieces =
      mesh.isStored() ? mesh.piecesOf(points, count) : std::vector<std::int32_t>();
    this->Asked = shareOut(ranks, mesh, parts.All, pieces, points, count);
    this->receive(ranks, mesh.isStored(), pieces, points);
    AnswerOptions wanted = options;
    wanted.Keys = this->HasKeys;
    this->Found = this->Received.empty()
      ? this->emptyAnswer(0)
      : mesh.answer(this->Received.data(), std::int64_t(this->Received.size()), wanted,
          std::move(this->Pieces));
    for (std::int64_t& cell : this->Found.Cells)
    {
      cell += cell >= 0 ? firstCell : 0;
    }
  }

  /// What each rank has found for this rank's points, in the order of Asked.
  struct Replies
  {
    std::vector<Bytes> Messages;
    std::vector<std::vector<Column>> OfRanks;
  };
  Replies exchange(Communicator& ranks, bool withValues) const
  {
    const auto columnsFor = [&](std::size_t rank)
    {
      std::vector<Column> columns = this->columnsOf(this->Found, this->Begins[rank]);
      columns.resize(withValues ? columns.size() : this->HasKeys ? 2 : 1);
      return columns;
    };
    std::vector<Bytes> messages(this->Asked.size());
    for (std::size_t rank = 0; rank < messages.size(); ++rank)
    {
      messages[rank] = rank == this->Own
        ? Bytes()
        : messageOf(columnsFor(rank), this->Begins[rank + 1] - this->Begins[rank]);
    }
    Replies replies;
    replies.Messages = ranks.allToAll(std::move(messages));
    for (std::size_t rank = 0; rank < this->Asked.size(); ++rank)
    {
      replies.OfRanks.push_back(rank == this->Own
          ? columnsFor(rank)
          : columnsIn(replies.Messages[rank], columnsFor(rank), this->Asked[rank].size()));
    }
    return replies;
  }

  /// The columns of an answer, beginning at point `first`.
  std::vector<Column> columnsOf(const MeshAnswer& answer, std::size_t first) const
  {
    std::vector<Column> columns;
    const auto add = [&](const auto* values, std::size_t width) {
      columns.push_back({ reinterpret_cast<const char*>(values) + first * width, width });
    };
    add(answer.Cells.data(), sizeof(std::int64_t));
    if (this->HasKeys)
    {
      add(answer.Keys.data(), sizeof(CellKey));
    }
    if (this->Options.Weights)
    {
      add(answer.Weights.data(), std::size_t(this->Common.CellSize) * sizeof(double));
    }
    for (const MeshAnswer::Array& array : answer.Arrays)
    {
      add(array.Values.data(), array.tupleBytes());
    }
    return columns;
  }

  MeshAnswer emptyAnswer(std::int64_t count) const
  {
    return tipp::emptyAnswer(
      count, this->Common.Arrays, this->Common.CellSize, this->Options.Weights, this->HasKeys);
  }

  /// For each rank, the indices of this rank's points that were sent to it.
  std::vector<std::vector<std::int64_t>> Asked;
  Buffer<Point3> Received;
  std::vector<std::size_t> Begins; ///< index of each rank's first point among the received ones
  MeshAnswer Found;                ///< the answers for the received points

private:
  /// Sends this rank's points to other ranks, and receives theirs; for a stored mesh also the
  /// pieces of the points. Received parts are written directly to their destination: another copy
  /// to newly allocated memory would take longest of all.
  void receive(Communicator& ranks, bool withPieces, const std::vector<std::int32_t>& pieces,
    const Point3* points)
  {
    const std::size_t width = sizeof(Point3) + (withPieces ? sizeof(std::int32_t) : 0);
    std::vector<std::int64_t> counts;
    std::vector<Communicator::ByteRange> byteRanges;
    std::size_t size = 0;
    for (std::size_t rank = 0; rank < this->Asked.size(); ++rank)
    {
      counts.push_back(std::int64_t(this->Asked[rank].size()));
      byteRanges.push_back({ size, rank == this->Own ? 0 : this->Asked[rank].size() * width });
      size += byteRanges.back().Size;
    }
    this->Begins = { 0 };
    for (const std::int64_t count : ranks.allToAll(counts))
    {
      this->Begins.push_back(this->Begins.back() + std::size_t(count));
    }
    this->Received = Buffer<Point3>(this->Begins.back());
    this->Pieces.resize(withPieces ? this->Begins.back() : 0);
    Bytes memory(size);
    for (std::size_t rank = 0; rank < this->Asked.size(); ++rank)
    {
      const std::size_t begin = this->Begins[rank];
      char* const message = memory.data() + byteRanges[rank].Begin;
      rank == this->Own
        ? this->pack(rank, points, pieces, this->pointBytes(begin), this->pieceBytes(begin))
        : this->pack(
            rank, points, pieces, message, message + this->Asked[rank].size() * sizeof(Point3));
    }
    std::vector<std::size_t> done(this->Asked.size(), 0);
    ranks.allToAllInParts(std::move(memory), byteRanges,
      [&](int from, const char* part, std::size_t bytes)
      {
        const auto rank = std::size_t(from);
        const std::size_t begin = this->Begins[rank];
        const std::size_t ofPoints = (this->Begins[rank + 1] - begin) * sizeof(Point3);
        const std::size_t at = std::exchange(done[rank], done[rank] + bytes);
        const std::size_t first = at < ofPoints ? std::min(bytes, ofPoints - at) : 0;
        std::copy_n(part, first, this->pointBytes(begin) + (first > 0 ? at : 0));
        std::copy_n(part + first, bytes - first,
          this->pieceBytes(begin) + (bytes > first ? at + first - ofPoints : 0));
      });
  }

  /// Writes the points for a rank to `to`, and their pieces, if there are any, to `toPieces`.
  void pack(std::size_t rank, const Point3* points, const std::vector<std::int32_t>& pieces,
    char* to, char* toPieces) const
  {
    const std::vector<std::int64_t>& asked = this->Asked[rank];
    for (std::size_t k = 0; k < asked.size(); ++k)
    {
      std::memcpy(to + k * sizeof(Point3), points + asked[k], sizeof(Point3));
      if (!pieces.empty())
      {
        std::memcpy(toPieces + k * sizeof(std::int32_t), &pieces[std::size_t(asked[k])],
          sizeof(std::int32_t));
      }
    }
  }

  char* pointBytes(std::size_t i) { return reinterpret_cast<char*>(this->Received.data() + i); }
  char* pieceBytes(std::size_t i) { return reinterpret_cast<char*>(this->Pieces.data() + i); }

  const AnswerOptions& Options;
  RankPart Common;
  bool HasKeys = false;
  std::size_t Own = 0;              ///< this rank
  std::vector<std::int32_t> Pieces; ///< the pieces of the received points, for a stored mesh
};

/// Chooses the rank that keeps the answer of each of this rank's points. Returns, for each rank and
/// each point sent to it, whether it is the chosen one.
std::vector<std::vector<char>> chooseRanks(const std::vector<std::vector<std::int64_t>>& asked,
  const std::vector<std::vector<Column>>& replies, std::int64_t count)
{
  const bool hasKeys = replies[0].size() > 1;
  MeshAnswer best;
  best.Cells.assign(std::size_t(count), -1);
  best.Keys.assign(hasKeys ? std::size_t(count) : 0, noCellKey);
  const std::vector<Column> columns = { { reinterpret_cast<const char*>(best.Cells.data()),
                                          sizeof(std::int64_t) },
    { reinterpret_cast<const char*>(best.Keys.data()), sizeof(CellKey) } };
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
  {
    merge(replies[rank], asked[rank], columns, best);
  }
  std::vector<std::vector<char>> chosen(asked.size());
  for (std::size_t rank = 0; rank < asked.size(); ++rank)
  {
    for (std::size_t i = 0; i < asked[rank].size(); ++i)
    {
      const auto at = std::size_t(asked[rank][i]);
      const bool isBest = best.Cells[at] >= 0 &&
        best.Cells[at] == std::int64_t(numberAt(replies[rank][0], i)) &&
        (!hasKeys || best.Keys[at] == CellKey(numberAt(replies[rank][1], i)));
      best.Cells[at] = isBest ? -1 : best.Cells[at]; // no other rank is chosen
      chosen[rank].push_back(char(isBest));
    }
  }
  return chosen;
}

} // namespace

std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator* ranks, const ResidentMesh& mesh)
{
  const std::size_t pieces = mesh.mesh().Pieces.size();
  if (!areSeveral(ranks) || !mesh.isStored())
  {
    return { 0, pieces };
  }
  // The inverse of rankOfPiece().
  const auto size = std::size_t(ranks->size());
  const auto firstOf = [&](std::size_t rank) { return (rank * pieces + size - 1) / size; };
  return { firstOf(std::size_t(ranks->rank())), firstOf(std::size_t(ranks->rank()) + 1) };
}

std::size_t rankOfPiece(const Communicator& ranks, const ResidentMesh& mesh, std::int64_t piece)
{
  return std::size_t(piece * ranks.size() / std::int64_t(mesh.mesh().Pieces.size()));
}

void requireIds(Communicator* ranks, const ResidentMesh& mesh)
{
  if (!areSeveral(ranks))
  {
    return;
  }
  const bool hasCells = mesh.mesh().Cells > 0;
  bool hasIds = true;
  if (hasCells && !mesh.isStored())
  {
    const ResidentPieces::Lease piece = mesh.pieces().get(0, {});
    hasIds = piece->Part->CellIds && piece->Part->PointIds;
  }
  std::vector<std::int64_t> sums = { hasCells ? 1 : 0, hasIds ? 0 : 1 };
  ranks->sum(sums);
  if (sums[0] > 1 && sums[1] > 0)
  {
    throw IOError("A rank's part of the mesh has no global ids of points and cells, which this "
                  "query needs; make them, as by vtkGenerateGlobalIds.");
  }
}

RankParts::RankParts(
  Communicator* ranks, const ResidentMesh& mesh, const std::vector<std::string>& arrays)
{
  RankPart own;
  own.Cells = mesh.mesh().Cells;
  own.Domain = mesh.mesh().Domain;
  if (canQuery(ranks, mesh))
  {
    own.CellSize = mesh.mesh().CellSize;
    own.Arrays = mesh.describe(arrays);
  }
  this->All = areSeveral(ranks) ? ranks->allGather(own) : std::vector<RankPart>{ own };
  const auto areAlike = [](const StoredArray& a, const StoredArray& b)
  { return a.Type == b.Type && a.Components == b.Components; };
  for (const RankPart& part : this->All)
  {
    if (part.CellSize != 0 && this->Common.CellSize != 0 &&
      (part.CellSize != this->Common.CellSize ||
        !std::equal(part.Arrays.begin(), part.Arrays.end(), this->Common.Arrays.begin(),
          this->Common.Arrays.end(), areAlike)))
    {
      throw IOError("The ranks' parts of the mesh differ in their type of cells or arrays.");
    }
    this->Common = this->Common.CellSize != 0 ? this->Common : part;
  }
}

std::int64_t RankParts::firstCell(const Communicator& ranks, const ResidentMesh& mesh) const
{
  const auto end = this->All.begin() + (mesh.hasCellIds() ? 0 : ranks.rank());
  return std::accumulate(this->All.begin(), end, std::int64_t(0),
    [](std::int64_t sum, const RankPart& part) { return sum + part.Cells; });
}

MeshAnswer answerOnRanks(Communicator& ranks, const ResidentMesh& mesh, const Point3* points,
  std::int64_t count, const AnswerOptions& options)
{
  const PointsOnRanks questions(ranks, mesh, points, count, options);
  const PointsOnRanks::Replies replies = questions.exchange(ranks, true);
  MeshAnswer answer = questions.emptyAnswer(count);
  const std::vector<Column> columns = questions.columnsOf(answer, 0);
  for (std::size_t rank = 0; rank < replies.OfRanks.size(); ++rank)
  {
    merge(replies.OfRanks[rank], questions.Asked[rank], columns, answer);
  }
  if (!options.Keys)
  {
    answer.Keys.clear();
  }
  return answer;
}

StayingAnswer answerWhereCellsAre(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options)
{
  const PointsOnRanks questions(ranks, mesh, points, count, options);
  const PointsOnRanks::Replies replies = questions.exchange(ranks, false);
  const std::vector<std::vector<char>> chosen =
    ranks.allToAll(chooseRanks(questions.Asked, replies.OfRanks, count));
  const std::vector<std::vector<std::int64_t>> indices = ranks.allToAll(questions.Asked);

  StayingAnswer result;
  std::vector<std::size_t> kept; // indices of received points
  for (std::size_t rank = 0; rank < chosen.size(); ++rank)
  {
    for (std::size_t i = 0; i < chosen[rank].size(); ++i)
    {
      if (chosen[rank][i])
      {
        kept.push_back(questions.Begins[rank] + i);
        result.Ranks.push_back(std::int64_t(rank));
        result.Indices.push_back(indices[rank][i]);
        result.Points.push_back(questions.Received[kept.back()]);
      }
    }
  }
  result.Answer = questions.emptyAnswer(std::int64_t(kept.size()));
  std::vector<std::size_t> rows(kept.size());
  std::iota(rows.begin(), rows.end(), std::size_t(0));
  const std::vector<Column> from = questions.columnsOf(questions.Found, 0);
  const std::vector<Column> to = questions.columnsOf(result.Answer, 0);
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    copyRows(from[k], kept, rows, const_cast<char*>(to[k].Values));
  }
  if (!options.Keys)
  {
    result.Answer.Keys.clear();
  }
  return result;
}

} // namespace tipp

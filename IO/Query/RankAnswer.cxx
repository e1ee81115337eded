// SPDX-License-Identifier: BSD-3-Clause
#include "Query/RankAnswer.h"

#include "Files/IOError.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tipp
{
namespace
{

/// What each rank knows about another rank's part of the mesh.
struct RankPart
{
  int CellSize = 0; ///< 0 if it has no cells
  bool HasIds = false;
  std::int64_t Cells = 0;
  Bounds Domain{};
  std::vector<Scalar> Types; ///< types of the requested arrays
  std::vector<int> Components;
};

template <typename Archive>
void serialize(Archive& archive, RankPart& part)
{
  archive(part.CellSize, part.HasIds, part.Cells, part.Domain, part.Types, part.Components);
}

RankPart describe(const ResidentMesh& mesh, const AnswerOptions& options)
{
  RankPart part;
  part.Cells = mesh.mesh().Cells;
  part.HasIds = mesh.hasCellIds();
  part.Domain = mesh.mesh().Domain;
  if (part.Cells > 0)
  {
    part.CellSize = mesh.mesh().CellSize;
    for (const std::string& name : options.Arrays)
    {
      const StoredArray* const array = mesh.find(name);
      part.Types.push_back(array ? array->Type : mesh.mesh().PointType);
      part.Components.push_back(array ? array->Components : 1);
    }
  }
  return part;
}

/// The description that all parts with cells have in common. Throws IOError if they differ.
RankPart commonPart(const std::vector<RankPart>& parts)
{
  RankPart common;
  for (const RankPart& part : parts)
  {
    const auto kind = [](const RankPart& p) { return std::tie(p.CellSize, p.Types, p.Components); };
    if (part.CellSize != 0 && common.CellSize != 0 && kind(common) != kind(part))
    {
      throw IOError("The ranks' parts of the mesh differ in their type of cells or arrays.");
    }
    common = common.CellSize != 0 ? common : part;
  }
  return common;
}

bool holds(const RankPart& part, const Point3& p)
{
  const Bounds& b = part.Domain;
  return part.CellSize != 0 && b[0] <= p.x && p.x <= b[1] && b[2] <= p.y && p.y <= b[3] &&
    (part.CellSize == 3 || (b[4] <= p.z && p.z <= b[5]));
}

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
      piece >= 0 ? work(rankOfPiece(communicator, mesh, piece), i) : void();
      for (std::size_t rank = 0; rank < parts.size() && !mesh.isStored(); ++rank)
      {
        holds(parts[rank], points[i]) ? work(rank, i) : void();
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
    const std::vector<RankPart> parts = ranks.allGather(describe(mesh, options));
    this->Common = commonPart(parts);
    for (int rank = 0; rank < ranks.rank() && !mesh.isStored(); ++rank)
    {
      this->FirstCell += parts[std::size_t(rank)].Cells;
    }
    this->FirstCell = mesh.hasCellIds() ? 0 : this->FirstCell;
    // With a stored mesh, each point is sent to only one rank, so no keys are needed.
    this->HasKeys = options.Keys || !mesh.isStored();
    this->Own = std::size_t(ranks.rank());
    const std::vector<std::int32_t> pieces =
      mesh.isStored() ? mesh.piecesOf(points, count) : std::vector<std::int32_t>();
    this->Asked = shareOut(ranks, mesh, parts, pieces, points, count);
    this->receive(ranks, mesh.isStored(), pieces, points);
    AnswerOptions wanted = options;
    wanted.Keys = this->HasKeys;
    this->Found = this->Received.empty()
      ? this->emptyAnswer(0)
      : mesh.answer(this->Received.data(), std::int64_t(this->Received.size()), wanted,
          std::move(this->Pieces));
    for (std::int64_t& cell : this->Found.Cells)
    {
      cell += cell >= 0 ? this->FirstCell : 0;
    }
  }

  /// For each rank, the indices of this rank's points that were sent to it.
  const std::vector<std::vector<std::int64_t>>& asked() const { return this->Asked; }
  const Buffer<Point3>& received() const { return this->Received; }
  const MeshAnswer& found() const { return this->Found; }
  /// The index of a rank's first point among the received ones.
  std::size_t begin(std::size_t rank) const { return this->Begins[rank]; }

  /// What each rank has found for this rank's points, in the order of asked().
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
    this->HasKeys ? add(answer.Keys.data(), sizeof(CellKey)) : void();
    this->Options.Weights
      ? add(answer.Weights.data(), std::size_t(this->Common.CellSize) * sizeof(double))
      : void();
    for (const MeshAnswer::Array& array : answer.Arrays)
    {
      add(array.Values.data(), array.tupleBytes());
    }
    return columns;
  }

  MeshAnswer emptyAnswer(std::int64_t count) const
  {
    std::vector<StoredArray> arrays(this->Common.Types.size());
    for (std::size_t a = 0; a < arrays.size(); ++a)
    {
      arrays[a].Name = this->Options.Arrays[a];
      arrays[a].Type = this->Common.Types[a];
      arrays[a].Components = this->Common.Components[a];
    }
    return tipp::emptyAnswer(
      count, arrays, this->Common.CellSize, this->Options.Weights, this->HasKeys);
  }

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
  std::size_t Own = 0; ///< this rank
  std::int64_t FirstCell = 0;
  std::vector<std::vector<std::int64_t>> Asked;
  Buffer<Point3> Received;
  std::vector<std::int32_t> Pieces; ///< the pieces of the received points, for a stored mesh
  std::vector<std::size_t> Begins;
  MeshAnswer Found;
};

/// Chooses the rank that keeps the answer of each of this rank's points. Returns, for each rank and
/// each point sent to it, whether it is the chosen one.
std::vector<std::vector<char>> chooseRanks(const std::vector<std::vector<std::int64_t>>& asked,
  const std::vector<std::vector<Column>>& replies, std::int64_t count)
{
  struct Best
  {
    CellKey Key;
    std::int64_t Cell = -1;
    std::size_t Rank = 0;
  };
  std::vector<Best> best(static_cast<std::size_t>(count));
  const auto forReplies = [&](const auto& work)
  {
    for (std::size_t rank = 0; rank < asked.size(); ++rank)
    {
      for (std::size_t i = 0; i < asked[rank].size(); ++i)
      {
        work(rank, i, best[std::size_t(asked[rank][i])]);
      }
    }
  };
  forReplies(
    [&](std::size_t rank, std::size_t i, Best& so)
    {
      const std::vector<Column>& reply = replies[rank];
      const CellKey key = reply.size() > 1 ? CellKey(numberAt(reply[1], i)) : noCellKey;
      const auto cell = std::int64_t(numberAt(reply[0], i));
      if (cell >= 0 && (so.Cell < 0 || std::tie(key, cell) < std::tie(so.Key, so.Cell)))
      {
        so = { key, cell, rank };
      }
    });
  std::vector<std::vector<char>> chosen(asked.size());
  forReplies([&](std::size_t rank, std::size_t, const Best& so)
    { chosen[rank].push_back(char(so.Cell >= 0 && so.Rank == rank)); });
  return chosen;
}

} // namespace

std::pair<std::size_t, std::size_t> piecesOfRank(
  const Communicator& ranks, const ResidentMesh& mesh)
{
  if (!mesh.isStored())
  {
    return { 0, 1 };
  }
  // The inverse of rankOfPiece().
  const std::size_t pieces = mesh.mesh().Pieces.size();
  const auto size = std::size_t(ranks.size());
  const auto firstOf = [&](std::size_t rank) { return (rank * pieces + size - 1) / size; };
  return { firstOf(std::size_t(ranks.rank())), firstOf(std::size_t(ranks.rank()) + 1) };
}

std::size_t rankOfPiece(const Communicator& ranks, const ResidentMesh& mesh, std::int64_t piece)
{
  return std::size_t(piece * ranks.size() / std::int64_t(mesh.mesh().Pieces.size()));
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
    merge(replies.OfRanks[rank], questions.asked()[rank], columns, answer);
  }
  options.Keys ? void() : answer.Keys.clear();
  return answer;
}

StayingAnswer answerWhereCellsAre(Communicator& ranks, const ResidentMesh& mesh,
  const Point3* points, std::int64_t count, const AnswerOptions& options)
{
  const PointsOnRanks questions(ranks, mesh, points, count, options);
  const PointsOnRanks::Replies replies = questions.exchange(ranks, false);
  const std::vector<std::vector<char>> chosen =
    ranks.allToAll(chooseRanks(questions.asked(), replies.OfRanks, count));
  const std::vector<std::vector<std::int64_t>> indices = ranks.allToAll(questions.asked());

  StayingAnswer result;
  std::vector<std::size_t> kept; // indices of received points
  for (std::size_t rank = 0; rank < chosen.size(); ++rank)
  {
    for (std::size_t i = 0; i < chosen[rank].size(); ++i)
    {
      if (chosen[rank][i])
      {
        kept.push_back(questions.begin(rank) + i);
        result.Ranks.push_back(std::int64_t(rank));
        result.Indices.push_back(indices[rank][i]);
        result.Points.push_back(questions.received()[kept.back()]);
      }
    }
  }
  result.Answer = questions.emptyAnswer(std::int64_t(kept.size()));
  std::vector<std::size_t> rows(kept.size());
  std::iota(rows.begin(), rows.end(), std::size_t(0));
  const std::vector<Column> from = questions.columnsOf(questions.found(), 0);
  const std::vector<Column> to = questions.columnsOf(result.Answer, 0);
  for (std::size_t k = 0; k < from.size(); ++k)
  {
    copyRows(from[k], kept, rows, const_cast<char*>(to[k].Values));
  }
  options.Keys ? void() : result.Answer.Keys.clear();
  return result;
}

} // namespace tipp

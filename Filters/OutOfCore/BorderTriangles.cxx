// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/FinishPieces.h"

#include "Arrays/SortUnique.h"
#include "Files/FileSystem.h"
#include "Files/OutputFile.h"

#include <algorithm>

namespace tipp
{
namespace
{

/// Returns the path of an empty file that exists once the consumer has the piece's border.
std::string takenPath(const PieceWork& work, PartitionIndex piece)
{
  return work.resultPath(piece) + ".taken";
}

void takeMesh(
  const PieceWork& work, const std::string& name, PieceBorder& border, const ResultOf& results)
{
  setGhosts(work, results, border);
  const PieceBorder::Mesh mesh = border.mesh();
  work.Consumer->take(
    name, mesh.Rows.data(), work.Rows, mesh.Rows.size() / work.Rows.Words, { mesh.triangles() });
}

std::string borderName(const PieceWork& work, PartitionIndex piece)
{
  return std::to_string(work.Plan.number(piece)) + ".border";
}

} // namespace

PieceInterior readInterior(const PieceWork& work, PartitionIndex piece, const StoredResult& result)
{
  PieceInterior interior = result.readInterior();
  interior.First = work.Points.starts()[std::size_t(piece)];
  interior.OwnPoints = work.Points.count(piece);
  return interior;
}

void visitBorderRows(const PieceWork& work, const std::vector<std::int64_t>& points,
  const ResultOf& results, const std::function<void(std::int64_t, const double*)>& visit)
{
  const std::vector<std::int64_t>& starts = work.Points.starts();
  PartitionIndex piece = -1;
  PieceInterior owner;
  for (const std::int64_t point : points)
  {
    const auto of = static_cast<PartitionIndex>(
      std::upper_bound(starts.begin(), starts.end(), point) - starts.begin() - 1);
    if (of != piece)
    {
      piece = of;
      owner = readInterior(work, piece, results(piece));
    }
    visit(point, owner.interfaceRow(point, work.Rows));
  }
}

void setGhosts(const PieceWork& work, const ResultOf& results, PieceBorder& border)
{
  std::vector<std::int64_t> ghosts = border.ghosts();
  std::sort(ghosts.begin(), ghosts.end());
  visitBorderRows(work, ghosts, results,
    [&](std::int64_t point, const double* row) { border.setGhost(point, row); });
}

void takeTriangles(const PieceWork& work, const std::string& name, const BordersByOwner& triangles,
  const ResultOf& results)
{
  const PieceInterior none;
  PieceBorder border(none, work.Rows);
  for (const auto& [owner, those] : triangles)
  {
    for (const std::array<std::int64_t, 3>& corners : those.Corners)
    {
      border.addTriangle(corners, {});
    }
  }
  takeMesh(work, name, border, results);
}

void takeBorder(const PieceWork& work, PartitionIndex piece, const ResultOf& results)
{
  BordersByOwner borders;
  for (PartitionIndex owner = 0; owner < work.Plan.pieces(); ++owner)
  {
    if (results(piece).hasBorder(owner))
    {
      borders.emplace(owner, results(piece).readBorder(owner));
    }
  }
  takeTriangles(work, borderName(work, piece), borders, results);
  OutputFile(takenPath(work, piece)).close();
}

void takeBorder(
  const PieceWork& work, PartitionIndex piece, PieceBorder& border, const ResultOf& results)
{
  takeMesh(work, borderName(work, piece), border, results);
}

bool isBorderTaken(const PieceWork& work, PartitionIndex piece)
{
  return pathExists(takenPath(work, piece));
}

BorderQueue::BorderQueue(const PiecePlan& plan, const PartitionOrder& order)
  : Neighbours(std::size_t(plan.pieces()))
  , Open(std::size_t(plan.pieces()))
{
  for (PartitionIndex piece = 0; piece < plan.pieces(); ++piece)
  {
    std::vector<PartitionIndex>& those = this->Neighbours[std::size_t(piece)];
    those.push_back(piece);
    const PartitionIndex end = plan.FirstPartition[std::size_t(piece) + 1];
    for (PartitionIndex p = plan.FirstPartition[std::size_t(piece)]; p < end; ++p)
    {
      if (order.isTotal())
      {
        continue; // finishPieces() passes their borders on
      }
      for (const PartitionIndex q : order.conflicts().neighbours(p))
      {
        those.push_back(plan.PieceOf[std::size_t(q)]);
      }
    }
    sortUnique(those);
    this->Open[std::size_t(piece)] = those.size() + (order.isTotal() ? 1 : 0);
  }
}

std::vector<PartitionIndex> BorderQueue::setDone(PartitionIndex piece)
{
  std::vector<PartitionIndex> ready;
  for (const PartitionIndex other : this->Neighbours[std::size_t(piece)])
  {
    if (--this->Open[std::size_t(other)] == 0)
    {
      ready.push_back(other);
    }
  }
  return ready;
}

} // namespace tipp

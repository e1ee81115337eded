// SPDX-License-Identifier: BSD-3-Clause
#include "QueryRanksTesting.h"

#include "Query/RankMesh.h"
#include "Resident/ForPieces.h"

#include <numeric>

using namespace tipp;
using namespace tipp::test;

namespace
{

using Ids = std::vector<std::int64_t>;

class RankMeshTest : public QueryRanksTest
{
protected:
  /// Calls work(mesh) with a mesh of which each rank has every n-th cell.
  template <typename Work>
  void withMesh(const Work& work)
  {
    const ResidentMesh part(inMemory(this->Source, 0, this->Ranks.rank(), this->Ranks.size()));
    this->Ranks.together([&] { work(RankMesh(this->Ranks, part)); });
  }

  /// The ids of the cells at a point, ascending.
  Ids cellsAt(std::int64_t point) const
  {
    Ids cells;
    for (std::size_t i = 0; i < this->Source.Cells.size(); ++i)
    {
      if (this->Source.Cells[i] == point)
      {
        cells.push_back(std::int64_t(i) / this->Source.CellSize);
      }
    }
    return cells;
  }

  Ids allPoints() const
  {
    Ids points(this->Source.points());
    std::iota(points.begin(), points.end(), 0);
    return points;
  }

  const SourceMesh Source = makeSource(latticeTriangles(9, 0.3));
};

TEST_F(RankMeshTest, ThePieceOfAPointHasAllCellsThere)
{
  this->withMesh(
    [&](const RankMesh& mesh)
    {
      const Ids points = this->allPoints();
      const std::vector<std::int32_t> pieces = mesh.piecesAround(points);
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const auto piece = mesh.pieces().get(std::size_t(pieces[i]), topologyNeeded());
        const std::int64_t at = piece->Topology->findPoint(points[i]);
        ASSERT_GE(at, 0) << points[i];
        EXPECT_TRUE(piece->Part->owns(at)) << points[i];
        Ids cells;
        for (const std::int32_t cell : piece->Topology->cellsAt(at))
        {
          cells.push_back(piece->Part->cellId(cell));
        }
        std::sort(cells.begin(), cells.end());
        EXPECT_EQ(cells, this->cellsAt(points[i])) << points[i];
      }
    });
}

TEST_F(RankMeshTest, FetchesTheCellsAtAPointOnce)
{
  this->withMesh(
    [&](const RankMesh& mesh)
    {
      const std::vector<std::int32_t> pieces = mesh.piecesAround(this->allPoints());
      EXPECT_EQ(pieces, mesh.piecesAround(this->allPoints()));
    });
}

TEST_F(RankMeshTest, EachPointWithCellsIsOwnedByAPieceOfOneRank)
{
  this->withMesh(
    [&](const RankMesh& mesh)
    {
      std::vector<std::int64_t> owners(this->Source.points(), 0);
      const std::size_t pieces = mesh.addFirstShared();
      for (std::size_t number = 0; number < pieces; ++number)
      {
        const auto piece = mesh.pieces().get(number, topologyNeeded());
        for (std::int64_t point = 0; point < piece->Part->Mesh.PointCount; ++point)
        {
          const bool isOwn = piece->Part->owns(point) && !piece->Topology->cellsAt(point).empty();
          owners[std::size_t(piece->Part->pointId(point))] += isOwn ? 1 : 0;
        }
      }
      this->Ranks.sum(owners);
      Ids expected;
      for (const std::int64_t point : this->allPoints())
      {
        expected.push_back(this->cellsAt(point).empty() ? 0 : 1);
      }
      EXPECT_EQ(owners, expected);
    });
}

TEST_F(RankMeshTest, FindsTheLowestRankWhosePartHasAnId)
{
  this->withMesh(
    [&](const RankMesh& mesh)
    {
      const auto cells = std::int64_t(this->Source.cells());
      EXPECT_EQ(mesh.firstRanksOf({ 0, cells - 1, cells }, false),
        (std::vector<std::int32_t>{ 0, std::int32_t((cells - 1) % this->Ranks.size()), -1 }));
      // Each part has all points.
      const auto points = std::int64_t(this->Source.points());
      EXPECT_EQ(
        mesh.firstRanksOf({ points - 1, points }, true), (std::vector<std::int32_t>{ 0, -1 }));
    });
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "QueryRanksTesting.h"

#include "Query/Queries.h"

#include <algorithm>

using namespace tipp;
using namespace tipp::test;

namespace
{

class ZonesOnRanks : public QueryRanksTest
{
};

TEST_F(ZonesOnRanks, ShareTheCellsOfZones)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const ResidentMesh whole(inMemory(source));
  const Zone square = { { { { 0.1, 0.1 }, { 0.8, 0.2 }, { 0.7, 0.9 }, { 0.1, 0.8 } }, false },
    { { { 0.3, 0.3 }, { 0.4, 0.3 }, { 0.3, 0.4 } }, true } };
  const Zone corner = { { { { -1, -1 }, { 2, -1 }, { -1, 2 } }, false } };
  const Zone outside = { { { { 5, 5 }, { 6, 5 }, { 5, 6 } }, false } };
  const std::vector<Zone> zones = { square, corner, outside };
  const auto expectAsAlone = [&](const ResidentMesh& mesh)
  {
    this->Ranks.together(
      [&]
      {
        for (const char* const array : { "value", "label" })
        {
          const ZoneStatistics expected = statisticsOf(whole, zones, array, 0, 0.25);
          // Zones of other ranks than the first are ignored.
          const ZoneStatistics found = statisticsOf(mesh,
            this->Ranks.isFirst() ? zones : std::vector<Zone>(), array, 0, 0.25, &this->Ranks);
          EXPECT_EQ(expected.Cells, found.Cells);
          EXPECT_EQ(expected.Area, found.Area);
          EXPECT_EQ(expected.Sum, found.Sum);
          EXPECT_EQ(expected.Above, found.Above);
          for (std::size_t i = 0; i < 2; ++i)
          {
            EXPECT_EQ(expected.Low[i], found.Low[i]);
            EXPECT_EQ(expected.High[i], found.High[i]);
            EXPECT_EQ(expected.Mean[i], found.Mean[i]);
          }
        }
      });
  };
  for (const char* const tiling : { "grid:3x3", "grid:1x1" })
  {
    this->store(source, tiling);
    expectAsAlone(ResidentMesh(this->Path));
  }
  expectAsAlone(ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())));
  const int holders = std::max(1, this->Ranks.size() - 1);
  expectAsAlone(
    ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)));
}

TEST_F(ZonesOnRanks, ShareTheCellsAndPointsOfRegions)
{
  const SourceMesh source = makeSource(latticeTriangles(12, 0));
  this->store(source, "grid:3x2");
  const ResidentMesh whole(inMemory(source));
  const ResidentMesh mesh(this->Path);
  const Region region = { { { 0.2, 0.3, 0 }, { 0.6, 0.7, 0 } }, {} };
  this->Ranks.together(
    [&]
    {
      const bool isFirst = this->Ranks.isFirst();
      for (const bool inside : { false, true })
      {
        const std::vector<std::int64_t> cells = cellsIn(mesh, region, inside, &this->Ranks);
        EXPECT_EQ(isFirst ? cellsIn(whole, region, inside) : std::vector<std::int64_t>(), cells);
      }
      EXPECT_EQ(isFirst ? pointsIn(whole, region) : std::vector<std::int64_t>(),
        pointsIn(mesh, region, &this->Ranks));
    });
}

} // namespace

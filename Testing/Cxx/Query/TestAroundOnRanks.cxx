// SPDX-License-Identifier: BSD-3-Clause
#include "QueryRanksTesting.h"

#include "Query/Queries.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

using namespace tipp;
using namespace tipp::test;

namespace
{

class AroundOnRanks : public QueryRanksTest
{
protected:
  void expectAroundAsAlone(const ResidentMesh& mesh, const SourceMesh& source)
  {
    const ResidentMesh whole(inMemory(source));
    const std::vector<std::int64_t> cells = this->ownIds(source.cells());
    const std::vector<std::int64_t> points = this->ownIds(source.points());
    const auto expectEqualLists = [](const IdLists& expected, const IdLists& lists)
    {
      EXPECT_EQ(expected.Starts, lists.Starts);
      EXPECT_EQ(expected.Ids, lists.Ids);
    };
    this->Ranks.together(
      [&]
      {
        EXPECT_EQ(neighborsOf(whole, cells), neighborsOf(mesh, cells, &this->Ranks));
        expectEqualLists(starsOf(whole, points), starsOf(mesh, points, &this->Ranks));
        for (const int k : { 0, 1, 3 })
        {
          expectEqualLists(
            ringsOfPoints(whole, points, k), ringsOfPoints(mesh, points, k, &this->Ranks));
          expectEqualLists(
            ringsOfCells(whole, cells, k), ringsOfCells(mesh, cells, k, &this->Ranks));
        }
        const Components expected = componentsOf(whole);
        const Components components = componentsOf(mesh, &this->Ranks);
        EXPECT_EQ(expected.Sizes, components.Sizes);
        for (std::size_t i = 0; i < components.Cells.size(); ++i)
        {
          EXPECT_EQ(expected.OfCells[std::size_t(components.Cells[i])], components.OfCells[i]);
        }
        std::vector<std::int64_t> count = { std::int64_t(components.Cells.size()) };
        this->Ranks.sum(count);
        EXPECT_EQ(std::int64_t(source.cells()), count[0]);
        this->expectProfilesAsAlone(mesh, whole);
        if (source.CellSize == 3)
        {
          this->expectLinesAsAlone(mesh, whole);
        }
      });
  }

  /// Each rank queries its own polyline; the last rank has none.
  void expectProfilesAsAlone(const ResidentMesh& mesh, const ResidentMesh& whole)
  {
    const double shift = 0.05 * this->Ranks.rank();
    std::vector<Point3> polyline = { { -0.2, 0.3 + shift, 0.4 }, { 0.7, 0.6, 0.5 + shift },
      { 0.4, 1.2, 0.3 } };
    if (this->isLast())
    {
      polyline.clear();
    }
    const std::vector<std::string> arrays = { "value", "label" };
    for (const double spacing : { 0.0, 0.07 })
    {
      const Profile expected = profileOf(whole, polyline, spacing, arrays);
      const Profile profile = profileOf(mesh, polyline, spacing, arrays, &this->Ranks);
      EXPECT_EQ(expected.Distances, profile.Distances);
      EXPECT_EQ(expected.Points, profile.Points);
      expectEqual(expected.Answer, profile.Answer);
    }
  }

  /// Borders and contours, which only the first rank receives.
  void expectLinesAsAlone(const ResidentMesh& mesh, const ResidentMesh& whole)
  {
    const BoundaryLoops border = boundaryOf(mesh, &this->Ranks);
    const std::vector<double> levels = { 0.3, -0.2, 0.7 };
    const Contours contours = contoursOf(mesh, "value", 1, levels, &this->Ranks);
    const bool isFirst = this->Ranks.isFirst();
    const BoundaryLoops expected = isFirst ? boundaryOf(whole) : BoundaryLoops();
    EXPECT_EQ(expected.Points.Starts, border.Points.Starts);
    EXPECT_EQ(expected.Points.Ids, border.Points.Ids);
    EXPECT_EQ(expected.Positions, border.Positions);
    const Contours lines = isFirst ? contoursOf(whole, "value", 1, levels) : Contours();
    EXPECT_EQ(lines.Starts, contours.Starts);
    EXPECT_EQ(lines.Levels, contours.Levels);
    EXPECT_EQ(lines.Points, contours.Points);
  }
};

TEST_F(AroundOnRanks, FindNeighborsInAStoredMesh)
{
  for (const SourceMesh& source : { makeSource(latticeTriangles(10, 0.3)),
         makeSource(latticeTriangles(8, 0)), makeSource(latticeTetrahedra(3, 0.3)) })
  {
    this->store(source, source.CellSize == 3 ? "grid:3x3" : "grid:2x2x2");
    this->expectAroundAsAlone(ResidentMesh(this->Path), source);
  }
}

TEST_F(AroundOnRanks, FindNeighborsInPartsInMemory)
{
  const int holders = std::max(1, this->Ranks.size() - 1);
  for (const SourceMesh& source : { makeSource(latticeTriangles(10, 0.3)),
         makeSource(latticeTriangles(8, 0)), makeSource(latticeTetrahedra(3, 0.3)) })
  {
    this->expectAroundAsAlone(
      ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())), source);
    this->expectAroundAsAlone(
      ResidentMesh(this->isLast() ? MeshPart() : inMemory(source, 0, this->Ranks.rank(), holders)),
      source);
  }
}

TEST_F(AroundOnRanks, FindNeighborsInContiguousParts)
{
  const auto parts = std::size_t(this->Ranks.size());
  for (SourceMesh source : { makeSource(latticeTriangles(10, 0.3)),
         makeSource(latticeTriangles(8, 0)), makeSource(latticeTetrahedra(3, 0.3)) })
  {
    const auto corners = std::size_t(source.CellSize);
    std::vector<std::vector<std::int64_t>> cells;
    for (std::size_t at = 0; at < source.Cells.size(); at += corners)
    {
      cells.emplace_back(source.Cells.begin() + std::ptrdiff_t(at),
        source.Cells.begin() + std::ptrdiff_t(at + corners));
    }
    const auto xOf = [&source](const std::vector<std::int64_t>& cell)
    { return source.Coordinates[std::size_t(cell[0]) * std::size_t(source.Components)]; };
    std::sort(cells.begin(), cells.end(),
      [&xOf](const auto& a, const auto& b)
      { return std::make_pair(xOf(a), a) < std::make_pair(xOf(b), b); });
    // inMemory() gives each rank every n-th cell.
    auto next = cells.begin();
    for (std::size_t part = 0; part < parts; ++part)
    {
      for (std::size_t cell = part; cell < cells.size(); cell += parts)
      {
        std::copy_n(
          (next++)->begin(), corners, source.Cells.begin() + std::ptrdiff_t(corners * cell));
      }
    }
    this->expectAroundAsAlone(
      ResidentMesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size())), source);
  }
}

TEST_F(AroundOnRanks, AProfileHasNoArraysIfNoRankHasCells)
{
  const ResidentMesh mesh{ MeshPart() };
  Profile profile;
  this->Ranks.together(
    [&] {
      profile = profileOf(mesh, { { 0, 0, 0 }, { 1, 0, 0 } }, 0, { "value" }, &this->Ranks);
    });
  EXPECT_EQ(std::vector<double>({ 0, 1 }), profile.Distances);
  EXPECT_EQ(std::vector<std::int64_t>({ -1, -1 }), profile.Answer.Cells);
  EXPECT_TRUE(profile.Answer.Arrays.empty());
}

TEST_F(AroundOnRanks, RingsReachOtherRanksAtPointsWithoutElevation)
{
  const SourceMesh source = makeSource(latticeTriangles(8, 0.3));
  MeshPart part = inMemory(source, 0, this->Ranks.rank(), this->Ranks.size());
  const auto* const first = static_cast<const double*>(part.Mesh.Points);
  std::vector<double> points(first, first + 3 * part.Mesh.PointCount);
  for (std::size_t z = 2; z < points.size(); z += 3)
  {
    points[z] = std::numeric_limits<double>::quiet_NaN();
  }
  part.Mesh.Points = points.data();
  const ResidentMesh mesh(part);
  const std::vector<std::int64_t> seeds = this->ownIds(source.points());
  const IdLists expected = ringsOfPoints(ResidentMesh(inMemory(source)), seeds, 2);
  IdLists found;
  this->Ranks.together([&] { found = ringsOfPoints(mesh, seeds, 2, &this->Ranks); });
  EXPECT_EQ(expected.Starts, found.Starts);
  EXPECT_EQ(expected.Ids, found.Ids);
}

TEST_F(AroundOnRanks, PartsWithoutIdsAndUnknownIdsAreRefused)
{
  const SourceMesh source = makeSource(latticeTriangles(6, 0.3));
  const auto expectFailure = [](const MeshPart& part, std::int64_t id, const char* message)
  {
    const ResidentMesh mesh(part);
    Communicator ranks(vtkMultiProcessController::GetGlobalController());
    try
    {
      ranks.together([&] { starsOf(mesh, { id }, &ranks); });
      ADD_FAILURE() << "not refused: " << message;
    }
    catch (const RankFailure& failure)
    {
      EXPECT_NE(std::string::npos, std::string(failure.what()).find(message)) << failure.what();
    }
  };
  MeshPart part = inMemory(source, 0, this->Ranks.rank(), this->Ranks.size());
  expectFailure(part, 1000, "has no point 1000");
  part.PointIds = nullptr;
  if (this->Ranks.size() > 1)
  {
    expectFailure(part, 0, "no global ids");
  }
}

TEST_F(AroundOnRanks, PartsWithDifferentTypesOfCellsAreRefused)
{
  const SourceMesh source =
    makeSource(this->isLast() ? latticeTetrahedra(2, 0) : latticeTriangles(6, 0.3));
  const ResidentMesh mesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size()));
  const auto ask = [&] { this->Ranks.together([&] { starsOf(mesh, { 0 }, &this->Ranks); }); };
  if (this->Ranks.size() > 1)
  {
    EXPECT_THROW(ask(), RankFailure);
  }
  else
  {
    EXPECT_NO_THROW(ask());
  }
}

TEST_F(AroundOnRanks, UnknownSeedsOfRingsEndAllRanks)
{
  const SourceMesh source = makeSource(latticeTriangles(6, 0.3));
  const ResidentMesh mesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size()));
  const bool asksUnknown = this->Ranks.rank() + 1 == this->Ranks.size();
  for (const std::int64_t unknown : { std::int64_t(-1), std::int64_t(1) << 40 })
  {
    for (const bool ofPoints : { true, false })
    {
      // Only the last rank asks for an id that no rank has.
      const std::vector<std::int64_t> seeds = { 5, asksUnknown ? unknown : 3, 5 };
      try
      {
        this->Ranks.together(
          [&]
          {
            ofPoints ? ringsOfPoints(mesh, seeds, 1, &this->Ranks)
                     : ringsOfCells(mesh, seeds, 1, &this->Ranks);
          });
        ADD_FAILURE() << "not refused: " << unknown;
      }
      catch (const RankFailure& failure)
      {
        EXPECT_NE(std::string::npos, std::string(failure.what()).find(std::to_string(unknown)))
          << failure.what();
      }
    }
  }
}

TEST_F(AroundOnRanks, RingsOfRepeatedSeedsInAnyOrderAreInTheOrderOfTheSeeds)
{
  const SourceMesh source = makeSource(latticeTriangles(10, 0.3));
  const ResidentMesh whole(inMemory(source));
  const ResidentMesh mesh(inMemory(source, 0, this->Ranks.rank(), this->Ranks.size()));
  std::vector<std::int64_t> seeds;
  for (std::int64_t i = 0; i < 2 * std::int64_t(source.points()); ++i)
  {
    seeds.push_back((i * 37 + this->Ranks.rank()) % std::int64_t(source.points()));
  }
  const IdLists expected = ringsOfPoints(whole, seeds, 2);
  IdLists found;
  this->Ranks.together([&] { found = ringsOfPoints(mesh, seeds, 2, &this->Ranks); });
  EXPECT_EQ(expected.Starts, found.Starts);
  EXPECT_EQ(expected.Ids, found.Ids);
}

TEST_F(AroundOnRanks, FollowDescentsFromRankToRank)
{
  const SourceMesh source = makeSource(latticeTriangles(16, 0.3));
  const ResidentMesh whole(inMemory(source));
  const std::vector<Point3> points = this->ownOf(pointsAround(source, 60));
  for (const char* const tiling : { "grid:4x4", "grid:1x1" })
  {
    this->store(source, tiling);
    const ResidentMesh mesh(this->Path);
    for (int component = 0; component < 2; ++component)
    {
      const Descents expected = descentsOf(whole, points, "value", component);
      Descents found;
      this->Ranks.together(
        [&] { found = descentsOf(mesh, points, "value", component, &this->Ranks); });
      EXPECT_EQ(expected.Starts, found.Starts);
      EXPECT_EQ(expected.Points, found.Points);
      EXPECT_EQ(expected.Pits, found.Pits);
      ASSERT_EQ(expected.Values.size(), found.Values.size());
      EXPECT_TRUE(std::equal(expected.Values.begin(), expected.Values.end(), found.Values.begin()));
    }
  }
}

} // namespace

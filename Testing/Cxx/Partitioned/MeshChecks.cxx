// SPDX-License-Identifier: BSD-3-Clause
#include "MeshChecks.h"
#include "Predicates/ExactPredicates3.h"

#include "ExactClipping.h"
#include "Partition/ClassifyCells.h"
#include "TemporaryFolder.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <filesystem>

namespace tipp
{
namespace test
{
namespace
{

bool holds(const Box3& box, const double* point, int dimension)
{
  return box.contains(Point3{ point[0], point[1], dimension == 3 ? point[2] : box.Min.z });
}

std::string copyOf(const Buffer<char>& buffer)
{
  return buffer.data() ? std::string(buffer.data(), buffer.size()) : std::string();
}

class PieceChecks
{
public:
  PieceChecks(const PartitionedMesh& mesh, const SourceMesh& source, std::size_t number)
    : Mesh(mesh)
    , Source(source)
    , Number(number)
    , Read(readPiece(mesh, number))
  {
  }

  void checkPoints(std::vector<int>& timesOwned) const
  {
    const auto* ids = this->Read.PointIds.as<std::int64_t>();
    for (std::size_t i = 0; i < std::size_t(this->Read.Points); ++i)
    {
      const std::size_t id = std::size_t(ids[i]);
      ASSERT_LT(id, this->Source.points());
      double xyz[3] = {};
      std::copy_n(&this->Source.Coordinates[id * std::size_t(this->Source.Components)],
        this->Source.Components, xyz);
      ASSERT_EQ(0, std::memcmp(xyz, this->Read.Coordinates.as<double>() + 3 * i, 24)) << id;
      const int dimension = this->Mesh.CellSize - 1;
      std::size_t home = 0;
      while (!holds(this->Mesh.Pieces[home].Box, xyz, dimension))
      {
        ++home;
      }
      ASSERT_EQ(home != this->Number, this->Read.PointGhosts.as<std::uint8_t>()[i] == 1) << id;
      timesOwned[id] += home == this->Number ? 1 : 0;
      ASSERT_TRUE(i == 0 || home != this->Number || i < std::size_t(this->Read.OwnedPoints)) << id;
    }
  }

  void checkCells(const Membership& members, std::vector<int>& timesOwned) const
  {
    std::vector<std::int64_t> borrowed;
    const auto* ids = this->Read.CellIds.as<std::int64_t>();
    for (std::size_t i = 0; i < std::size_t(this->Read.Cells); ++i)
    {
      const std::size_t id = std::size_t(ids[i]);
      ASSERT_LT(id, this->Source.cells());
      const std::size_t corners = std::size_t(this->Source.CellSize);
      for (std::size_t corner = 0; corner < corners; ++corner)
      {
        const std::int32_t local = this->Read.Connectivity.as<std::int32_t>()[i * corners + corner];
        ASSERT_LT(local, this->Read.Points);
        ASSERT_EQ(
          this->Source.Cells[id * corners + corner], this->Read.PointIds.as<std::int64_t>()[local]);
      }
      const bool isOwned = std::int64_t(i) < this->Read.OwnedCells;
      ASSERT_EQ(members.Owner[id] == std::int32_t(this->Number), isOwned) << id;
      timesOwned[id] += isOwned ? 1 : 0;
      if (!isOwned)
      {
        borrowed.push_back(std::int64_t(id));
      }
    }
    std::vector<std::int64_t> expected;
    for (std::size_t id = 0; id < this->Source.cells(); ++id)
    {
      const auto from = members.Borrowers.begin() + std::ptrdiff_t(members.BorrowerStart[id]);
      const auto to = members.Borrowers.begin() + std::ptrdiff_t(members.BorrowerStart[id + 1]);
      if (std::find(from, to, std::int32_t(this->Number)) != to)
      {
        expected.push_back(std::int64_t(id));
      }
    }
    ASSERT_EQ(expected, borrowed);
  }

  void checkAttributes() const
  {
    ASSERT_GE(this->Read.Attributes.size(), 2U);
    for (const Piece::Attribute& attribute : this->Read.Attributes)
    {
      const bool ofPoints = attribute.Description.OfPoints;
      const Buffer<char>& ids = ofPoints ? this->Read.PointIds : this->Read.CellIds;
      const std::int64_t count = ofPoints ? this->Read.Points : this->Read.Cells;
      for (std::size_t i = 0; i < std::size_t(count); ++i)
      {
        const std::size_t id = std::size_t(ids.as<std::int64_t>()[i]);
        this->checkTuple(attribute, i, id);
      }
    }
  }

private:
  void checkTuple(const Piece::Attribute& attribute, std::size_t i, std::size_t id) const
  {
    const std::string& name = attribute.Description.Name;
    if (name == "value")
    {
      ASSERT_EQ(
        0, std::memcmp(&this->Source.Values[2 * id], attribute.Values.as<float>() + 2 * i, 8));
    }
    else if (name == "label")
    {
      ASSERT_EQ(this->Source.Labels[id], attribute.Values.as<std::int16_t>()[i]);
    }
    else
    {
      ASSERT_EQ("level", name);
      ASSERT_EQ(this->Source.Series[id], attribute.Values.as<double>()[i]);
    }
  }

  const PartitionedMesh& Mesh;
  const SourceMesh& Source;
  std::size_t Number;
  Piece Read;
};

/// Whether the cell meets the box, by clipping in rational arithmetic.
bool meets(const SourceMesh& source, std::size_t cell, const Box3& box)
{
  std::array<Point3, 4> corners{};
  const std::size_t count = std::size_t(source.CellSize);
  for (std::size_t corner = 0; corner < count; ++corner)
  {
    const std::size_t id = std::size_t(source.Cells[cell * count + corner]);
    const double* const p = &source.Coordinates[id * std::size_t(source.Components)];
    corners[corner] = { p[0], p[1], count == 4 ? p[2] : 0 };
  }
  return count == 4 ? oracle::tetrahedronMeetsBox(corners, box)
                    : oracle::triangleMeetsBox({ corners[0], corners[1], corners[2] }, box);
}

/// The partitions that each cell meets, by a test of each cell with each box.
Membership membersOf(const PartitionedMesh& mesh, const SourceMesh& source)
{
  std::vector<std::vector<std::int32_t>> met(source.cells());
  for (std::size_t piece = 0; piece < mesh.Pieces.size(); ++piece)
  {
    for (std::size_t cell = 0; cell < met.size(); ++cell)
    {
      if (meets(source, cell, mesh.Pieces[piece].Box))
      {
        met[cell].push_back(std::int32_t(piece));
      }
    }
  }
  Membership members;
  for (const std::vector<std::int32_t>& pieces : met)
  {
    members.Owner.push_back(pieces.empty() ? -1 : pieces[0]);
    members.BorrowerStart.push_back(std::int64_t(members.Borrowers.size()));
    members.Borrowers.insert(
      members.Borrowers.end(), pieces.begin() + (pieces.empty() ? 0 : 1), pieces.end());
  }
  members.BorrowerStart.push_back(std::int64_t(members.Borrowers.size()));
  return members;
}

} // namespace

void expectBelongs(const std::string& path, const SourceMesh& source)
{
  const PartitionedMesh mesh = openPartitionedMesh(path);
  ASSERT_EQ(std::int64_t(source.points()), mesh.Points);
  ASSERT_EQ(std::int64_t(source.cells()), mesh.Cells);
  const Membership members = membersOf(mesh, source);
  std::vector<int> pointOwners(source.points(), 0);
  std::vector<int> cellOwners(source.cells(), 0);
  for (std::size_t piece = 0; piece < mesh.Pieces.size(); ++piece)
  {
    const PieceChecks checks(mesh, source, piece);
    checks.checkPoints(pointOwners);
    checks.checkCells(members, cellOwners);
  }
  EXPECT_EQ(std::vector<int>(source.points(), 1), pointOwners);
  EXPECT_EQ(std::vector<int>(source.cells(), 1), cellOwners);
}

void expectHolds(const std::string& path, const SourceMesh& source)
{
  expectBelongs(path, source);
  const PartitionedMesh mesh = openPartitionedMesh(path);
  for (std::size_t piece = 0; piece < mesh.Pieces.size(); ++piece)
  {
    PieceChecks(mesh, source, piece).checkAttributes();
  }
}

void expectEqual(const Piece& a, const Piece& b)
{
  EXPECT_EQ(a.Points, b.Points);
  EXPECT_EQ(a.OwnedPoints, b.OwnedPoints);
  EXPECT_EQ(a.Cells, b.Cells);
  EXPECT_EQ(a.OwnedCells, b.OwnedCells);
  EXPECT_EQ(a.WideIds, b.WideIds);
  EXPECT_TRUE(copyOf(a.Coordinates) == copyOf(b.Coordinates));
  EXPECT_TRUE(copyOf(a.PointIds) == copyOf(b.PointIds));
  EXPECT_TRUE(copyOf(a.PointGhosts) == copyOf(b.PointGhosts));
  EXPECT_TRUE(copyOf(a.Connectivity) == copyOf(b.Connectivity));
  EXPECT_TRUE(copyOf(a.CellIds) == copyOf(b.CellIds));
  ASSERT_EQ(a.Attributes.size(), b.Attributes.size());
  for (std::size_t i = 0; i < a.Attributes.size(); ++i)
  {
    EXPECT_TRUE(copyOf(a.Attributes[i].Values) == copyOf(b.Attributes[i].Values));
  }
}

std::map<std::string, std::string> filesOf(const std::string& folder)
{
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
  {
    if (entry.is_regular_file())
    {
      files[entry.path().lexically_relative(folder).string()] = contentOf(entry.path().string());
    }
  }
  return files;
}

} // namespace test
} // namespace tipp

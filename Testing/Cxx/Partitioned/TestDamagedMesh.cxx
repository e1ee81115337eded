// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "ForgedMesh.h"
#include "MeshChecks.h"
#include "TemporaryFolder.h"

#include "Flat/FlatMesh.h"
#include "Partitioned/PieceFile.h"
#include "Partitioning/PartitionMesh.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

namespace
{

/// A valid mesh, which each test damages.
class DamagedMesh : public testing::Test
{
protected:
  DamagedMesh()
  {
    writeFlat(makeSource(latticeTriangles(8, 0.3)), this->Folder.path("flat"));
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse("grid:2x2");
    partitionMesh(openFlatMesh(this->Folder.path("flat")), this->path(), options);
  }

  std::string path(const std::string& name = "") const
  {
    return this->Folder.path("mesh") + (name.empty() ? "" : "/" + name);
  }

  void readAll() const
  {
    const PartitionedMesh mesh = openPartitionedMesh(this->path());
    for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
    {
      readPiece(mesh, i);
    }
  }

  void change(const std::string& name, std::size_t at) const
  {
    std::string content = contentOf(this->path(name));
    content[at] = char(content[at] ^ 1);
    std::ofstream(this->path(name), std::ios::binary) << content;
  }

  void expectRefused(const std::string& name, const std::string& words) const
  {
    expectIOError(this->path(name), words, [this] { this->readAll(); });
  }

  /// Replaces a text in the index, and corrects the checksum.
  void editIndex(const std::string& from, const std::string& to) const
  {
    ForgedMesh forged(this->path());
    const std::size_t at = forged.Index.find(from);
    ASSERT_NE(std::string::npos, at);
    forged.Index.replace(at, from.size(), to);
    forged.write();
  }

  /// Replaces the last id of the first piece's array, and expects an error. Then restores the mesh.
  void expectIdIsRefused(PieceRole role, std::int64_t id) const
  {
    const ForgedMesh good(this->path());
    ForgedMesh forged = good;
    const std::size_t array = forged.find(0, role);
    forged.putWord(0, array, forged.arrayBytes(0, array) - 8, std::uint64_t(id));
    forged.write();
    this->expectRefused("pieces/000000.vtu", "a global id that the mesh does not have");
    good.write();
  }

  TemporaryFolder Folder;
};

TEST_F(DamagedMesh, IsReadIfUndamaged)
{
  this->readAll();
}

TEST_F(DamagedMesh, LacksItsIndex)
{
  fs::remove(this->path("index.json"));
  this->expectRefused("index.json", "cannot be opened");
}

TEST_F(DamagedMesh, LacksAPiece)
{
  fs::remove(this->path("pieces/000002.vtu"));
  this->expectRefused("pieces/000002.vtu", "missing");
}

TEST_F(DamagedMesh, LacksThePvtuOrAPartOfIt)
{
  fs::resize_file(this->path("mesh.pvtu"), 10);
  this->expectRefused("mesh.pvtu", "10 bytes where the index says");
  fs::remove(this->path("mesh.pvtu"));
  this->expectRefused("mesh.pvtu", "missing");
}

TEST_F(DamagedMesh, IsReadWithoutAVtkHdfThatTheIndexDoesNotName)
{
  ForgedMesh forged(this->path());
  const std::size_t begin = forged.Index.find(",\n\"vtkhdf_bytes\"");
  const std::size_t end = forged.Index.find(",\n\"xxh3\"");
  ASSERT_LT(begin, end);
  forged.Index.erase(begin, end - begin);
  forged.write();
  fs::remove(this->path("mesh.vtkhdf"));
  this->readAll();
}

TEST_F(DamagedMesh, HasATruncatedPiece)
{
  fs::resize_file(this->path("pieces/000001.vtu"), 1000);
  this->expectRefused("pieces/000001.vtu", "1000 bytes where the index says");
}

TEST_F(DamagedMesh, HasTruncatedTables)
{
  fs::resize_file(this->path("tables.bin"), 64);
  this->expectRefused("tables.bin", "64 bytes where the index says");
}

TEST_F(DamagedMesh, HasATruncatedIndex)
{
  fs::resize_file(this->path("index.json"), 500);
  this->expectRefused("index.json", "not the whole index");
}

TEST_F(DamagedMesh, HasAChangedIndex)
{
  this->change("index.json", 100);
  this->expectRefused("index.json", "checksum");
}

TEST_F(DamagedMesh, HasChangedTables)
{
  this->change("tables.bin", 24);
  this->expectRefused("tables.bin", "table of piece 0");
}

TEST_F(DamagedMesh, HasSwappedPieces)
{
  // The pieces must have equal sizes, so that their sizes do not reveal the exchange.
  const PartitionedMesh mesh = openPartitionedMesh(this->path());
  std::string first = contentOf(mesh.piecePath(0));
  std::string second = contentOf(mesh.piecePath(1));
  first.resize(mesh.Pieces[1].FileBytes);
  second.resize(mesh.Pieces[0].FileBytes);
  std::ofstream(mesh.piecePath(0), std::ios::binary) << second;
  std::ofstream(mesh.piecePath(1), std::ios::binary) << first;
  this->expectRefused("pieces/000000.vtu", "does not have the checksum of piece 0");
}

/// Meshes with borrowed cells by reference and with duplicated ones.
class DamagedArrays : public DamagedMesh
{
protected:
  /// Calls body() for each kind of mesh.
  template <typename Body>
  void forEachKind(const Body& body) const
  {
    for (const bool duplicate : { false, true })
    {
      SCOPED_TRACE(duplicate ? "duplicate" : "reference");
      PartitionOptions options;
      options.Tiling = *TilingChoice::parse("grid:2x2");
      options.DuplicateBorrowers = duplicate;
      partitionMesh(openFlatMesh(this->Folder.path("flat")), this->path(), options);
      body();
    }
  }

  void verifyAll() const
  {
    const PartitionedMesh mesh = openPartitionedMesh(this->path());
    verifyViews(mesh);
    for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
    {
      PieceFile(mesh, i).verifyAll();
    }
  }
};

TEST_F(DamagedArrays, AreRefusedByTheReaderIfAnyHasChanged)
{
  this->forEachKind(
    [this]
    {
      const PartitionedMesh mesh = openPartitionedMesh(this->path());
      const PieceFile piece(mesh, 0);
      const std::string content = contentOf(mesh.piecePath(0));
      for (std::size_t a = 0; a < piece.arrays().size(); ++a)
      {
        const PieceArray& array = piece.arrays()[a];
        const auto tuples = std::size_t(piece.partStarts(array.ofPoints()).back());
        const std::size_t begin = piece.table().Offsets[a];
        const std::size_t bytes = tuples * array.tupleBytes();
        for (const std::size_t at : { begin, begin + bytes / 2, begin + bytes - 1 })
        {
          this->change("pieces/000000.vtu", at);
          this->expectRefused("pieces/000000.vtu", array.Name + " does not have its checksum");
          std::ofstream(mesh.piecePath(0), std::ios::binary) << content;
        }
      }
    });
}

TEST_F(DamagedArrays, AreFoundByTheCheckForEachByte)
{
  this->forEachKind(
    [this]
    {
      this->verifyAll();
      for (const auto& [name, content] : filesOf(this->path()))
      {
        for (std::size_t at = 0; at < content.size(); at += at + 40 < content.size() ? 13 : 1)
        {
          std::string damaged = content;
          damaged[at] ^= 0x20;
          std::ofstream(this->path(name), std::ios::binary) << damaged;
          expectIOError(this->path(name), "", [this] { this->verifyAll(); });
        }
        std::ofstream(this->path(name), std::ios::binary) << content;
      }
    });
}

TEST_F(DamagedMesh, IsOfANewerVersion)
{
  this->editIndex("\"version\": 1", "\"version\": 2");
  this->expectRefused("index.json", "version 2");
}

TEST_F(DamagedMesh, HasCountsThatDoNotAddUp)
{
  this->editIndex("\"cells\": 128", "\"cells\": 129");
  this->expectRefused("index.json", "wrong counts of cells");
}

TEST_F(DamagedMesh, HasANegativeCount)
{
  this->editIndex("\"points\": ", "\"points\": -");
  this->expectRefused("index.json", "wrong points");
}

TEST_F(DamagedMesh, HasAHugeCount)
{
  this->editIndex("\"ghost_points\":0", "\"ghost_points\":9223372036854775807");
  this->expectRefused("index.json", "wrong ghost_points");
}

TEST_F(DamagedMesh, HasATableBeyondTheFile)
{
  this->editIndex("\"table\":[0,", "\"table\":[9223372036854775800,");
  this->expectRefused("index.json", "wrong table");
}

TEST_F(DamagedMesh, HasAWrongType)
{
  this->editIndex("\"type\":\"Int16\"", "\"type\":\"Int17\"");
  this->expectRefused("index.json", "wrong type");
}

TEST_F(DamagedMesh, HasADescriptionOfAWrongType)
{
  this->editIndex("\"tiling\":", "\"description\": {\"crs\": 5},\n\"tiling\":");
  this->expectRefused("index.json", "'crs' is no text");
}

TEST_F(DamagedMesh, HasAnArrayLargerThanItsFile)
{
  this->editIndex("\"components\":2", "\"components\":200000");
  this->expectRefused("tables.bin", "behind its file");
}

TEST_F(DamagedMesh, HasInvalidIds)
{
  for (const bool duplicate : { false, true })
  {
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse("grid:2x2");
    options.DuplicateBorrowers = duplicate;
    partitionMesh(openFlatMesh(this->Folder.path("flat")), this->path(), options);
    const PartitionedMesh mesh = openPartitionedMesh(this->path());
    for (const std::int64_t id : { std::int64_t(-1), std::numeric_limits<std::int64_t>::min() })
    {
      this->expectIdIsRefused(PieceRole::PointIds, id);
      this->expectIdIsRefused(PieceRole::CellIds, id);
    }
    this->expectIdIsRefused(PieceRole::PointIds, mesh.Points);
    this->expectIdIsRefused(PieceRole::CellIds, mesh.Cells);
    this->readAll();
  }
}

TEST_F(DamagedMesh, IsMissing)
{
  expectIOError(this->path("other/index.json"), "cannot be opened",
    [this] { openPartitionedMesh(this->path("other/index.json")); });
  EXPECT_FALSE(isPartitionedMesh(this->path("other")));
  EXPECT_TRUE(isPartitionedMesh(this->path()));
  EXPECT_TRUE(isPartitionedMesh(this->path("index.json")));
}

} // namespace

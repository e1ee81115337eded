// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are replaced while they are read.
#include "ExpectIOError.h"
#include "MeshChecks.h"
#include "TemporaryFolder.h"

#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "Partitioned/ReadPiece.h"
#include "Partitioning/PartitionMesh.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

using namespace tipp;
using namespace tipp::test;

namespace
{

class ReplacedMesh : public testing::Test
{
protected:
  ReplacedMesh()
  {
    for (const int size : { 8, 11 })
    {
      writeFlat(makeSource(latticeTriangles(size, 0.3)), this->flat(size));
    }
    this->make(8);
  }

  std::string flat(int size) const { return this->Folder.path("flat" + std::to_string(size)); }
  std::string path() const { return this->Folder.path("mesh"); }

  /// Makes the mesh from one of the flat meshes, and replaces the one that is there.
  void make(int size) const
  {
    PartitionOptions options;
    options.Tiling = *TilingChoice::parse("grid:3x3");
    options.Threads = 1;
    partitionMesh(openFlatMesh(this->flat(size)), this->path(), options);
  }

  const TemporaryFolder Folder;
};

} // namespace

TEST_F(ReplacedMesh, IsNotCalledDamaged)
{
  const PartitionedMesh mesh = openPartitionedMesh(this->path());
  EXPECT_FALSE(wasReplaced(mesh));
  this->make(11);
  EXPECT_TRUE(wasReplaced(mesh));
  for (std::size_t piece = 0; piece < mesh.Pieces.size(); ++piece)
  {
    expectIOError(
      this->path(), "was replaced or removed while it was read", [&] { readPiece(mesh, piece); });
  }
  EXPECT_EQ(11 * 11 * 2, openPartitionedMesh(this->path()).Cells);
}

TEST_F(ReplacedMesh, IsNotCalledDamagedWhereItIsRemoved)
{
  const PartitionedMesh mesh = openPartitionedMesh(this->path());
  std::filesystem::remove_all(this->path());
  expectIOError(this->path(), "was replaced or removed", [&] { readPiece(mesh, 0); });
}

TEST_F(ReplacedMesh, IsOpenedWhileItIsReplaced)
{
  std::atomic<bool> isDone{ false };
  std::thread writer(
    [&]
    {
      for (int i = 0; i < 60; ++i)
      {
        this->make(i % 2 == 0 ? 11 : 8);
      }
      isDone = true;
    });
  int opened = 0;
  for (; !isDone; ++opened)
  {
    const PartitionedMesh mesh = openPartitionedMesh(this->path());
    try
    {
      std::int64_t cells = 0;
      for (std::size_t piece = 0; piece < mesh.Pieces.size(); ++piece)
      {
        cells += readPiece(mesh, piece).OwnedCells;
      }
      EXPECT_EQ(mesh.Cells, cells);
    }
    catch (const IOError& error)
    {
      EXPECT_NE(std::string::npos, std::string(error.what()).find("was replaced")) << error.what();
    }
  }
  writer.join();
  EXPECT_GT(opened, 0);
}

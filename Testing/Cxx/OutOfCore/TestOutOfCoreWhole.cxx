// SPDX-License-Identifier: BSD-3-Clause
// A run that ended when its mesh was whole, but not yet at its path.
#include "ResumeTesting.h"

#include <filesystem>
#include <fstream>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;
using namespace tipp::test;

/// A run that was killed after it finished its mesh, but before it renamed it to its final path.
template <typename Engine>
class OutOfCoreWhole : public OutOfCoreResume<Engine>
{
protected:
  void SetUp() override { this->makeWhole(); }

  void makeWhole()
  {
    this->makePoints("duplicates");
    this->Options.Progress = [this](double fraction)
    {
      if (fraction == 1)
      {
        fs::copy(this->Part, this->Folder.path("copy"), fs::copy_options::recursive);
      }
      return true;
    };
    this->Whole = this->run();
    this->Options.Progress = {};
    if (fs::exists(this->Folder.path("mesh.tipp"))) // not if triangles are only counted
    {
      this->Expected = this->files();
      fs::rename(this->Folder.path("mesh.tipp"), this->Folder.path("published"));
    }
    fs::rename(this->Folder.path("copy"), this->Part);
  }

  void publish() const
  {
    fs::rename(this->Folder.path("published"), this->Folder.path("mesh.tipp"));
  }

  void expectTheSame(const typename Engine::Statistics& statistics) const
  {
    EXPECT_TRUE(statistics.Resumed);
    EXPECT_EQ(2500, statistics.Points);
    EXPECT_EQ(Engine::cells(this->Whole), Engine::cells(statistics));
    EXPECT_EQ(Engine::sum(this->Whole), Engine::sum(statistics));
    EXPECT_EQ(this->Whole.Duplicates, statistics.Duplicates);
    EXPECT_EQ(this->Whole.Pieces, statistics.Pieces);
    EXPECT_EQ(this->Whole.MeshBytes, statistics.MeshBytes);
    EXPECT_FALSE(fs::exists(this->Part));
  }

  const std::string Part = this->Folder.path(".mesh.tipp.part");
  typename Engine::Statistics Whole;
  std::map<std::string, std::string> Expected;
};
TYPED_TEST_SUITE(OutOfCoreWhole, Engines, );

TYPED_TEST(OutOfCoreWhole, IsRenamedEvenIfItsPointsAreMissing)
{
  for (const char* name : { ".points.0", ".piece.0", ".piece.1.finished" })
  {
    ASSERT_TRUE(fs::remove(this->Part + "/" + name)) << name;
  }
  this->Options.Resume = true;
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TYPED_TEST(OutOfCoreWhole, IsRenamedWithoutARequestToResume)
{
  this->Options.Progress = [](double) { return false; }; // no effect: only renaming is left
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TYPED_TEST(OutOfCoreWhole, IsRefusedForAnotherInput)
{
  this->makePoints("uniform", 2500, 2);
  expectIOError(this->Folder.path("mesh.tipp"), "another run", [this] { this->run(); });
  this->Options.Resume = true;
  expectIOError(this->Folder.path("mesh.tipp"), "since changed input", [this] { this->run(); });
  EXPECT_TRUE(this->Expected == filesOf(this->Part + "/mesh.tipp"));
}

TYPED_TEST(OutOfCoreWhole, IsRefusedIfAFileIsMissing)
{
  fs::remove(this->Part + "/mesh.tipp/pieces/000003.vtu");
  this->Options.Resume = true;
  expectIOError(this->Part + "/mesh.tipp", "is damaged", [this] { this->run(); });
}

TYPED_TEST(OutOfCoreWhole, IsRefusedIfAFileHasChanged)
{
  this->Options.Resume = true;
  const std::string mesh = this->Part + "/mesh.tipp/";
  for (const auto& [name, content] : this->Expected)
  {
    std::string damaged = content;
    damaged[damaged.size() - 8] ^= 1;
    std::ofstream(mesh + name, std::ios::binary) << damaged;
    expectIOError(mesh + name, "is damaged", [this] { this->run(); });
    EXPECT_FALSE(fs::exists(this->Folder.path("mesh.tipp")));
    std::ofstream(mesh + name, std::ios::binary) << content;
  }
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TYPED_TEST(OutOfCoreWhole, IsKeptAfterItReplacedAnotherMesh)
{
  this->publish();
  fs::remove_all(this->Part + "/mesh.tipp");
  const TemporaryFolder other;
  TypeParam::write(other.path("points.npy"), "uniform", 500, 1);
  TypeParam::run(other.path("points.npy"), other.path("mesh.tipp"), TypeParam::options());
  fs::rename(other.path("mesh.tipp"), this->Part + "/mesh.tipp");
  this->Options.Resume = true;
  this->expectTheSame(this->run());
  EXPECT_TRUE(this->Expected == this->files());
}

TYPED_TEST(OutOfCoreWhole, MayBeReplacedByAnotherInputOnceRenamed)
{
  this->publish();
  this->makePoints("uniform", 1000, 2);
  EXPECT_FALSE(this->run().Resumed);
  EXPECT_FALSE(fs::exists(this->Part));
  const TemporaryFolder other;
  TypeParam::run(this->Folder.path("points.npy"), other.path("mesh.tipp"), this->Options);
  EXPECT_TRUE(filesOf(other.path("mesh.tipp")) == this->files());
}

class OutOfCoreCounted : public OutOfCoreWhole<Plane>
{
protected:
  void SetUp() override
  {
    this->Options.CountOnly = true;
    this->makeWhole();
  }
};

TEST_F(OutOfCoreCounted, IsNotCountedAgain)
{
  ASSERT_TRUE(fs::remove(this->Part + "/.points.0"));
  this->Options.Resume = true;
  this->expectTheSame(this->run());
  EXPECT_EQ(1U, this->Folder.fileCount());
}

} // namespace

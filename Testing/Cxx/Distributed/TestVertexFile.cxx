// SPDX-License-Identifier: BSD-3-Clause
#include "Distributed/VertexFile.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;
using namespace tipp::test;

std::vector<PlainVertex> someVertices(std::size_t count, std::int64_t first)
{
  std::vector<PlainVertex> vertices;
  for (std::size_t i = 0; i < count; ++i)
  {
    vertices.push_back({ { 0.5 * double(i), -double(first) }, first + std::int64_t(i) });
  }
  return vertices;
}

class VertexFileIn : public testing::Test
{
protected:
  VertexFile::Part put(const std::vector<PlainVertex>& vertices)
  {
    return this->File.put(vertices.data(), vertices.size());
  }

  testing::AssertionResult isThere(
    const VertexFile::Part& part, const std::vector<PlainVertex>& expected) const
  {
    std::vector<PlainVertex> vertices;
    this->File.get(part, vertices);
    bool isSame = vertices.size() == expected.size();
    for (std::size_t i = 0; isSame && i < vertices.size(); ++i)
    {
      isSame = vertices[i].Id == expected[i].Id && vertices[i].Place == expected[i].Place;
    }
    return isSame ? testing::AssertionSuccess() : testing::AssertionFailure() << "others";
  }

  TemporaryFolder Folder;
  const std::string Path = Folder.path("rim");
  VertexFile File{ Path };
};

TEST_F(VertexFileIn, GivesBackWhatWasPutThere)
{
  const auto first = someVertices(10, 100);
  const auto second = someVertices(3, 500);
  const VertexFile::Part a = this->put(first);
  const VertexFile::Part none = this->put({});
  const VertexFile::Part b = this->put(second);
  EXPECT_TRUE(this->isThere(b, second));
  EXPECT_TRUE(this->isThere(none, {}));
  EXPECT_TRUE(this->isThere(a, first));
  EXPECT_EQ(13 * sizeof(PlainVertex), this->File.used());
}

TEST_F(VertexFileIn, AddsToWhatTheVectorHas)
{
  const VertexFile::Part part = this->put(someVertices(4, 10));
  std::vector<PlainVertex> vertices = someVertices(2, 0);
  this->File.get(part, vertices);
  ASSERT_EQ(6U, vertices.size());
  EXPECT_EQ(1, vertices[1].Id);
  EXPECT_EQ(13, vertices[5].Id);
}

TEST_F(VertexFileIn, TakesFreedRoomAgain)
{
  const VertexFile::Part a = this->put(someVertices(5, 0));
  const VertexFile::Part b = this->put(someVertices(5, 100));
  const auto kept = someVertices(1, 200);
  const VertexFile::Part c = this->put(kept);
  const std::uint64_t size = this->File.size();
  this->File.free(a);
  this->File.free(b);
  const auto both = someVertices(10, 300);
  const VertexFile::Part d = this->put(both);
  EXPECT_EQ(size, this->File.size());
  EXPECT_TRUE(this->isThere(c, kept));
  EXPECT_TRUE(this->isThere(d, both));
  EXPECT_EQ(21 * sizeof(PlainVertex), this->File.written());
}

TEST_F(VertexFileIn, IsEmptyWhenAllIsFreed)
{
  std::vector<VertexFile::Part> parts;
  for (std::size_t i = 0; i < 7; ++i)
  {
    parts.push_back(this->put(someVertices(1 + i, 0)));
  }
  for (const std::size_t i : { 3, 1, 2, 6, 0, 5, 4 })
  {
    this->File.free(parts[i]);
  }
  EXPECT_EQ(0U, this->File.used());
  EXPECT_EQ(0U, this->File.size());
}

TEST_F(VertexFileIn, KeepsWhatIsThereWhateverComesAndGoes)
{
  std::mt19937 random(1);
  std::vector<std::pair<VertexFile::Part, std::vector<PlainVertex>>> there;
  std::uint64_t most = 0;
  for (int i = 0; i < 2000; ++i)
  {
    if (there.size() < 20 || random() % 2 == 0)
    {
      const auto vertices = someVertices(random() % 30, i);
      there.emplace_back(this->put(vertices), vertices);
    }
    else
    {
      const std::size_t which = random() % there.size();
      ASSERT_TRUE(this->isThere(there[which].first, there[which].second));
      this->File.free(there[which].first);
      there.erase(there.begin() + std::ptrdiff_t(which));
    }
    most = std::max(most, this->File.used());
  }
  EXPECT_LT(this->File.size(), 3 * most);
}

TEST_F(VertexFileIn, IsMadeWhenThereAreVerticesAndGoesAwayWithTheObject)
{
  {
    VertexFile file(this->Folder.path("other"));
    EXPECT_EQ(0U, this->Folder.fileCount());
    const auto vertices = someVertices(2, 0);
    file.put(vertices.data(), vertices.size());
    EXPECT_EQ(1U, this->Folder.fileCount());
  }
  EXPECT_EQ(0U, this->Folder.fileCount());
}

TEST_F(VertexFileIn, NamesAFileThatIsDamaged)
{
  const VertexFile::Part part = this->put(someVertices(2, 0));
  std::string content = contentOf(this->Path);
  content[7] ^= 1;
  this->Folder.file("rim", content);
  std::vector<PlainVertex> vertices;
  expectIOError(this->Path, "is damaged", [&] { this->File.get(part, vertices); });
}

TEST_F(VertexFileIn, NamesAFileThatIsCutShort)
{
  const VertexFile::Part part = this->put(someVertices(2, 0));
  std::filesystem::resize_file(this->Path, 20);
  std::vector<PlainVertex> vertices;
  expectIOError(this->Path, "", [&] { this->File.get(part, vertices); });
}

TEST(VertexFile, NamesADiskThatIsFull)
{
  const TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path("rim"));
  VertexFile file(folder.path("rim"));
  const auto vertices = someVertices(2, 0);
  expectIOError(
    folder.path("rim"), "cannot be written", [&] { file.put(vertices.data(), vertices.size()); });
}

} // namespace

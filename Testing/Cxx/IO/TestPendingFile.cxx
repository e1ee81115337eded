// SPDX-License-Identifier: BSD-3-Clause
#include "ExpectIOError.h"
#include "Files/PendingOutput.h"
#include "TemporaryFolder.h"

#include <unistd.h>

namespace
{

using tipp::PendingFile;
using tipp::test::contentOf;

class PendingFiles : public testing::Test
{
protected:
  static void write(const std::string& path, const std::string& content)
  {
    std::ofstream(path) << content;
  }

  const tipp::test::TemporaryFolder Folder;
  const std::string Path = Folder.path("result");
};

} // namespace

TEST_F(PendingFiles, AppearsWhenCommitted)
{
  PendingFile pending(this->Path);
  write(pending.temporaryPath(), "new");
  EXPECT_FALSE(std::filesystem::exists(this->Path));
  pending.commit();
  EXPECT_EQ("new", contentOf(this->Path));
  EXPECT_EQ(1U, this->Folder.fileCount());
}

TEST_F(PendingFiles, WithoutCommitTheOldFileStays)
{
  write(this->Path, "old");
  {
    const PendingFile pending(this->Path);
    write(pending.temporaryPath(), "half");
  }
  EXPECT_EQ("old", contentOf(this->Path));
  EXPECT_EQ(1U, this->Folder.fileCount());
}

TEST_F(PendingFiles, LinkIsFollowed)
{
  write(this->Path, "old");
  const std::string link = this->Folder.path("link");
  std::filesystem::create_symlink(this->Path, link);
  PendingFile pending(link);
  write(pending.temporaryPath(), "new");
  pending.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ("new", contentOf(this->Path));
}

TEST_F(PendingFiles, LinkToNothingIsFollowed)
{
  const std::string link = this->Folder.path("link");
  std::filesystem::create_symlink("target", link);
  PendingFile pending(link);
  write(pending.temporaryPath(), "new");
  pending.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_EQ("new", tipp::test::contentOf(this->Folder.path("target")));
}

TEST_F(PendingFiles, LinkToItselfIsRefused)
{
  const std::string link = this->Folder.path("link");
  std::filesystem::create_symlink("link", link);
  tipp::test::expectIOError(link, "leads to itself", [&]() { PendingFile{ link }; });
}

TEST_F(PendingFiles, FileThatAppearsMeanwhileIsLeftAlone)
{
  PendingFile pending(this->Path);
  const std::string finished = pending.temporaryPath();
  write(finished, "new");
  write(this->Path, "a user's");
  tipp::test::expectIOError(
    this->Path, "appeared since the run began", [&]() { pending.commit(); });
  EXPECT_EQ("a user's", tipp::test::contentOf(this->Path));
  EXPECT_EQ("new", tipp::test::contentOf(finished));
}

TEST_F(PendingFiles, FolderThatAppearsMeanwhileIsLeftAlone)
{
  PendingFile pending(this->Path);
  const std::string finished = pending.temporaryPath();
  std::filesystem::create_directory(this->Path);
  write(this->Path + "/notes", "a user's");
  tipp::test::expectIOError(
    this->Path, "appeared since the run began", [&]() { pending.commit(); });
  EXPECT_EQ("a user's", tipp::test::contentOf(this->Path + "/notes"));
  EXPECT_TRUE(std::filesystem::exists(finished));
}

TEST_F(PendingFiles, FileThatIsChangedMeanwhileIsLeftAlone)
{
  write(this->Path, "old");
  PendingFile pending(this->Path);
  write(this->Path, "a user's");
  tipp::test::expectIOError(this->Path, "changed since the run began", [&]() { pending.commit(); });
  EXPECT_EQ("a user's", tipp::test::contentOf(this->Path));
}

TEST_F(PendingFiles, LongestNameIsWritten)
{
  const std::string path = this->Folder.path(std::string(255, 'n'));
  PendingFile pending(path);
  write(pending.temporaryPath(), "new");
  pending.commit();
  EXPECT_EQ("new", tipp::test::contentOf(path));
  const std::string longer = this->Folder.path(std::string(256, 'n'));
  tipp::test::expectIOError(longer, "File name too long", [&]() { PendingFile{ longer }; });
}

TEST_F(PendingFiles, TwoForOnePathHaveTheirOwnFiles)
{
  const PendingFile one(this->Path);
  const PendingFile other(this->Path);
  EXPECT_NE(one.temporaryPath(), other.temporaryPath());
}

TEST_F(PendingFiles, MissingFolderIsReported)
{
  const std::string path = this->Folder.path("absent/result");
  tipp::test::expectIOError(path, "folder does not exist", [&]() { PendingFile{ path }; });
}

TEST_F(PendingFiles, FolderWithoutPermissionIsReported)
{
  if (geteuid() == 0)
  {
    GTEST_SKIP() << "root may write everywhere";
  }
  const std::string folder = this->Folder.path("closed");
  std::filesystem::create_directory(folder);
  std::filesystem::permissions(folder, std::filesystem::perms::owner_read);
  const std::string path = folder + "/result";
  tipp::test::expectIOError(path, "cannot be written to", [&]() { PendingFile{ path }; });
}

TEST_F(PendingFiles, FolderOrDeviceIsRefused)
{
  const std::string folder = this->Folder.path("");
  tipp::test::expectIOError(folder, "not an ordinary file", [&]() { PendingFile{ folder }; });
  tipp::test::expectIOError(
    "/dev/null", "not an ordinary file", []() { PendingFile{ "/dev/null" }; });
}

TEST_F(PendingFiles, RemovesFilesOfAKilledProcess)
{
  const std::string path = this->Folder.path("result");
  const std::string left = PendingFile(path).temporaryPath();
  ASSERT_FALSE(std::filesystem::exists(left));
  write(left, "half");
  {
    const PendingFile pending(path);
  }
  EXPECT_FALSE(std::filesystem::exists(left));
}

/// Files whose names look like those of temporary files, but are not.
TEST_F(PendingFiles, KeepsFilesOfTheUser)
{
  for (const char* name : { ".result.123456789.tmp", ".result.old.tmp", ".result.12-0123abcd.tmp" })
  {
    write(this->Folder.path(name), "the user's");
    {
      const PendingFile pending(this->Folder.path("result"));
    }
    EXPECT_TRUE(std::filesystem::exists(this->Folder.path(name))) << name;
  }
}

TEST_F(PendingFiles, KeepsFilesOfALivingProcess)
{
  const PendingFile pending(this->Folder.path("result"));
  {
    const PendingFile another(this->Folder.path("result"));
  }
  EXPECT_TRUE(std::filesystem::exists(pending.temporaryPath()));
}

TEST_F(PendingFiles, PathWithoutAFolderIsInTheCurrentOne)
{
  const PendingFile pending("result");
  EXPECT_EQ(
    0U, pending.temporaryPath().find((std::filesystem::current_path() / ".result.").string()));
}

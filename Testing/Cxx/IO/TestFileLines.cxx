// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TextFile.h"

#include "ExpectIOError.h"
#include "TemporaryFolder.h"

namespace
{

using namespace tipp;
using namespace tipp::test;

TEST(FileLines, AreTheSameForBlocksOfAnySize)
{
  const TemporaryFolder folder;
  for (const std::string text : { "", "\n", "a", "a\n", "one\r\ntwo\n\nfour\r",
         "\xef\xbb\xbfx,y\n1,2\n", "a line that is longer than the blocks\nb\n\n\n" })
  {
    const std::string path = folder.file("lines.txt", text);
    for (std::size_t block = 3; block < 60; ++block)
    {
      FileLines lines(path, block);
      LineReader expected(text);
      std::string_view line;
      std::string_view expectedLine;
      while (expected.next(expectedLine))
      {
        ASSERT_TRUE(lines.next(line)) << text;
        ASSERT_EQ(expectedLine, line) << text << block;
        ASSERT_EQ(expected.lineNumber(), lines.lineNumber());
      }
      ASSERT_FALSE(lines.next(line)) << text;
    }
  }
}

TEST(FileLines, TheirNumberIsEstimated)
{
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 1000; ++i)
  {
    text += "12,34\n";
  }
  EXPECT_NEAR(1000, FileLines(folder.file("lines.txt", text), 600).expectedLines(), 20);
  EXPECT_NEAR(1000, FileLines(folder.path("lines.txt")).expectedLines(), 2);
}

TEST(FileLines, BinaryFilesAreRefused)
{
  const TemporaryFolder folder;
  const std::string path = folder.file("binary.txt", std::string("ab\0c", 4));
  expectIOError(path, "not a text file", [&] { FileLines lines(path); });
  expectIOError(
    folder.path("none.txt"), "cannot be opened", [&] { FileLines lines(folder.path("none.txt")); });
}

TEST(FileLines, ALineWithoutEndIsRefusedBeforeItFillsTheMemory)
{
  const TemporaryFolder folder;
  const std::string path =
    folder.file("long.txt", "1 2\n" + std::string(std::size_t(129) << 20, '1'));
  expectIOError(path, "line 2: is longer",
    [&]
    {
      FileLines lines(path);
      for (std::string_view line; lines.next(line);)
      {
      }
    });
}

} // namespace

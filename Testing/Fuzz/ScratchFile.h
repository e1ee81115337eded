// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippScratchFile_h
#define tippScratchFile_h

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace tipp
{
namespace test
{

/// A file of a fuzzer that is written anew for each case: in memory, where the system has such a
/// folder.
class ScratchFile
{
public:
  explicit ScratchFile(const std::string& name)
    : Name(name)
  {
    const std::filesystem::path shared = "/dev/shm";
    const std::filesystem::path folder =
      std::filesystem::exists(shared) ? shared : std::filesystem::temp_directory_path();
    std::string pattern = (folder / "tippFuzzXXXXXX").string();
    if (!mkdtemp(pattern.data()))
    {
      std::perror("a folder for the fuzzer's file");
      std::exit(2);
    }
    this->Folder = pattern;
  }
  ~ScratchFile() { std::filesystem::remove_all(this->Folder); }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Returns the file's path.
  std::string write(const std::string& bytes) const
  {
    const std::string path = (this->Folder / this->Name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }

private:
  std::filesystem::path Folder;
  std::string Name;
};

} // namespace test
} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTemporaryFolder_h
#define tippTemporaryFolder_h

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace tipp
{
namespace test
{

/// An empty folder, which is removed by the destructor.
class TemporaryFolder
{
public:
  TemporaryFolder()
    : Path(testing::TempDir() + "tippXXXXXX")
  {
    if (!mkdtemp(this->Path.data()))
    {
      throw std::runtime_error("no temporary folder");
    }
  }
  ~TemporaryFolder() { std::filesystem::remove_all(this->Path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path(const std::string& name) const { return this->Path + "/" + name; }

  /// Writes a file and returns its path.
  std::string file(const std::string& name, const std::string& content) const
  {
    std::ofstream(this->path(name), std::ios::binary) << content;
    return this->path(name);
  }

  std::size_t fileCount() const
  {
    const std::filesystem::directory_iterator entries(this->Path);
    return std::size_t(std::distance(begin(entries), end(entries)));
  }

private:
  std::string Path;
};

inline std::string contentOf(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

} // namespace test
} // namespace tipp

#endif

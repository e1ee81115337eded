// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatTesting_h
#define tippFlatTesting_h

#include "Flat/FlatMesh.h"
#include "NpyText.h"
#include "TemporaryFolder.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Writes a folder of .npy arrays, independently of the code under test.
class FlatFolderMaker
{
public:
  FlatFolderMaker() { std::filesystem::create_directory(this->path()); }

  std::string path() const { return this->Folder.path("mesh"); }
  std::string path(const std::string& name) const { return this->path() + "/" + name; }

  template <typename Value>
  std::string write(const std::string& name, const std::string& descr, const std::string& shape,
    const std::vector<Value>& values) const
  {
    std::filesystem::create_directories(std::filesystem::path(this->path(name)).parent_path());
    return this->Folder.file("mesh/" + name, npyBytes(npyHeader(descr, shape), bytesOf(values)));
  }

  /// Writes two triangles that make a unit square.
  void writeSquare() const
  {
    this->write<std::int32_t>("cells.npy", "<i4", "(2, 3)", { 0, 1, 2, 0, 2, 3 });
    this->write<double>("points.npy", "<f8", "(4, 2)", { 0, 0, 1, 0, 1, 1, 0, 1 });
  }

private:
  TemporaryFolder Folder;
};

/// Reads an array's values, independently of the code under test.
template <typename Value>
std::vector<Value> valuesOf(const RawArray& array)
{
  std::vector<Value> values(std::size_t(array.Tuples) * std::size_t(array.Components));
  std::ifstream file(array.Path, std::ios::binary);
  file.seekg(std::streamoff(array.Offset));
  file.read(reinterpret_cast<char*>(values.data()), std::streamsize(values.size() * sizeof(Value)));
  EXPECT_TRUE(file.good()) << array.Name;
  return values;
}

} // namespace test
} // namespace tipp

#endif

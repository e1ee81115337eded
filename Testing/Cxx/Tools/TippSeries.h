// SPDX-License-Identifier: BSD-3-Clause
#ifndef TippSeries_h
#define TippSeries_h

#include "Npy/NpyFile.h"
#include "NpyText.h"
#include "RunTipp.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

using Words = std::vector<std::string>;

/// A folder with the flat mesh "surge": a unit square whose level is x + 10 * step at four steps,
/// dry (-99999) at the corner (1, 1) from step 2 on, and whose depth is y.
class TippResampleSeries : public testing::Test
{
protected:
  TippResampleSeries()
  {
    std::filesystem::create_directories(this->Folder.path("surge/point_data"));
    this->write<std::int32_t>("cells", "<i4", "(2, 3)", { 0, 1, 3, 1, 2, 3 });
    this->write<double>("points", "<f8", "(4, 2)", { 0, 0, 1, 0, 1, 1, 0, 1 });
    this->write<double>("time", "<f8", "(4,)", { 0, 60, 120, 240 });
    this->write<double>("point_data/level", "<f8", "(4, 4)",
      { 0, 1, 1, 0, 10, 11, 11, 10, 20, 21, -99999, 20, 30, 31, -99999, 30 });
    this->write<double>("point_data/depth", "<f8", "(4,)", { 0, 0, 1, 1 });
  }

  template <typename Value>
  void write(const std::string& name, const std::string& descr, const std::string& shape,
    const std::vector<Value>& values) const
  {
    this->Folder.file("surge/" + name + ".npy", npyBytes(npyHeader(descr, shape), bytesOf(values)));
  }

  /// Runs `tipp resample surge` with five samples along each axis.
  Outcome run(const Words& more, const std::string& grid = "--resolution=0.25") const
  {
    Words words = { "resample", "surge", grid };
    words.insert(words.end(), more.begin(), more.end());
    return runTipp(this->Folder, words);
  }

  std::vector<float> readNpy(const std::string& name, const std::string& shape) const
  {
    const InputFile file(this->Folder.path(name));
    const NpyArray array = openNpyArray(file);
    EXPECT_EQ(shape, array.shapeText());
    EXPECT_EQ(Scalar::Float32, array.Type);
    std::vector<float> values((file.size() - array.Offset) / sizeof(float));
    file.read(array.Offset, values.data(), values.size() * sizeof(float));
    return values;
  }

  bool exists(const std::string& name) const
  {
    return std::filesystem::exists(this->Folder.path(name));
  }

  TemporaryFolder Folder;
};

} // namespace test
} // namespace tipp

#endif

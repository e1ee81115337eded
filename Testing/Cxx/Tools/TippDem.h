// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTestTippDem_h
#define tippTestTippDem_h

#include "RunTipp.h"

#include "Arrays/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

namespace tipp::test
{

using Words = std::vector<std::string>;

/// Points of hilly terrain in a square of side 100, with points at its corners.
class TippDem : public testing::Test
{
protected:
  void makePoints(int count, const std::string& name = "points.csv", unsigned seed = 1) const
  {
    tipp::Random random(seed);
    std::ofstream csv(this->Folder.path(name));
    csv.precision(17);
    csv << "x,y,z,intensity\n";
    const auto add = [&](double x, double y)
    { csv << x << "," << y << "," << height(x, y) << "," << 3 * x << "\n"; };
    for (const double corner : { 0.0, 100.0 })
    {
      add(corner, 0);
      add(corner, 100);
    }
    for (int i = 4; i < count; ++i)
    {
      const double x = 100 * random.uniform();
      add(x, 100 * random.uniform());
    }
  }
  static double height(double x, double y) { return 20 + x / 5 + 4 * std::sin(y / 9); }

  Outcome run(const Words& words) const { return runTipp(this->Folder, words); }

  /// Makes a raster of points.csv.
  void make(const std::string& output, const Words& more) const
  {
    Words words{ "dem", "points.csv", "-o", output };
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = this->run(words);
    ASSERT_EQ(0, outcome.ExitCode) << outcome.Err;
  }

  std::string content(const std::string& name) const { return contentOf(this->Folder.path(name)); }

  /// The values of an .npy file.
  std::vector<double> valuesOf(const std::string& name) const
  {
    const std::string file = this->content(name);
    unsigned short size;
    std::memcpy(&size, file.data() + 8, sizeof size);
    std::vector<double> values((file.size() - 10 - size) / sizeof(double));
    std::memcpy(values.data(), file.data() + 10 + size, sizeof(double) * values.size());
    return values;
  }

  TemporaryFolder Folder;
};

} // namespace tipp::test

#endif

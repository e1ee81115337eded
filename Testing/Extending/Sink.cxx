// SPDX-License-Identifier: BSD-3-Clause
// A sink for final triangles, which adds up their areas instead of writing a mesh.
#include "OutOfCore/OutOfCoreOptions.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/TriangleConsumer.h"
#include "Points/ReadPoints.h"

#include "TemporaryFolder.h"

#include <gtest/gtest.h>

#include <mutex>

namespace
{

using namespace tipp;

class AreaSum : public TriangleConsumer
{
public:
  double Area = 0;
  bool Ended = false;

  std::string identity() const override { return "area"; }
  std::uint64_t fileBytes(const Box2&, const std::vector<std::string>&) const override { return 0; }
  void begin(const Box2&, const std::vector<std::string>&, const std::string&) override {}

  void take(const std::string&, const double* rows, const PointRowLayout& layout, std::size_t,
    const std::vector<TriangleRange>& triangles) override
  {
    double area = 0;
    for (const TriangleRange& range : triangles)
    {
      for (const std::int32_t* t = range.Begin; t != range.Begin + 3 * range.Triangles; t += 3)
      {
        const double* const a = rows + std::size_t(t[0]) * layout.Words;
        const double* const b = rows + std::size_t(t[1]) * layout.Words;
        const double* const c = rows + std::size_t(t[2]) * layout.Words;
        area += ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])) / 2;
      }
    }
    const std::lock_guard<std::mutex> lock(this->Mutex); // several threads call take()
    this->Area += area;
  }

  bool end(const std::function<bool(double)>&) override
  {
    this->Ended = true;
    return true;
  }

private:
  std::mutex Mutex;
};

TEST(ExtendingSink, TakesEachTriangleOnce)
{
  const test::TemporaryFolder folder;
  const std::string square = folder.file("square.csv", "x,y\n0,0\n2,0\n2,2\n0,2\n1,0.5\n");
  AreaSum sum;
  OutOfCoreOptions options;
  options.CountOnly = true; // no mesh is written
  options.Consumer = &sum;
  const auto points = openPointStream({ square });
  const OutOfCoreStatistics made = triangulateOutOfCore(*points, folder.path("work.tipp"), options);
  EXPECT_EQ(4, made.Triangles);
  EXPECT_EQ(4, sum.Area);
  EXPECT_TRUE(sum.Ended);
}

} // namespace

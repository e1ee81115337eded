// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippQueryRanksTesting_h
#define tippQueryRanksTesting_h

#include "QueryTesting.h"

#include "Ranks/Communicator.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Each rank queries its own share of the points; the last rank has none.
class QueryRanksTest : public testing::Test
{
protected:
  QueryRanksTest()
    : Ranks(vtkMultiProcessController::GetGlobalController())
  {
    std::string path;
    if (this->Ranks.isFirst())
    {
      this->Folder = std::make_unique<TemporaryFolder>();
      path = this->Folder->path("mesh.tipp");
    }
    this->Path = this->Ranks.broadcast(path);
  }
  ~QueryRanksTest() override { this->Ranks.barrier(); }

  bool isLast() const
  {
    return this->Ranks.size() > 1 && this->Ranks.rank() == this->Ranks.size() - 1;
  }

  std::vector<Point3> ownOf(const std::vector<Point3>& points) const
  {
    std::vector<Point3> own;
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (std::size_t i = std::size_t(this->Ranks.rank()); i < points.size() && !this->isLast();
         i += asking)
    {
      own.push_back(points[i]);
    }
    return own;
  }

  void store(const SourceMesh& source, const std::string& tiling)
  {
    if (this->Ranks.isFirst())
    {
      test::store(source, this->Path, tiling, false);
    }
    this->Ranks.barrier();
  }

  /// This rank's share of the ids below `count`; the last rank has none.
  std::vector<std::int64_t> ownIds(std::size_t count) const
  {
    std::vector<std::int64_t> own;
    const auto asking = std::size_t(std::max(1, this->Ranks.size() - 1));
    for (auto i = std::size_t(this->Ranks.rank()); i < count && !this->isLast(); i += asking)
    {
      own.push_back(std::int64_t(i));
    }
    return own;
  }

  Communicator Ranks;
  std::unique_ptr<TemporaryFolder> Folder;
  std::string Path;
};

} // namespace test
} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "DistributedTesting.h"

#include "Comparison.h"
#include "Distributed/ConstrainRanks.h"
#include "Distributed/DistributedTriangulation.h"

#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>

namespace tipp
{
namespace test
{

std::string nameOf(Share share)
{
  const char* names[] = { "blocks", "round robin", "all on last", "uneven", "copies" };
  return names[static_cast<int>(share)];
}

int rank()
{
  return vtkMultiProcessController::GetGlobalController()->GetLocalProcessId();
}

int ranks()
{
  return vtkMultiProcessController::GetGlobalController()->GetNumberOfProcesses();
}

RankShare shareOf(const Coordinates& xy, Share share, int rank, int ranks)
{
  const std::size_t count = xy.size() / 2;
  const auto isMine = [&](std::size_t i)
  {
    switch (share)
    {
      case Share::Blocks:
        return int(i * std::size_t(ranks) / count) == rank;
      case Share::RoundRobin:
        return int(i % std::size_t(ranks)) == rank;
      case Share::AllOnLast:
        return rank == ranks - 1;
      case Share::Uneven:
        return std::min(ranks - 1,
                 int(std::sqrt(double(i) / double(count)) * (ranks - 1) + (ranks > 1))) == rank;
      case Share::Copies:
        return true;
    }
    return false;
  };
  RankShare mine;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (isMine(i))
    {
      mine.XY.insert(mine.XY.end(), { xy[2 * i], xy[2 * i + 1] });
      mine.GlobalIds.push_back(PointId(i));
    }
  }
  return mine;
}

namespace
{

/// Translates a triangle's local ids to global ids. Sets Fault if a point's coordinates are not
/// those of its global id.
class Corners
{
public:
  Corners(const Coordinates& xy, const DistributedTriangulation& result)
    : XY(xy)
    , Result(result)
  {
  }
  std::int64_t idOf(std::int64_t place)
  {
    const std::int64_t own = std::int64_t(this->Result.Owned.size());
    const PointTuples& tuples = place < own ? this->Result.Owned : this->Result.Ghosts;
    const std::size_t at = std::size_t(place < own ? place : place - own);
    const PointId id = tuples.GlobalIds[at];
    const Point2 p = tuples.Positions[at];
    if (p.x != this->XY[2 * std::size_t(id)] || p.y != this->XY[2 * std::size_t(id) + 1])
    {
      this->Fault = "global id " + std::to_string(id) + " has another point's place";
    }
    return id;
  }
  std::string Fault;

private:
  const Coordinates& XY;
  const DistributedTriangulation& Result;
};

} // namespace

Gathered triangulateShares(const Coordinates& xy, Share share, const DistributedOptions& options,
  const ConstraintSegments* constraints)
{
  Communicator box(vtkMultiProcessController::GetGlobalController());
  const RankShare mine = shareOf(xy, share, box.rank(), box.size());
  RankPoints points;
  points.Points = PointsView(mine.XY.data(), mine.GlobalIds.size(), 2);
  points.GlobalIds = mine.GlobalIds.data();
  DistributedTriangulation result = triangulateDistributed(box, points, options);
  if (constraints)
  {
    box.together([&] { constrainRanks(box, *constraints, options.Threads, result); });
  }

  Corners corners(xy, result);
  SaveArchive writer;
  std::vector<Triangle> triangles;
  const auto add = [&](const auto& ids)
  {
    for (std::size_t i = 0; i < ids.size(); i += 3)
    {
      triangles.push_back(
        canonical(corners.idOf(ids[i]), corners.idOf(ids[i + 1]), corners.idOf(ids[i + 2])));
    }
  };
  add(result.Ids32);
  add(result.Ids64);
  writer(triangles);
  writer(result.Duplicates);
  writer(result.Rejected);
  writer(corners.Fault);
  writer(result.FirstCell);
  Gathered gathered;
  std::int64_t next = 0;
  for (const Bytes& bytes : box.gather(writer.take()))
  {
    LoadArchive reader(bytes);
    const auto mesh = reader.get<std::vector<Triangle>>();
    const auto duplicates = reader.get<std::vector<Duplicate>>();
    const auto rejected = reader.get<std::vector<PointId>>();
    gathered.Mesh.insert(gathered.Mesh.end(), mesh.begin(), mesh.end());
    gathered.Duplicates.insert(gathered.Duplicates.end(), duplicates.begin(), duplicates.end());
    gathered.Rejected.insert(gathered.Rejected.end(), rejected.begin(), rejected.end());
    const std::string fault = reader.get<std::string>();
    if (!fault.empty())
    {
      gathered.Faults.push_back(fault);
    }
    if (reader.get<std::int64_t>() != next)
    {
      gathered.Faults.push_back("triangles are not numbered without gaps");
    }
    next += std::int64_t(mesh.size());
  }
  std::sort(gathered.Mesh.begin(), gathered.Mesh.end());
  std::sort(gathered.Rejected.begin(), gathered.Rejected.end());
  std::sort(gathered.Duplicates.begin(), gathered.Duplicates.end(),
    [](const Duplicate& a, const Duplicate& b) { return a.Point < b.Point; });
  box.barrier();
  return gathered;
}

testing::AssertionResult matches(
  const Coordinates& xy, const Gathered& result, const Reference& expected)
{
  if (!result.Faults.empty())
  {
    return testing::AssertionFailure() << result.Faults.front();
  }
  Ids representative(xy.size() / 2);
  for (std::size_t i = 0; i < representative.size(); ++i)
  {
    representative[i] = std::int64_t(i);
  }
  for (const Duplicate& duplicate : result.Duplicates)
  {
    representative[std::size_t(duplicate.Point)] = duplicate.Representative;
  }
  for (const PointId rejected : result.Rejected)
  {
    representative[std::size_t(rejected)] = -1;
  }
  for (std::size_t i = 0; i < representative.size(); ++i)
  {
    if (representative[i] != expected.Representative[i])
    {
      return testing::AssertionFailure()
        << "point " << i << " is represented by " << representative[i] << " instead of "
        << expected.Representative[i];
    }
  }
  return sameTriangles(xy, result.Mesh, expected.Mesh);
}

const Reference& cachedReference(const std::string& key, const Coordinates& xy)
{
  static std::string of;
  static Reference cached;
  if (of != key)
  {
    cached = reference(xy);
    of = key;
  }
  return cached;
}

} // namespace test
} // namespace tipp

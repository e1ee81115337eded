// SPDX-License-Identifier: BSD-3-Clause
// The triangles are those of CGAL and the pieces follow their format, for every input, number of
// threads and size of pieces.
#include "OutOfCoreTesting.h"

#include <cctype>

namespace
{

using namespace tipp;
using namespace tipp::test;

class OutOfCoreExactness : public testing::TestWithParam<std::string>
{
};

std::string nameOf(const testing::TestParamInfo<std::string>& info)
{
  std::string name = info.param;
  for (char& c : name)
  {
    c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return name;
}

TEST_P(OutOfCoreExactness, IsCgalsForAllPiecesAndThreads)
{
  const Coordinates xy = makePointSet(GetParam(), 3000);
  const Reference expected = reference(xy);
  for (const std::int64_t piece : { 0, 100, 700 })
  {
    for (const int threads : { 1, 3 })
    {
      const TemporaryFolder folder;
      OutOfCoreOptions options;
      options.PiecePoints = piece;
      options.PartitionPoints = piece / 4;
      options.Threads = threads;
      const OutOfCoreStatistics statistics = triangulateFile(folder, xy, options);
      ASSERT_TRUE(meshMatches(folder.path("mesh.tipp"), xy, expected))
        << piece << " points a piece, " << threads << " threads";
      ASSERT_EQ(std::int64_t(expected.Mesh.size()), statistics.Triangles);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, OutOfCoreExactness,
  testing::Values("uniform", "clustered", "kuzmin", "lattice", "lattice-shuffled", "coast",
    "lattice-tenths", "lattice-jittered", "circle", "cocircular", "collinear-and-one",
    "survey-lines", "duplicates", "duplicate-lattice", "tiny-1e-300", "denormal", "huge-1e300",
    "steps-at-1e12", "largest-doubles", "negative", "one-far-away", "two-clusters", "parabola",
    "spiral", "sorted", "with-rejected"),
  nameOf);

class OutOfCorePieces : public testing::TestWithParam<std::string>
{
};

TEST_P(OutOfCorePieces, FollowTheFormat)
{
  const Coordinates xy = makePointSet(GetParam(), 1200);
  const TemporaryFolder folder;
  OutOfCoreOptions options;
  options.PiecePoints = 100;
  options.PartitionPoints = 40;
  triangulateFile(folder, xy, options);
  expectBelongs(folder.path("mesh.tipp"), sourceOf(folder.path("mesh.tipp"), xy));
}

INSTANTIATE_TEST_SUITE_P(PointSets, OutOfCorePieces,
  testing::Values("uniform", "clustered", "lattice", "coast", "duplicates"), nameOf);

} // namespace

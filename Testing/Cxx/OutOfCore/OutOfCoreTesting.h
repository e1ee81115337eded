// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOutOfCoreTesting_h
#define tippOutOfCoreTesting_h

#include "Comparison.h"
#include "Files/IOError.h"
#include "MeshChecks.h"
#include "Npy/NpyFile.h"
#include "OutOfCore/InputPasses.h"
#include "OutOfCore/OutOfCoreTriangulation.h"
#include "OutOfCore/PiecePlan.h"
#include "OutOfCore/ScratchFiles.h"
#include "OutOfCore/SpilledPoints.h"
#include "Partitioned/GrowingPiece.h"
#include "TemporaryFolder.h"
#include "Triangulation/InputSurvey.h"

#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Writes the points to a .npy file in the folder, and triangulates the file into mesh.tipp there.
OutOfCoreStatistics triangulateFile(
  const TemporaryFolder& folder, const Coordinates& xy, const OutOfCoreOptions& options);

/// The triangles of all pieces, each from its owner, as sorted global ids.
Triangles trianglesOfMesh(const std::string& path);

/// Whether the mesh is that of the reference. The failure shows the first difference.
testing::AssertionResult meshMatches(
  const std::string& path, const Coordinates& xy, const Reference& expected);

/// The mesh with its cells in the order of their global ids, so that MeshChecks can check the
/// pieces against it.
SourceMesh sourceOf(const std::string& path, const Coordinates& xy);

/// Makes the steps of a run one by one, with pieces of 300 points and partitions of 80.
class Steps
{
public:
  explicit Steps(const Coordinates& xy, std::size_t block = 1 << 14)
  {
    writePoints(this->Folder.path("points.npy"), xy);
    this->Stream = openPointStream({ this->Folder.path("points.npy") });
    this->Options.PiecePoints = 300;
    this->Options.PartitionPoints = 80;
    this->Survey =
      InputPasses(*this->Stream, nullptr, { block, 1 << 10, 2, [](std::int64_t) {} }).survey();
    this->Rows.Words = 3;
  }

  MemoryPlan memory() const { return MemoryPlan(this->Options, this->Rows.Words, false); }
  PiecePlan plan() const
  {
    return PiecePlan(this->Survey, this->Options, this->memory(), this->Rows.Words, 1);
  }
  SpilledPoints spill(PiecePlan& plan)
  {
    const SpilledPart all = spillPart(*this->Stream, this->Survey.Factor, plan,
      this->Folder.path("spill"), 0, { 1000, 1 << 10, 2, [](std::int64_t) {} });
    placeInitialPoints({ all }, this->Survey, plan);
    return SpilledPoints(this->Folder.path("spill"), this->Rows.Words, { all.Rows });
  }

  TemporaryFolder Folder;
  std::unique_ptr<PointStream> Stream;
  OutOfCoreOptions Options;
  InputSurvey Survey;
  PointRowLayout Rows;
};

/// A stream that fails after a given number of passes.
class BrokenStream : public PointStream
{
public:
  BrokenStream(std::unique_ptr<PointStream> points, int goodPasses)
    : Points(std::move(points))
    , PassesLeft(goodPasses)
  {
  }

  bool next(PointBlock& block, std::size_t most) override
  {
    if (this->PassesLeft < 0)
    {
      throw IOError("points", "cannot be read.");
    }
    return this->Points->next(block, most);
  }
  void rewind() override
  {
    --this->PassesLeft;
    this->Points->rewind();
  }
  std::int64_t divisible() const override { return this->Points->divisible(); }
  void limitTo(std::int64_t first, std::int64_t end) override { this->Points->limitTo(first, end); }
  std::vector<std::string> columns() const override { return this->Points->columns(); }
  std::string identity() const override { return this->Points->identity(); }

private:
  const std::unique_ptr<PointStream> Points;
  int PassesLeft;
};

} // namespace test
} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#include "QueryTesting.h"

#include "Files/IOError.h"
#include "Query/Queries.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>

using namespace tipp;
using namespace tipp::test;

namespace
{

/// Every kind of query.
std::vector<std::function<void(const ResidentMesh&)>> questions()
{
  const std::vector<Point3> points = { { 0.2, 0.2, 0.2 }, { 0.8, 0.3, 0.6 }, { 1.4, 0.5, 0.5 },
    { 0.7, 0.9, 0.4 }, { 0.1, 0.8, 0.9 } };
  const std::vector<std::int64_t> ids = { 0, 7, 31 };
  const Region region = { { { 0.1, 0.2, 0.1 }, { 0.9, 0.8, 0.9 } }, {} };
  return {
    [=](const ResidentMesh& mesh)
    {
      AnswerOptions options;
      options.Arrays = mesh.names();
      options.Weights = true;
      mesh.answer(points.data(), std::int64_t(points.size()), options);
    },
    [=](const ResidentMesh& mesh) { closestTo(mesh, points.data(), std::int64_t(points.size())); },
    [=](const ResidentMesh& mesh) { neighborsOf(mesh, ids); },
    [=](const ResidentMesh& mesh) { starsOf(mesh, ids); },
    [=](const ResidentMesh& mesh) { ringsOfPoints(mesh, ids, 3); },
    [=](const ResidentMesh& mesh) { ringsOfCells(mesh, ids, 3); },
    [=](const ResidentMesh& mesh) { boundaryOf(mesh); },
    [=](const ResidentMesh& mesh) { componentsOf(mesh); },
    [=](const ResidentMesh& mesh) {
      contoursOf(mesh, "value", 0, { 0.5, 1 });
    },
    [=](const ResidentMesh& mesh) { rangeOf(mesh, "value", 0); },
    [=](const ResidentMesh& mesh) { profileOf(mesh, points, 0, mesh.names()); },
    [=](const ResidentMesh& mesh) { descentsOf(mesh, points, "value", 0); },
    [=](const ResidentMesh& mesh) { cellsIn(mesh, region, false); },
    [=](const ResidentMesh& mesh) { pointsIn(mesh, region); },
    [=](const ResidentMesh& mesh)
    {
      const Zone zone = { { { { 0.1, 0.2 }, { 0.9, 0.3 }, { 0.4, 0.9 } }, false } };
      statisticsOf(mesh, { zone }, "value", 0, 0.5);
    },
  };
}

/// Whether the query fails with one sentence.
bool isRefused(const std::function<void()>& ask)
{
  try
  {
    ask();
    return false;
  }
  catch (const IOError& error)
  {
    const std::string message = error.what();
    EXPECT_LT(10U, message.size());
    EXPECT_EQ('.', message.back()) << message;
    EXPECT_EQ(std::string::npos, message.find('\n')) << message;
    return true;
  }
}

std::string contentOfFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// Truncates the content, appends a part of it, or changes one bit.
std::string damaged(std::string content, std::mt19937& random)
{
  const std::size_t at = random() % std::max<std::size_t>(content.size(), 1);
  switch (random() % 4)
  {
    case 0:
      return content.substr(0, at);
    case 1:
      return content + content.substr(at);
    default:
      content[at] = char(content[at] ^ (1 << random() % 8));
      return content;
  }
}

void expectRefusals(const SourceMesh& source, const std::string& tiling, bool duplicate)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("mesh.tipp");
  store(source, path, tiling, duplicate);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
  {
    if (entry.is_regular_file())
    {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  ASSERT_LT(4U, files.size());
  std::mt19937 random(9);
  int refusals = 0;
  for (int round = 0; round < 60; ++round)
  {
    const std::string& file = files[std::size_t(round) % files.size()];
    SCOPED_TRACE(file + ", round " + std::to_string(round));
    const std::string before = contentOfFile(file);
    // In every second round, the mesh is opened before it is damaged.
    const bool isOpen = round % 2 == 0;
    ResidentOptions options;
    options.Threads = 2;
    options.MemoryLimit = 40000;
    std::unique_ptr<ResidentMesh> mesh =
      isOpen ? std::make_unique<ResidentMesh>(path, options) : nullptr;
    std::ofstream(file, std::ios::binary) << damaged(before, random);
    for (const auto& ask : questions())
    {
      refusals += isRefused(
        [&]
        {
          mesh = mesh ? std::move(mesh) : std::make_unique<ResidentMesh>(path, options);
          ask(*mesh);
        });
    }
    std::ofstream(file, std::ios::binary) << before;
  }
  EXPECT_LT(200, refusals);
}

} // namespace

TEST(DamagedStore, OfTrianglesIsRefusedInOneSentenceByEveryQuestion)
{
  expectRefusals(makeSource(latticeTriangles(8, 0.3)), "grid:2x2", false);
  expectRefusals(makeSource(latticeTriangles(8, 0.3)), "quadtree:30", true);
}

TEST(DamagedStore, OfTetrahedraIsRefusedInOneSentenceByEveryQuestion)
{
  expectRefusals(makeSource(latticeTetrahedra(3, 0.3)), "grid:2x2x1", false);
}

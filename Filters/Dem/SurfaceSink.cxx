// SPDX-License-Identifier: BSD-3-Clause
#include "Dem/SurfaceSink.h"

#include "Constraints/OnDisk/ConstrainedPoints.h"
#include "Dem/DemBands.h"
#include "Dem/TerrainSampler.h"
#include "Files/IOError.h"
#include "OutOfCore/ScratchFiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

/// The suffix of files with surface values, appended to the run's own path.
constexpr const char* answersSuffix = ".surface.";

struct Answer
{
  SurfaceTriangle Triangle;
  std::vector<double> Values; ///< one per column
};

/// Surface values, by index of the position.
using Answers = std::map<std::size_t, Answer>;

void choose(std::size_t position, Answer answer, Answers& answers)
{
  const auto known = answers.find(position);
  if (known == answers.end())
  {
    answers.emplace(position, std::move(answer));
  }
  else if (answer.Triangle.isBefore(known->second.Triangle))
  {
    known->second = std::move(answer);
  }
}

void save(const Answers& answers, SaveArchive& archive)
{
  archive(std::uint64_t(answers.size()));
  for (const auto& [position, answer] : answers)
  {
    archive(std::uint64_t(position), answer.Triangle.Corners, answer.Values);
  }
}

void load(const std::string& path, Answers& answers)
{
  const Bytes bytes = readCheckedFile(path);
  LoadArchive archive(bytes);
  std::uint64_t count = 0;
  archive(count);
  for (std::uint64_t i = 0; i < count; ++i)
  {
    std::uint64_t position = 0;
    std::array<Point2, 3> corners{};
    std::vector<double> values;
    archive(position, corners, values);
    choose(position, { SurfaceTriangle(corners), std::move(values) }, answers);
  }
}

std::vector<Point2> positionsOf(const TableConstraints& constraints)
{
  std::vector<Point2> positions;
  for (const ConstraintTable* const table : { &constraints.Lines, &constraints.Boundary })
  {
    for (std::size_t i = 0; i < table->XY.size(); i += 2)
    {
      positions.push_back({ table->XY[i], table->XY[i + 1] });
    }
  }
  return positions;
}

} // namespace

bool needsSurface(const TableConstraints& constraints, const std::vector<std::string>& bands)
{
  const auto lacksHeights = [](const ConstraintTable& table)
  {
    return 2 * table.Height.size() < table.XY.size() ||
      std::any_of(
        table.Height.begin(), table.Height.end(), [](double height) { return std::isnan(height); });
  };
  const std::vector<std::string> columns = columnsForBands(bands);
  return lacksHeights(constraints.Lines) || lacksHeights(constraints.Boundary) ||
    !std::all_of(columns.begin(), columns.end(), isHeightColumn);
}

SurfaceSink::SurfaceSink(const TableConstraints& constraints)
  : Identity("surface below " + identityOf(constraints))
  , Positions(positionsOf(constraints))
  , Wanted(this->Positions)
{
}

std::uint64_t SurfaceSink::fileBytes(const Box2&, const std::vector<std::string>& columns) const
{
  return (7 + columns.size()) * sizeof(double) * this->Positions.size();
}

void SurfaceSink::begin(
  const Box2&, const std::vector<std::string>& columns, const std::string& files)
{
  this->Columns = columns.size();
  this->Files = files;
}

void SurfaceSink::take(const std::string& name, const double* rows, const PointRowLayout& layout,
  std::size_t points, const std::vector<TriangleRange>& triangles)
{
  if (!this->Wanted.meets(boundsOf(rows, layout.Words, points)))
  {
    return;
  }
  Answers answers;
  for (const TriangleRange& run : triangles)
  {
    for (std::size_t t = 0; t < run.Triangles; ++t)
    {
      const std::int32_t* const corners = run.Begin + 3 * t;
      const auto rowOf = [&](std::size_t corner)
      { return rows + std::size_t(corners[corner]) * layout.Words; };
      const std::array<Point2, 3> p{ Point2{ rowOf(0)[0], rowOf(0)[1] },
        Point2{ rowOf(1)[0], rowOf(1)[1] }, Point2{ rowOf(2)[0], rowOf(2)[1] } };
      this->Wanted.visitInside(p,
        [&](std::size_t i, Point2 position)
        {
          Answer answer{ SurfaceTriangle(p), {} };
          for (std::size_t c = 0; c < this->Columns; ++c)
          {
            answer.Values.push_back(answer.Triangle.valueAt(
              position, [&](std::size_t corner) { return rowOf(corner)[2 + c]; }));
          }
          choose(i, std::move(answer), answers);
        });
    }
  }
  if (!answers.empty())
  {
    writeCheckedFile(this->Files + answersSuffix + name,
      [&answers](SaveArchive& archive) { save(answers, archive); });
  }
}

bool SurfaceSink::end(const std::function<bool(double)>& progress)
{
  Answers answers;
  for (const std::string& path : filesBeginning(this->Files + answersSuffix))
  {
    load(path, answers);
  }
  this->Values.assign(this->Columns, std::vector<double>(this->Positions.size(), std::nan("")));
  for (const auto& [position, answer] : answers)
  {
    for (std::size_t c = 0; c < this->Columns; ++c)
    {
      this->Values[c].at(position) = answer.Values.at(c);
    }
  }
  return progress(1);
}

std::vector<std::string> filesBeginning(const std::string& path)
{
  const fs::path begin(path);
  const std::string prefix = begin.filename().string();
  std::vector<std::string> files;
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(begin.parent_path(), failure))
  {
    if (entry.path().filename().string().compare(0, prefix.size(), prefix) == 0)
    {
      files.push_back(entry.path().string());
    }
  }
  if (failure)
  {
    throw IOError(begin.parent_path().string(), "cannot be read (" + failure.message() + ").");
  }
  return files;
}

} // namespace tipp

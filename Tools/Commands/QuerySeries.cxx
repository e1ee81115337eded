// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/QuerySeries.h"

#include "Commands/OpenSeries.h"
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/PendingOutput.h"
#include "Flat/FlatMesh.h"
#include "Npy/NpyFile.h"
#include "Parallel/ParallelFor.h"
#include "Series/ResampleSeries.h"
#include "Series/SeriesAtPoints.h"
#include "Series/StepSelection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

namespace tipp
{
namespace
{

/// Receives the values of all stations, step by step.
class StationTable
{
public:
  virtual ~StationTable() = default;
  /// `values`: by variable and station.
  virtual void add(double time, const std::vector<std::vector<double>>& values) = 0;
  virtual void close() = 0;
};

/// A line for each time and station.
class StationLines : public StationTable
{
public:
  StationLines(const std::string& path, const PathState& before, std::vector<Point3> stations,
    const std::vector<std::string>& names, bool hasTimes, const std::string& timeName)
    : Pending(path, before)
    , Stations(std::move(stations))
    , HasTimes(hasTimes)
  {
    std::string header = (hasTimes ? quotedField(timeName) + "," : "") + "station,x,y";
    for (const std::string& name : names)
    {
      header += "," + quotedField(name);
    }
    this->write(header + "\n");
  }

  void add(double time, const std::vector<std::vector<double>>& values) override
  {
    std::string lines;
    const auto out = std::back_inserter(lines);
    for (std::size_t i = 0; i < this->Stations.size(); ++i)
    {
      if (this->HasTimes)
      {
        fmt::format_to(out, "{},", time);
      }
      fmt::format_to(out, "{},{},{}", i, this->Stations[i].x, this->Stations[i].y);
      for (const std::vector<double>& of : values)
      {
        std::isnan(of[i]) ? fmt::format_to(out, ",") : fmt::format_to(out, ",{}", of[i]);
      }
      lines += '\n';
    }
    this->write(lines);
  }

  void close() override { this->Pending.commit(); }

private:
  void write(const std::string& text)
  {
    this->Pending.file().write(this->End, text.data(), text.size());
    this->End += text.size();
  }

  PendingFile Pending;
  std::vector<Point3> Stations;
  bool HasTimes;
  std::uint64_t End = 0;
};

/// An array of steps x stations x variables.
class StationArray : public StationTable
{
public:
  StationArray(
    const std::string& path, const PathState& before, const std::vector<std::int64_t>& shape)
    : Writer(path, "<f8", shape, before)
  {
  }

  void add(double, const std::vector<std::vector<double>>& values) override
  {
    std::vector<double> row;
    for (std::size_t i = 0; i < values.front().size(); ++i)
    {
      for (const std::vector<double>& of : values)
      {
        row.push_back(of[i]);
      }
    }
    this->Writer.write(row.data(), row.size() * sizeof(double));
  }

  void close() override { this->Writer.close(); }

private:
  NpyWriter Writer;
};

std::vector<std::size_t> variablesOf(const MeshSeries& series, const StationArguments& arguments)
{
  std::vector<std::size_t> variables;
  for (const std::string& name : arguments.Arrays)
  {
    variables.push_back(findSeriesVariable(series, name));
  }
  for (std::size_t i = 0; arguments.Arrays.empty() && i < series.Variables.size(); ++i)
  {
    if (series.Variables[i].Varies || series.Times.empty())
    {
      variables.push_back(i);
    }
  }
  if (variables.empty())
  {
    throw IOError(series.Path, "has no values at its nodes or cells.");
  }
  return variables;
}

std::vector<Point3> readStations(const StationArguments& arguments)
{
  PointOptions reading = arguments.Reading;
  reading.Threads = arguments.Threads;
  const PointTable table = readPointsShare({ arguments.Points }, reading, 0, 1);
  reportLeftOut(table.LeftOut, table.ThinnedOut);
  reportTables(table.Reports);
  std::vector<Point3> stations(table.size());
  for (std::size_t i = 0; i < stations.size(); ++i)
  {
    stations[i] = { table.XY[2 * i], table.XY[2 * i + 1], 0 };
  }
  return stations;
}

/// The name of the column of times, with their unit in brackets, as tables have it.
std::string timeName(const MeshSeries& series)
{
  const std::string& calendar = series.Calendar;
  const bool isUsual = calendar.empty() || calendar == "standard" || calendar == "gregorian" ||
    calendar == "proleptic_gregorian";
  return series.TimeUnits.empty()
    ? "time"
    : "time (" + series.TimeUnits + (isUsual ? "" : ", calendar " + calendar) + ")";
}

/// Throws IOError if all stations are outside of the mesh.
void requireInside(
  const SeriesAtPoints& located, const std::vector<Point3>& stations, const StationArguments& of)
{
  const auto outside = std::count(located.triangles().begin(), located.triangles().end(), -1);
  if (stations.empty() || outside < std::int64_t(stations.size()))
  {
    return;
  }
  Box2 box = Box2::empty();
  for (const Point3& station : stations)
  {
    box.extend(Point2{ station.x, station.y });
  }
  throw IOError(of.Points,
    "has no point in the mesh: the points have " + textOf(box) +
      ", and the triangles of the mesh " + textOf(located.bounds()) +
      "; give points in the units and the reference system of the mesh.");
}

std::unique_ptr<StationTable> createTable(const StationArguments& arguments,
  const PathState& before, const MeshSeries& series, const std::vector<std::size_t>& variables,
  const std::vector<Point3>& stations, std::size_t steps)
{
  if (isOpenedBy(arguments.Output, Opener::Npy))
  {
    return std::make_unique<StationArray>(arguments.Output, before,
      std::vector<std::int64_t>{
        std::int64_t(steps), std::int64_t(stations.size()), std::int64_t(variables.size()) });
  }
  std::vector<std::string> names;
  for (const std::size_t i : variables)
  {
    names.push_back(series.Variables[i].Name);
  }
  return std::make_unique<StationLines>(
    arguments.Output, before, stations, names, !series.Times.empty(), timeName(series));
}

} // namespace

bool isStationRun(const StationArguments& arguments)
{
  const bool isFolder = isFlatMesh(arguments.Mesh) && !isOpenedBy(arguments.Mesh, Opener::Vtk);
  return isFolder || isMeshSeries(arguments.Mesh) || !isOneStep(arguments.Step) ||
    !arguments.Values.empty() || arguments.NoData;
}

int runStations(const StationArguments& arguments)
{
  std::vector<std::string> inputs = arguments.Values;
  inputs.insert(inputs.end(), { arguments.Points, arguments.Mesh });
  const PathState before = requireWritable(arguments.Output, "", inputs);
  const std::unique_ptr<MeshSeries> series =
    openSeries(arguments.Mesh, { arguments.Values, arguments.Reading.Wrap != 0 });
  const std::vector<std::size_t> variables = variablesOf(*series, arguments);
  const std::vector<std::size_t> steps =
    parseSteps(series->Times.empty() || !arguments.Step.empty() ? arguments.Step : "all",
      series->Times.size(), series->Path);
  const std::vector<Point3> stations = readStations(arguments);
  const SeriesAtPoints located(
    *series, stations, arguments.Reading.Wrap != 0, threadCount(arguments.Threads));
  requireInside(located, stations, arguments);
  const std::unique_ptr<StationTable> table =
    createTable(arguments, before, *series, variables, stations, steps.size());
  ProgressBar bar("reading");
  std::vector<double> read;
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    std::vector<std::vector<double>> values;
    for (const std::size_t variable : variables)
    {
      if (isInterrupted())
      {
        return reportInterrupt();
      }
      series->readAt(variable, steps[i], located.stored(series->Variables[variable]), read);
      if (arguments.NoData)
      {
        std::replace(
          read.begin(), read.end(), *arguments.NoData, std::numeric_limits<double>::quiet_NaN());
      }
      values.push_back(located.valuesOf(series->Variables[variable], read));
    }
    table->add(series->Times.empty() ? 0 : series->Times[steps[i]], values);
    bar.update(double(i + 1) / double(steps.size()));
  }
  table->close();
  fmt::print("{} stations, {} outside of the mesh, {}, in {}\n", stations.size(),
    std::count(located.triangles().begin(), located.triangles().end(), -1),
    counted(std::int64_t(steps.size()), "step", "steps"), arguments.Output);
  return Success;
}

} // namespace tipp

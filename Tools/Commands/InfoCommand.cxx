// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/Commands.h"

#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/SeriesReport.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/TemporaryPaths.h"
#include "Flat/FlatMesh.h"
#include "Las/CopcHierarchy.h"
#include "Las/LasHeader.h"
#include "Las/LazFile.h"
#include "OpenCL/Devices.h"
#include "Parallel/Poll.h"
#include "Partitioned/PartitionedMesh.h"
#include "Partitioning/MeshTiling.h"
#include "Points/ReadPoints.h"
#include "Predicates/Geometry.h"
#include "Ranks/Communicator.h"
#include "Reading/PieceSource.h"
#include "Series/MeshSeries.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* footer =
  R"(Reads all points of the files, in blocks, as 'tipp delaunay' does. Prints their number, their
bounds, the columns and their ranges, the coordinate reference system, the number of
duplicates, and a resolution for 'tipp dem' that gives about one point per pixel. Of a COPC
file it prints the levels, each with its points. Of text it prints which columns are x, y
and z. Of the output of a model, in NetCDF or SELAFIN, it prints the mesh, the variables with
their units, the time steps, and what is left out and why; of a flat or partitioned mesh its
cells, arrays and time steps, with the units that it states. A line 'check' names what may not
be meant, and the option for it.

Examples:
  tipp info tile.las
  tipp info tiles/*.las --class 2
  tipp info tile.copc.laz --spacing 10
  tipp info fort.63.nc
)";

struct InfoArguments
{
  std::vector<std::string> Inputs;
  PointOptions Points;
};

struct ValueRange
{
  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();
  std::int64_t Missing = 0; ///< number of values that are not finite

  void add(double value)
  {
    if (!std::isfinite(value))
    {
      ++this->Missing;
      return;
    }
    this->Low = std::min(this->Low, value);
    this->High = std::max(this->High, value);
  }

  std::string text() const
  {
    const std::string missing = this->Missing > 0 ? fmt::format(", {} missing", this->Missing) : "";
    return this->Low <= this->High ? fmt::format("{} to {}{}", this->Low, this->High, missing)
                                   : "no value";
  }
};

constexpr std::size_t mostCompared = 20000000;

/// Heights, and what is suspicious about them.
class HeightCheck
{
public:
  void add(const std::vector<double>& values)
  {
    for (const double value : values)
    {
      this->Marks += isNoDataMark(value) ? 1 : 0;
      if (std::isfinite(value) && this->Sample.size() < mostSampled)
      {
        this->Sample.push_back(value);
      }
    }
  }

  /// Sentences; the column's name begins them.
  std::vector<std::string> sentences()
  {
    std::vector<std::string> found;
    if (this->Marks > 0)
    {
      found.push_back(
        fmt::format("holds {} values that mark missing ones elsewhere, such as -9999; "
                    "give --input-nodata with the value",
          this->Marks));
    }
    std::vector<double>& sorted = this->Sample;
    std::sort(sorted.begin(), sorted.end());
    if (sorted.size() > 2 && sorted.front() == 0 && sorted.back() == 0)
    {
      found.emplace_back("is 0 everywhere; choose the heights with --z");
    }
    else if (const std::int64_t far = this->countFar(); far > 0)
    {
      found.push_back(fmt::format("has {} values far from all others ({} to {}, while half of them "
                                  "lie in {} to {}); give --input-nodata if they mark missing ones",
        far, sorted.front(), sorted.back(), this->quartile(1), this->quartile(3)));
    }
    return found;
  }

private:
  double quartile(std::size_t quarter) const
  {
    return this->Sample[(this->Sample.size() - 1) * quarter / 4];
  }

  /// The number of values farther from the middle half than twenty times its width.
  std::int64_t countFar() const
  {
    constexpr std::size_t least = 8;
    constexpr double widths = 20;
    if (this->Sample.size() < least)
    {
      return 0;
    }
    const double far = widths * (this->quartile(3) - this->quartile(1));
    const double low = this->quartile(1) - far;
    const double high = this->quartile(3) + far;
    return far > 0 ? std::count_if(this->Sample.begin(), this->Sample.end(),
                       [&](double value) { return value < low || value > high; })
                   : 0;
  }

  static constexpr std::size_t mostSampled = 4000000;

  std::int64_t Marks = 0;
  std::vector<double> Sample; ///< sorted by sentences()
};

/// Whether values are whole numbers that count up from point to point.
class CountCheck
{
public:
  void add(double value)
  {
    this->Counts =
      this->Counts && std::floor(value) == value && (this->Values == 0 || value == this->Last + 1);
    this->Last = value;
    ++this->Values;
  }
  bool counts() const { return this->Counts && this->Values > 3; }

private:
  bool Counts = true;
  double Last = 0;
  std::int64_t Values = 0;
};

struct Summary
{
  std::int64_t Points = 0;
  std::int64_t NotFinite = 0;
  ValueRange X;
  ValueRange Y;
  std::vector<ValueRange> Columns;
  CountCheck XCount;
  CountCheck YCount;
  HeightCheck Heights;
  /// The finite points, to find duplicates; empty if there are too many.
  std::vector<Point2> Compared;
};

Summary read(PointStream& stream)
{
  constexpr std::size_t block = std::size_t(1) << 18;
  Summary summary;
  summary.Columns.resize(stream.columns().size());
  const std::size_t height = findElevation(stream.columns());
  forEachBlock(stream, block,
    [&](const PointBlock& points)
    {
      poll();
      for (std::size_t i = 0; i < points.size(); ++i)
      {
        const Point2 p{ points.XY[2 * i], points.XY[2 * i + 1] };
        const bool isGood = isFinite(p);
        summary.NotFinite += isGood ? 0 : 1;
        summary.X.add(p.x);
        summary.Y.add(p.y);
        summary.XCount.add(p.x);
        summary.YCount.add(p.y);
        if (isGood && summary.Compared.size() <= mostCompared)
        {
          summary.Compared.push_back(p);
        }
      }
      for (std::size_t column = 0; column < points.Columns.size(); ++column)
      {
        for (const double value : points.Columns[column])
        {
          summary.Columns[column].add(value);
        }
      }
      if (height < points.Columns.size())
      {
        summary.Heights.add(points.Columns[height]);
      }
      summary.Points += std::int64_t(points.size());
    });
  return summary;
}

std::string duplicatesOf(std::vector<Point2>& points)
{
  if (points.size() > mostCompared)
  {
    return fmt::format("not counted: more than {} points", mostCompared);
  }
  std::sort(points.begin(), points.end(),
    [](Point2 a, Point2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  const auto end = std::unique(
    points.begin(), points.end(), [](Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; });
  return std::to_string(points.end() - end);
}

/// Returns the nearest number that is 1, 2 or 5 times a power of ten.
double roundNumber(double value)
{
  const double power = std::pow(10, std::floor(std::log10(value)));
  const double digit = value / power;
  return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

/// Prints the octree of a COPC file, and its levels.
void describeCopc(const std::string& path, const LasHeader& header)
{
  const CopcInfo info = readCopcInfo(path, header);
  const std::vector<CopcNode> nodes =
    findCopcNodes(path, header, LazFile(path, header).chunks(), {});
  const Box3 box = info.bounds();
  fmt::print("  COPC: {} nodes with points; octree x {} to {}, y {} to {}, z {} to {}\n",
    nodes.size(), box.Min.x, box.Max.x, box.Min.y, box.Max.y, box.Min.z, box.Max.z);
  struct Level
  {
    std::size_t Nodes = 0;
    std::uint64_t Points = 0;
  };
  std::map<int, Level> levels;
  for (const CopcNode& node : nodes)
  {
    ++levels[node.Level].Nodes;
    levels[node.Level].Points += node.Points;
  }
  for (const auto& [number, level] : levels)
  {
    fmt::print("  level {}: spacing {:.3g}, {} nodes, {} points\n", number,
      std::ldexp(info.Spacing, -number), level.Nodes, level.Points);
  }
}

void describeLas(const std::string& path, const LasSelection& selection)
{
  const LasHeader header = readLasHeader(path, selection);
  fmt::print("{}: LAS 1.{}, point format {}{}, {} points\n", path, header.Minor, header.Format,
    header.Compressed ? ", compressed" : "", header.Points);
  if (!header.Copc.empty())
  {
    try
    {
      describeCopc(path, header);
    }
    catch (const IOError& error) // all points can be read without the hierarchy
    {
      fmt::print("check       {}\n", error.what());
    }
  }
  const ReferenceSystem system = understandCrs(header.Crs);
  if (!system.Problem.empty())
  {
    fmt::print("  {}; name the right one with --crs if an output needs it\n", system.Problem);
  }
}

void printTables(const std::vector<TableReport>& reports)
{
  for (const TableReport& report : reports)
  {
    if (!report.Columns.empty())
    {
      fmt::print("{}: {}\n", shownPath(report.Path), report.Columns);
    }
    for (const std::string& remark : report.Remarks)
    {
      fmt::print("  {}\n", remark);
    }
  }
}

/// Prints what is suspicious about the points, and which option mends it.
void printChecks(const std::vector<TableReport>& reports, const std::vector<std::string>& columns,
  Summary& summary)
{
  const auto print = [](const std::string& sentence) { fmt::print("check       {}\n", sentence); };
  for (const TableReport& report : reports)
  {
    for (const std::string& warning : report.Warnings)
    {
      print(shownPath(report.Path) + ": " + warning);
    }
  }
  if (summary.XCount.counts() || summary.YCount.counts())
  {
    print(std::string(summary.XCount.counts() ? "x" : "y") +
      " counts the points, as a number of the point does; choose the columns with --x, --y and "
      "--z.");
  }
  const std::size_t height = findElevation(columns);
  if (height == columns.size())
  {
    print(columns.empty() ? "there are no heights."
                          : "there are no heights; choose a column with --z.");
    return;
  }
  for (const std::string& sentence : summary.Heights.sentences())
  {
    print(columns[height] + " " + sentence + ".");
  }
}

int describePoints(const InfoArguments& arguments)
{
  for (const std::string& path : arguments.Inputs)
  {
    if (isOpenedBy(path, Opener::Las))
    {
      describeLas(path, arguments.Points.Las);
    }
  }
  PointOptions options = arguments.Points;
  options.Threads = 0;
  options.AnyCrs = true;
  const auto stream = openPointStream(arguments.Inputs, options);
  Summary summary = read(*stream);
  if (isInterrupted())
  {
    return reportInterrupt();
  }
  requireInBounds(arguments.Inputs, options, summary.Points, stream->readFigures());
  reportRead(stream->readFigures());
  reportLeftOut(stream->leftOut(), stream->thinnedOut());
  printTables(stream->reports());
  fmt::print("points      {}{}\n", summary.Points,
    summary.NotFinite > 0 ? fmt::format(", {} without finite coordinates", summary.NotFinite) : "");
  fmt::print("x           {}\ny           {}\n", summary.X.text(), summary.Y.text());
  const std::vector<std::string> names = stream->columns();
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    fmt::print("{:<11} {}\n", names[i], summary.Columns[i].text());
  }
  printChecks(stream->reports(), names, summary);
  const ReferenceSystem crs = stream->referenceSystem();
  fmt::print("CRS         {}\n",
    crs.Text.empty()      ? "not given"
      : crs.Words.empty() ? crs.Text
                          : crs.Words);
  fmt::print("duplicates  {}\n", duplicatesOf(summary.Compared));
  const double area = (summary.X.High - summary.X.Low) * (summary.Y.High - summary.Y.Low);
  if (area > 0 && std::isfinite(area))
  {
    fmt::print("resolution  {}, for about one point per pixel\n",
      roundNumber(std::sqrt(area / double(summary.Points - summary.NotFinite))));
  }
  return Success;
}

/// Whether the path is that of a flat or partitioned mesh, not of points.
bool isStoredMesh(const std::string& path)
{
  return isPartitionedMesh(path) || (isFlatMesh(path) && !isOpenedBy(path, Opener::Vtk));
}

Box3 boundsOf(const std::string& path, const PartitionedMesh& mesh)
{
  if (isPartitionedMesh(path))
  {
    return mesh.Domain;
  }
  Communicator alone(nullptr);
  return boundsOfPoints(openFlatMesh(path), alone, 0);
}

/// Prints what a flat or partitioned mesh has.
void describeMesh(const std::string& path)
{
  const bool isPartitioned = isPartitionedMesh(path);
  const std::unique_ptr<PieceSource> source =
    openPieceSource(path, { TilingChoice::require("grid:1x1") });
  if (!isPartitioned) // its bounds are not known before
  {
    Communicator alone(nullptr);
    source->prepare(alone);
  }
  const PartitionedMesh& mesh = source->mesh();
  fmt::print("{}: {}, {} points\n", shownPath(path),
    isPartitioned ? counted(std::int64_t(mesh.Pieces.size()), "piece", "pieces") : "flat mesh",
    mesh.Points);
  fmt::print("{:<11} {}\n", mesh.CellSize == 3 ? "triangles" : "tetrahedra", mesh.Cells);
  const Box3 bounds = boundsOf(path, mesh);
  for (int axis = 0; axis < mesh.CellSize - 1 && !bounds.isEmpty(); ++axis)
  {
    fmt::print(
      "{:<11} {} to {}\n", std::string(1, char('x' + axis)), bounds.Min[axis], bounds.Max[axis]);
  }
  const MeshDescription& described = mesh.Description;
  printTimes(mesh.Times, described.TimeUnits, described.Calendar);
  for (const StoredArray& array : mesh.Arrays)
  {
    if (array.Step <= 0) // each step is an array
    {
      const ArrayDescription about = described.arrayOf(array.Name, !array.OfPoints);
      printArray(array.Name, array.OfPoints ? "at points" : "on cells", array.Step == 0,
        about.Units, about.LongName);
    }
  }
  if (!described.Crs.empty())
  {
    fmt::print("CRS         {}\n", described.Crs);
  }
}

bool isModelOutput(const std::string& path)
{
  return isOpenedBy(path, Opener::Netcdf) || isOpenedBy(path, Opener::Selafin) ||
    (isOpenedBy(path, Opener::Vtk) && isMeshSeries(path));
}

int runInfo(const InfoArguments& arguments)
{
  InfoArguments points = arguments;
  points.Inputs.clear();
  for (const std::string& path : arguments.Inputs)
  {
    if (isModelOutput(path))
    {
      describeSeries(*openMeshSeries(path));
    }
    else if (isStoredMesh(path))
    {
      describeMesh(path);
    }
    else
    {
      points.Inputs.push_back(path);
    }
  }
  return points.Inputs.empty() ? int(Success) : describePoints(points);
}

void addOptions(CLI::App& command, InfoArguments& arguments)
{
  command.add_option("input", arguments.Inputs, "The files: points, output of models, or meshes")
    ->required();
  addPointOptions(command, arguments.Points);
  addBoundsOption(command, arguments.Points);
}

} // namespace

void addInfoCommand(CLI::App& app, int& exitCode)
{
  addCommand<InfoArguments>(app, exitCode, "info",
    "Describes files: points with their bounds and columns, or meshes with their arrays and steps",
    footer, addOptions,
    [](InfoArguments& arguments) { return isIdleRank() ? Success : runInfo(arguments); });
}

namespace
{

constexpr const char* devicesFooter =
  R"(One line per device: INDEX; CPU, GPU or other; memory; whether it has the double
precision that resampling needs; NAME; and the driver. The option --device of other
commands accepts opencl:INDEX or opencl:NAME, where NAME is any part of the name
or of the driver's name.

Example:
  tipp devices
)";

const char* nameOf(DeviceType type)
{
  return type == DeviceType::Cpu ? "CPU" : type == DeviceType::Gpu ? "GPU" : "other";
}

void printDevices()
{
  if (listDevices().empty())
  {
    fmt::print("{}\n", noDeviceAdvice());
  }
  for (const DeviceDescription& device : listDevices())
  {
    fmt::print("{}  {}  {:.1f} GB  {}  {} ({})\n", device.Index, nameOf(device.Type),
      double(device.Memory) / 1e9, device.Double ? "double" : "no double", device.Name,
      device.Platform);
  }
}

} // namespace

void addDevicesCommand(CLI::App& app, int& exitCode)
{
  CLI::App* const command = app.add_subcommand("devices", "Lists this machine's OpenCL devices");
  command->footer(devicesFooter);
  command->callback(
    [&exitCode]
    {
      if (!isIdleRank())
      {
        printDevices();
      }
      exitCode = Success;
    });
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Hdf/VtkHdfFile.h"

#include "Files/IOError.h"
#include "Files/RawValues.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::size_t mostPoints = std::size_t(1) << 48; ///< sums of counts below it do not wrap

/// The sum of counts of some parts.
std::int64_t sumOf(const std::vector<std::int64_t>& counts, std::int64_t first, std::int64_t parts)
{
  const auto begin = counts.begin() + first;
  return std::accumulate(begin, begin + parts, std::int64_t(0));
}

std::vector<std::int64_t> integersOf(const HdfValues& values)
{
  std::vector<std::int64_t> integers(std::size_t(values.Tuples * values.Components));
  withScalar(values.Type,
    [&](auto type)
    {
      using T = decltype(type);
      for (std::size_t i = 0; i < integers.size(); ++i)
      {
        integers[i] = std::int64_t(valueAt<T>(values.Bytes.data() + i * sizeof(T)));
      }
    });
  return integers;
}

bool isInteger(Scalar type)
{
  return type != Scalar::Float32 && type != Scalar::Float64;
}

} // namespace

const std::vector<std::string>& VtkHdfFile::cellGroups()
{
  static const std::vector<std::string> groups = { "Vertices", "Lines", "Polygons", "Strips" };
  return groups;
}

VtkHdfFile::VtkHdfFile(const std::string& path)
  : File(path, "VTKHDF")
{
  this->readKind(this->File.content());
  this->readCounts();
  this->readSteps();
  this->findArrays();
}

void VtkHdfFile::fail(const std::string& problem) const
{
  throw IOError(this->path(), problem + "; write it again.");
}

const NetcdfVariable& VtkHdfFile::require(const std::string& name) const
{
  const NetcdfVariable* const variable = this->File.content().find(name);
  if (!variable || !variable->Type)
  {
    this->fail("has no numbers '" + name + "' in its group VTKHDF");
  }
  return *variable;
}

void VtkHdfFile::readKind(const NetcdfContent& content)
{
  std::string kind;
  for (const NetcdfAttribute& attribute : content.Attributes)
  {
    kind = attribute.Name == "Type" ? attribute.Text : kind;
    if (attribute.Name == "Version" && !attribute.Numbers.empty() && attribute.Numbers[0] > 2)
    {
      this->fail("is of version " + std::to_string(int(attribute.Numbers[0])) +
        " of VTKHDF, and version 2 is the last one that is known here");
    }
  }
  this->IsPolyData = kind == "PolyData";
  if (!this->IsPolyData && kind != "UnstructuredGrid")
  {
    throw IOError(this->path(),
      "holds " + (kind.empty() ? "no data set" : "a data set of the type '" + kind + "'") +
        "; unstructured grids and poly data are read: convert it in ParaView.");
  }
}

std::vector<std::int64_t> VtkHdfFile::readCountsOf(const std::string& name)
{
  const NetcdfVariable& variable = this->require(name);
  const std::vector<std::int64_t> shape = this->File.content().shape(variable);
  if (shape.size() != 1 || !isInteger(*variable.Type))
  {
    this->fail("has '" + name + "' that are not one integer a part");
  }
  std::vector<std::int64_t> counts = this->readIds(name, 0, shape[0]);
  for (const std::int64_t count : counts)
  {
    if (count < 0 || count > std::int64_t(mostPoints / (counts.size() + 1)))
    {
      this->fail("has a count of " + std::to_string(count) + " in '" + name + "'");
    }
  }
  return counts;
}

void VtkHdfFile::readCounts()
{
  this->PointCounts = this->readCountsOf("NumberOfPoints");
  for (const std::string& group : this->IsPolyData ? cellGroups() : std::vector<std::string>{ "" })
  {
    const std::string prefix = group.empty() ? "" : group + "/";
    this->Groups.push_back({ prefix, this->readCountsOf(prefix + "NumberOfCells"),
      this->readCountsOf(prefix + "NumberOfConnectivityIds") });
    if (this->Groups.back().Cells.size() != this->PointCounts.size() ||
      this->Groups.back().Ids.size() != this->PointCounts.size())
    {
      this->fail("has other numbers of parts of points and of cells");
    }
  }
}

/// The offsets of the steps, of each group of cells if there are several.
std::vector<std::int64_t> VtkHdfFile::readOffsets(const std::string& name, std::size_t steps)
{
  const NetcdfVariable& variable = this->require("Steps/" + name);
  const std::vector<std::int64_t> shape = this->File.content().shape(variable);
  if (shape.empty() || shape.size() > 2 || shape[0] < std::int64_t(steps) ||
    !isInteger(*variable.Type))
  {
    this->fail("has '" + name + "' that are not integers of " + std::to_string(steps) + " steps");
  }
  const HdfValues values = this->readTuples(variable, 0, std::int64_t(steps));
  std::vector<std::int64_t> offsets = integersOf(values);
  for (const std::int64_t offset : offsets)
  {
    if (offset < 0 || offset > std::int64_t(mostPoints))
    {
      this->fail("has an offset of " + std::to_string(offset) + " in '" + name + "'");
    }
  }
  return offsets;
}

void VtkHdfFile::readSteps()
{
  const auto parts = std::int64_t(this->PointCounts.size());
  if (!this->File.content().find("Steps/Values"))
  {
    this->Steps.push_back({ 0, parts, 0, std::vector<CellStart>(this->Groups.size()) });
    return;
  }
  this->Times = this->File.read(this->require("Steps/Values"));
  const std::size_t count = this->Times.size();
  const std::vector<std::int64_t> first = this->readOffsets("PartOffsets", count);
  const std::vector<std::int64_t> points = this->readOffsets("PointOffsets", count);
  const std::vector<std::int64_t> cells = this->readOffsets("CellOffsets", count);
  const std::vector<std::int64_t> ids = this->readOffsets("ConnectivityIdOffsets", count);
  const bool statesParts = this->File.content().find("Steps/NumberOfParts") != nullptr;
  const std::vector<std::int64_t> stated =
    statesParts ? this->readOffsets("NumberOfParts", count) : std::vector<std::int64_t>();
  // Otherwise all steps have as many parts.
  const bool isEven = count > 0 && parts % std::int64_t(count) == 0;
  const std::size_t groups = this->Groups.size();
  if (count == 0 || first.size() != count || points.size() != count ||
    cells.size() != count * groups || ids.size() != count * groups)
  {
    this->fail("has offsets of another number of steps or kinds of cells than it should");
  }
  for (std::size_t step = 0; step < count; ++step)
  {
    const std::int64_t own = statesParts ? stated[step]
      : isEven                           ? parts / std::int64_t(count)
                                         : parts - first[step];
    Step at{ first[step], own, points[step], {} };
    if (at.FirstPart > parts || at.Parts < 1 || at.Parts > parts - at.FirstPart)
    {
      this->fail("has step " + std::to_string(step) + " (from 0) at parts that there are not");
    }
    for (std::size_t group = 0; group < groups; ++group)
    {
      at.Starts.push_back({ cells[step * groups + group], ids[step * groups + group] });
    }
    this->Steps.push_back(std::move(at));
  }
}

void VtkHdfFile::findArrays()
{
  const NetcdfContent& content = this->File.content();
  for (const bool onCells : { false, true })
  {
    const std::string prefix = onCells ? "CellData/" : "PointData/";
    for (const NetcdfVariable& variable : content.Variables)
    {
      const std::vector<std::int64_t> shape = content.shape(variable);
      if (variable.Type && variable.Name.compare(0, prefix.size(), prefix) == 0 &&
        (shape.size() == 1 || (shape.size() == 2 && shape[1] > 0 && shape[1] < 1000)))
      {
        this->Arrays.push_back({ variable.Name.substr(prefix.size()), onCells, *variable.Type,
          shape.size() == 1 ? 1 : shape[1] });
      }
    }
  }
}

std::int64_t VtkHdfFile::points(std::size_t step) const
{
  const Step& at = this->Steps[step];
  return sumOf(this->PointCounts, at.FirstPart, at.Parts);
}

std::int64_t VtkHdfFile::cells(std::size_t step) const
{
  return this->cellsBefore(step, this->Groups.size());
}

/// The number of a step's cells in the groups before one.
std::int64_t VtkHdfFile::cellsBefore(std::size_t step, std::size_t group) const
{
  const Step& at = this->Steps[step];
  std::int64_t cells = 0;
  for (std::size_t i = 0; i < group; ++i)
  {
    cells += sumOf(this->Groups[i].Cells, at.FirstPart, at.Parts);
  }
  return cells;
}

bool VtkHdfFile::shareMesh(std::size_t step, std::size_t other) const
{
  const Step& a = this->Steps[step];
  const Step& b = this->Steps[other];
  return a.FirstPart == b.FirstPart && a.Parts == b.Parts && a.Points == b.Points &&
    std::equal(a.Starts.begin(), a.Starts.end(), b.Starts.begin(),
      [](const CellStart& c, const CellStart& d) { return c.Cells == d.Cells && c.Ids == d.Ids; });
}

bool VtkHdfFile::haveEqualMesh(std::size_t step, std::size_t other)
{
  if (this->shareMesh(step, other))
  {
    return true;
  }
  const auto areEqual = [&](const Group& group)
  {
    const std::string name = group.Prefix.substr(0, group.Prefix.find('/'));
    const HdfCells a = this->readCells(step, name);
    const HdfCells b = this->readCells(other, name);
    return a.Ids == b.Ids && a.Offsets == b.Offsets && a.Types == b.Types;
  };
  return this->points(step) == this->points(other) && this->cells(step) == this->cells(other) &&
    this->readPoints(step).Bytes == this->readPoints(other).Bytes &&
    std::all_of(this->Groups.begin(), this->Groups.end(), areEqual);
}

bool VtkHdfFile::varies(const HdfArray& array)
{
  const std::vector<std::int64_t> offsets = this->offsetsOf(array);
  return std::any_of(offsets.begin(), offsets.end(),
    [&offsets](std::int64_t offset) { return offset != offsets.front(); });
}

HdfValues VtkHdfFile::readTuples(
  const NetcdfVariable& variable, std::int64_t begin, std::int64_t count)
{
  std::vector<std::int64_t> shape = this->File.content().shape(variable);
  if (count > shape[0] || begin > shape[0] - count)
  {
    this->fail("has " + std::to_string(shape[0]) + " tuples of '" + variable.Name +
      "', but needs those up to " + std::to_string(begin + count));
  }
  HdfValues values;
  values.Type = *variable.Type;
  values.Components = shape.size() > 1 ? shape[1] : 1;
  values.Tuples = count;
  std::vector<std::int64_t> start(shape.size(), 0);
  start[0] = begin;
  shape[0] = count;
  this->File.readStored(variable, start, shape, values.Bytes);
  return values;
}

std::vector<std::int64_t> VtkHdfFile::readIds(
  const std::string& name, std::int64_t begin, std::int64_t count)
{
  const NetcdfVariable& variable = this->require(name);
  if (!isInteger(*variable.Type) || variable.Dimensions.size() != 1)
  {
    this->fail("has '" + name + "' that are not integers");
  }
  return integersOf(this->readTuples(variable, begin, count));
}

HdfValues VtkHdfFile::readPoints(std::size_t step)
{
  const NetcdfVariable& variable = this->require("Points");
  const std::vector<std::int64_t> shape = this->File.content().shape(variable);
  if (shape.size() != 2 || shape[1] != 3 || isInteger(*variable.Type))
  {
    this->fail("has 'Points' that are not three coordinates each");
  }
  return this->readTuples(variable, this->Steps[step].Points, this->points(step));
}

HdfCells VtkHdfFile::readCells(std::size_t step, const std::string& group)
{
  const Step& at = this->Steps[step];
  const auto found = std::find_if(this->Groups.begin(), this->Groups.end(),
    [&](const Group& one) { return one.Prefix == (group.empty() ? "" : group + "/"); });
  const Group& of = *found;
  const CellStart& start = at.Starts[std::size_t(found - this->Groups.begin())];
  HdfCells cells;
  const std::int64_t count = sumOf(of.Cells, at.FirstPart, at.Parts);
  cells.Ids =
    this->readIds(of.Prefix + "Connectivity", start.Ids, sumOf(of.Ids, at.FirstPart, at.Parts));
  // Each part has one more offset than cells.
  const std::vector<std::int64_t> offsets =
    this->readIds(of.Prefix + "Offsets", start.Cells + at.FirstPart, count + at.Parts);
  if (!this->IsPolyData)
  {
    const HdfValues types = this->readTuples(this->require("Types"), start.Cells, count);
    const std::vector<std::int64_t> numbers = integersOf(types);
    cells.Types.assign(numbers.begin(), numbers.end());
  }
  cells.Offsets.reserve(std::size_t(count) + 1);
  cells.Offsets.push_back(0);
  auto id = cells.Ids.begin();
  auto offset = offsets.begin();
  std::int64_t point = 0;
  for (std::int64_t part = at.FirstPart; part < at.FirstPart + at.Parts; ++part)
  {
    const std::int64_t points = this->PointCounts[std::size_t(part)];
    const std::int64_t ids = of.Ids[std::size_t(part)];
    const std::int64_t base = cells.Offsets.back();
    for (std::int64_t i = 0; i < of.Cells[std::size_t(part)]; ++i)
    {
      ++offset;
      if (*(offset - 1) < 0 || *offset < *(offset - 1) || *offset > ids)
      {
        this->fail("has cells whose offsets do not ascend, or end beyond their ids");
      }
      cells.Offsets.push_back(base + *offset);
    }
    ++offset;
    cells.Offsets.back() = base + ids;
    for (const auto end = id + ids; id != end; ++id)
    {
      if (*id < 0 || *id >= points)
      {
        this->fail("has a cell at point " + std::to_string(*id) + " of a part of " +
          std::to_string(points) + " points");
      }
      *id += point;
    }
    point += points;
  }
  return cells;
}

/// Where the values of an array begin at each step.
std::vector<std::int64_t> VtkHdfFile::offsetsOf(const HdfArray& array)
{
  const std::string name =
    std::string(array.OnCells ? "CellDataOffsets/" : "PointDataOffsets/") + array.Name;
  const std::size_t steps = this->steps();
  if (this->Times.empty())
  {
    return std::vector<std::int64_t>(steps, 0);
  }
  if (const NetcdfVariable* const variable = this->File.content().find("Steps/" + name))
  {
    const std::vector<std::int64_t> shape = this->File.content().shape(*variable);
    // vtkHDFWriter adds no offset for a step without the array, so that those after it are shifted.
    const bool isShort = !shape.empty() && shape[0] < std::int64_t(steps);
    std::vector<std::int64_t> offsets =
      isShort ? std::vector<std::int64_t>() : this->readOffsets(name, steps);
    if (isShort || (offsets.size() == steps && !this->hasEveryStep(array, offsets)))
    {
      throw IOError(this->path(),
        "lacks the array '" + array.Name + "' at some of its " + std::to_string(steps) +
          " steps, and does not say at which; leave it out, or write it at every step.");
    }
    return offsets.size() == steps ? offsets : std::vector<std::int64_t>(steps, 0);
  }
  std::vector<std::int64_t> offsets;
  for (const Step& step : this->Steps)
  {
    offsets.push_back(array.OnCells ? step.Starts.front().Cells : step.Points);
  }
  return offsets;
}

/// Whether an array has values from each step's offset on.
bool VtkHdfFile::hasEveryStep(const HdfArray& array, const std::vector<std::int64_t>& offsets) const
{
  const std::string name = (array.OnCells ? "CellData/" : "PointData/") + array.Name;
  const std::vector<std::int64_t> shape = this->File.content().shape(this->require(name));
  const std::int64_t tuples = shape.empty() ? 0 : shape[0];
  for (std::size_t step = 0; step < offsets.size(); ++step)
  {
    if (offsets[step] > tuples - (array.OnCells ? this->cells(step) : this->points(step)))
    {
      return false;
    }
  }
  return true;
}

HdfValues VtkHdfFile::read(const HdfArray& array, std::size_t step)
{
  const NetcdfVariable& variable =
    this->require((array.OnCells ? "CellData/" : "PointData/") + array.Name);
  return this->readTuples(
    variable, this->offsetsOf(array)[step], array.OnCells ? this->cells(step) : this->points(step));
}

} // namespace tipp

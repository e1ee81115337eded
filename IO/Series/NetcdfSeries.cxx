// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfSeries.h"

#include "Files/IOError.h"
#include "Files/MeshDescription.h"
#include "Files/TextFile.h"
#include "Netcdf/NetcdfFile.h"
#include "Netcdf/NetcdfHook.h"
#include "Series/CellSeries.h"
#include "Series/LocatedVariables.h"
#include "Series/NetcdfMesh.h"
#include "Series/NetcdfTime.h"
#include "Series/ReadOrder.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tipp
{
namespace
{

NetcdfMesh findMesh(const std::string& path, const NetcdfContent& content)
{
  for (const auto find : { findUgridMesh, findMpasMesh, findNamedMesh })
  {
    if (auto mesh = find(path, content))
    {
      return *mesh;
    }
  }
  throw IOError(path,
    "has no mesh of triangles or polygons by the conventions of UGRID, ADCIRC, SCHISM, FVCOM, "
    "FESOM or MPAS; name a file that has the mesh, and this one by --values if it has values "
    "alone.");
}

/// The reference system that a variable of CF's grid mappings states; empty if it states none.
std::string crsOf(const NetcdfVariable& variable)
{
  for (const char* name : { "epsg", "epsg_code", "EPSG_code", "EPSG" })
  {
    const double code = variable.number(name).value_or(0);
    if (code >= 1024 && code <= 32767)
    {
      return "EPSG:" + std::to_string(int(code));
    }
    const std::string text = variable.text(name);
    if (text.compare(0, 5, "EPSG:") == 0 && isCrsText(text))
    {
      return text;
    }
  }
  for (const char* name : { "crs_wkt", "spatial_ref" })
  {
    if (isCrsText(variable.text(name)))
    {
      return variable.text(name);
    }
  }
  return "";
}

/// Whether a variable of CF's grid mappings has a text that should be a reference system.
bool isStated(const NetcdfVariable& mapping)
{
  return !mapping.text("crs_wkt").empty() || !mapping.text("spatial_ref").empty();
}

class NetcdfSeries : public CellSeries
{
public:
  NetcdfSeries(const std::string& path, const SeriesOptions& options)
    : CellSeries(options.Wrap)
  {
    this->Path = path;
    this->Files.push_back(std::make_unique<NetcdfFile>(path));
    NetcdfFile& first = *this->Files.front();
    this->Mesh = findMesh(path, first.content());
    this->Kind = this->Mesh.Kind;
    this->Dimensions = dimensionsOf(first.content(), this->Mesh);
    this->setCrs(first.content());
    this->addFile(first);
    for (const std::string& values : options.Values)
    {
      this->Files.push_back(std::make_unique<NetcdfFile>(values));
      this->addFile(*this->Files.back());
    }
    this->setSize(this->Dimensions.Nodes, this->Dimensions.Cells);
  }

protected:
  std::unique_ptr<CellBlocks> openCells() override
  {
    return openNetcdfCells(*this->Files.front(), this->Mesh);
  }

  void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    const Source& source = this->Sources.at(variable);
    const Part part = this->partAt(variable, step, this->whole(variable));
    source.File->read(*source.Variable, part.Start, part.Count, values);
    this->prefetchAfter(variable, step, [this](std::size_t next) { return this->whole(next); });
  }

  void readSome(std::size_t variable, std::size_t step, const std::vector<std::int32_t>& at,
    std::vector<double>& values) override
  {
    const Source& source = this->Sources.at(variable);
    const bool onCells = this->Variables[variable].OnCells;
    values.resize(at.size());
    std::vector<double> read;
    for (std::size_t begin = 0; begin < at.size();)
    {
      const std::size_t end = endOfSpan(at, begin);
      const Span span = spanOf(at, begin, end);
      this->FirstSpans[onCells] = begin == 0 ? span : this->FirstSpans[onCells];
      const Part part = this->partAt(variable, step, span);
      source.File->read(*source.Variable, part.Start, part.Count, read);
      if (end < at.size())
      {
        this->prefetch(variable, step, spanOf(at, end, endOfSpan(at, end)));
      }
      for (; begin < end; ++begin)
      {
        values[begin] = read[std::size_t(at[begin] - span.First)];
      }
    }
    this->prefetchAfter(variable, step,
      [this](std::size_t next) { return this->FirstSpans[this->Variables[next].OnCells]; });
  }

private:
  using Indices = std::vector<std::int64_t>;

  /// Nodes or cells that are read at once.
  struct Span
  {
    std::int64_t First = 0;
    std::int64_t Count = 0;
  };

  /// A part of a variable in the file.
  struct Part
  {
    Indices Start;
    Indices Count;
  };

  struct Source
  {
    NetcdfFile* File;
    const NetcdfVariable* Variable;
    int TimeAxis;
    int SpaceAxis; ///< of nodes or cells
  };

  void setCrs(const NetcdfContent& content)
  {
    for (const NetcdfVariable& variable : content.Variables)
    {
      if (const NetcdfVariable* const mapping = content.find(variable.text("grid_mapping")))
      {
        this->Crs = this->Crs.empty() ? crsOf(*mapping) : this->Crs;
        if (this->Crs.empty() && isStated(*mapping))
        {
          this->LeftOut.push_back(
            { mapping->Name, "states the reference system by a text that is none of WKT" });
          return;
        }
      }
    }
    if (this->Crs.empty() && isInDegrees(this->Mesh))
    {
      this->Crs = "EPSG:4326";
    }
  }

  void addFile(NetcdfFile& file)
  {
    const NetcdfTime time = readNetcdfTime(file);
    LocatedVariables located = locateVariables(file.path(), file.content(),
      { &this->Mesh, this->Dimensions, time.Dimension, file.path() == this->Path });
    const bool varies = std::any_of(located.Variables.begin(), located.Variables.end(),
      [](const LocatedVariable& variable) { return variable.Described.Varies; });
    if (varies)
    {
      this->setTimes(file.path(), time);
    }
    for (LocatedVariable& variable : located.Variables)
    {
      this->addVariable(file, std::move(variable));
    }
    this->LeftOut.insert(this->LeftOut.end(), located.LeftOut.begin(), located.LeftOut.end());
    if (time.AreNumbers && varies)
    {
      const std::string problem = time.UnreadDate.empty()
        ? "has no values"
        : "has the date '" + shownText(time.UnreadDate) + "', not one such as 2000-01-31_12:30:00";
      this->LeftOut.push_back({ "time", problem + ", so the steps are counted from 0" });
    }
  }

  void setTimes(const std::string& path, const NetcdfTime& time)
  {
    if (!this->Times.empty() && (this->Times != time.Values || this->TimeUnits != time.Units))
    {
      throw IOError(path, "has other times than the files before it; read them one by one.");
    }
    this->Times = time.Values;
    this->TimeUnits = time.Units;
    this->Calendar = time.Calendar;
  }

  void addVariable(NetcdfFile& file, LocatedVariable variable)
  {
    const auto same = std::find_if(this->Variables.begin(), this->Variables.end(),
      [&](const SeriesVariable& other) { return other.Name == variable.Described.Name; });
    if (same == this->Variables.end())
    {
      this->Variables.push_back(std::move(variable.Described));
      this->Sources.push_back({ &file, variable.Variable, variable.TimeAxis, variable.SpaceAxis });
    }
    else if (variable.Described.Varies || same->Varies)
    {
      throw IOError(
        file.path(), "has '" + same->Name + "', as a file before it; read them one by one.");
    }
  }

  Span whole(std::size_t variable) const
  {
    return { 0,
      this->Variables[variable].OnCells ? this->Dimensions.Cells : this->Dimensions.Nodes };
  }

  /// The end of the indices that are read at once with the one at `begin`: they are near each
  /// other, and not too many.
  static std::size_t endOfSpan(const std::vector<std::int32_t>& at, std::size_t begin)
  {
    constexpr std::int64_t most = std::int64_t(1) << 20;
    constexpr std::int64_t gap = std::int64_t(1) << 16;
    std::size_t end = begin + 1;
    while (end < at.size() && at[end] < at[begin] + most && at[end] < at[end - 1] + gap)
    {
      ++end;
    }
    return end;
  }

  static Span spanOf(const std::vector<std::int32_t>& at, std::size_t begin, std::size_t end)
  {
    return { at[begin], std::int64_t(at[end - 1]) + 1 - at[begin] };
  }

  void prefetch(std::size_t variable, std::size_t step, const Span& span)
  {
    const Source& source = this->Sources[variable];
    const Part part = this->partAt(variable, step, span);
    source.File->prefetch(*source.Variable, part.Start, part.Count);
  }

  /// Begins to read what follows by the order of the calls up to now.
  template <typename SpanOf>
  void prefetchAfter(std::size_t variable, std::size_t step, const SpanOf& spanOfNext)
  {
    this->Order.add(variable, step);
    const auto next = this->Order.next(variable, step);
    if (next && (next->Step < this->Times.size() || !this->Variables[next->Variable].Varies))
    {
      this->prefetch(next->Variable, next->Step, spanOfNext(next->Variable));
    }
  }

  Part partAt(std::size_t variable, std::size_t step, const Span& span) const
  {
    const Source& source = this->Sources[variable];
    Part part;
    part.Count = source.File->content().shape(*source.Variable);
    part.Start.resize(part.Count.size(), 0);
    if (source.TimeAxis >= 0)
    {
      part.Start[std::size_t(source.TimeAxis)] = std::int64_t(step);
      part.Count[std::size_t(source.TimeAxis)] = 1;
    }
    part.Start[std::size_t(source.SpaceAxis)] = span.First;
    part.Count[std::size_t(source.SpaceAxis)] = span.Count;
    return part;
  }

  std::vector<std::unique_ptr<NetcdfFile>> Files; ///< the first has the mesh
  NetcdfMesh Mesh;
  MeshDimensions Dimensions;
  std::vector<Source> Sources; ///< of Variables, in their order
  ReadOrder Order;
  Span FirstSpans[2]; ///< of the last readSome() at nodes, and at cells
};

} // namespace

std::unique_ptr<MeshSeries> openNetcdfSeries(const std::string& path, const SeriesOptions& options)
{
#ifdef TIPP_WITHOUT_VTK
  const NetcdfHook& hook = netcdfHook();
  const std::string missing =
    hook.missing ? hook.missing(false) : "is a NetCDF file, which this build does not read.";
  if (!missing.empty())
  {
    throw IOError(path, missing);
  }
#endif
  return std::make_unique<NetcdfSeries>(path, options);
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfSeries.h"

#include "Files/IOError.h"
#include "Netcdf/NetcdfFile.h"
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
    if (text.compare(0, 5, "EPSG:") == 0)
    {
      return text;
    }
  }
  for (const char* name : { "crs_wkt", "spatial_ref" })
  {
    if (!variable.text(name).empty())
    {
      return variable.text(name);
    }
  }
  return "";
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
  CellMesh readCells() override { return readNetcdfMesh(*this->Files.front(), this->Mesh); }

  void readStored(std::size_t variable, std::size_t step, std::vector<double>& values) override
  {
    const Source& source = this->Sources.at(variable);
    const auto [start, count] = this->partAt(variable, step);
    source.File->read(*source.Variable, start, count, values);
    this->Order.add(variable, step);
    if (const auto next = this->Order.next(variable, step))
    {
      const Source& other = this->Sources[next->Variable];
      if (next->Step < this->Times.size() || !this->Variables[next->Variable].Varies)
      {
        const auto part = this->partAt(next->Variable, next->Step);
        other.File->prefetch(*other.Variable, part.first, part.second);
      }
    }
  }

private:
  using Indices = std::vector<std::int64_t>;

  struct Source
  {
    NetcdfFile* File;
    const NetcdfVariable* Variable;
    int TimeAxis;
  };

  void setCrs(const NetcdfContent& content)
  {
    for (const NetcdfVariable& variable : content.Variables)
    {
      if (const NetcdfVariable* const mapping = content.find(variable.text("grid_mapping")))
      {
        this->Crs = this->Crs.empty() ? crsOf(*mapping) : this->Crs;
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
      this->LeftOut.push_back({ "time", "has no values, so the steps are counted from 0" });
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
      this->Sources.push_back({ &file, variable.Variable, variable.TimeAxis });
    }
    else if (variable.Described.Varies || same->Varies)
    {
      throw IOError(
        file.path(), "has '" + same->Name + "', as a file before it; read them one by one.");
    }
  }

  std::pair<Indices, Indices> partAt(std::size_t variable, std::size_t step) const
  {
    const Source& source = this->Sources[variable];
    Indices count = source.File->content().shape(*source.Variable);
    Indices start(count.size(), 0);
    if (source.TimeAxis >= 0)
    {
      start[std::size_t(source.TimeAxis)] = std::int64_t(step);
      count[std::size_t(source.TimeAxis)] = 1;
    }
    return { start, count };
  }

  std::vector<std::unique_ptr<NetcdfFile>> Files; ///< the first has the mesh
  NetcdfMesh Mesh;
  MeshDimensions Dimensions;
  std::vector<Source> Sources; ///< of Variables, in their order
  ReadOrder Order;
};

} // namespace

std::unique_ptr<MeshSeries> openNetcdfSeries(const std::string& path, const SeriesOptions& options)
{
  return std::make_unique<NetcdfSeries>(path, options);
}

} // namespace tipp

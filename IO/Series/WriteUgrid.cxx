// SPDX-License-Identifier: BSD-3-Clause
#include "Series/WriteUgrid.h"

#include "Crs/ReferenceSystem.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Netcdf/NetcdfOutput.h"
#include "Predicates/Vectors.h"
#include "Series/NetcdfCrs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace tipp
{
namespace
{

constexpr std::int64_t block = std::int64_t(1) << 18; ///< nodes or triangles of a chunk

/// A name that NetCDF allows: without slashes and control characters.
std::string validName(const std::string& name)
{
  std::string valid = name;
  std::replace_if(
    valid.begin(), valid.end(), [](unsigned char c) { return c < ' ' || c == '/' || c == 127; },
    '_');
  valid.erase(valid.find_last_not_of(' ') + 1);
  return valid.empty() ? "unnamed" : valid;
}

class UgridWriter
{
public:
  UgridWriter(
    const std::string& path, const UgridContent& content, const std::optional<PathState>& before)
    : Path(path)
    , Content(content)
    , Output(path, before, false, "rename it.")
    , Wkt(content.Crs.empty() ? "" : wkt1Of(content.Crs, true))
  {
    if (content.Triangles == 0)
    {
      throw IOError(path, "would have no triangles, and a mesh by UGRID needs one.");
    }
    std::set<std::string> names = { "mesh2d", "mesh2d_node_x", "mesh2d_node_y", "mesh2d_face_nodes",
      "time", "crs" };
    for (const UgridArray& array : content.Arrays)
    {
      if (!names.insert(validName(array.Name)).second)
      {
        throw IOError(path,
          "needs another name for the array '" + array.Name +
            "', which the file's mesh, time or reference system or another array has; rename it.");
      }
    }
  }

  bool write(const std::function<bool()>& aborted)
  {
    this->define();
    this->Output.endDefinitions();
    this->writeMesh();
    const std::vector<double>& times = this->Content.Times;
    if (!times.empty())
    {
      this->Output.write(this->Time, { 0 }, { times.size() }, times.data());
    }
    for (std::size_t step = 0; step < std::max<std::size_t>(times.size(), 1); ++step)
    {
      for (std::size_t i = 0; i < this->Variables.size(); ++i)
      {
        if (aborted && aborted())
        {
          return false;
        }
        this->writeValues(i, step);
      }
    }
    this->Output.close();
    return true;
  }

private:
  void define()
  {
    const NetcdfOutput& out = this->Output;
    out.setText(NetcdfOutput::global, "Conventions", "CF-1.8 UGRID-1.0");
    out.setText(NetcdfOutput::global, "source", this->Content.Source);
    this->NodeDimension = out.addDimension("mesh2d_nNodes", std::size_t(this->Content.Nodes));
    this->FaceDimension = out.addDimension("mesh2d_nFaces", std::size_t(this->Content.Triangles));
    const int three = out.addDimension("mesh2d_nMax_face_nodes", 3);
    const int topology = out.addVariable("mesh2d", Scalar::Int32, {});
    out.setText(topology, "cf_role", "mesh_topology");
    out.setText(topology, "long_name", "topology of a mesh of triangles");
    out.setInteger(topology, "topology_dimension", 2);
    out.setText(topology, "node_coordinates", "mesh2d_node_x mesh2d_node_y");
    out.setText(topology, "face_node_connectivity", "mesh2d_face_nodes");
    out.setText(topology, "face_dimension", "mesh2d_nFaces");
    out.setText(topology, "node_dimension", "mesh2d_nNodes");
    this->X = out.addVariable("mesh2d_node_x", Scalar::Float64, { this->NodeDimension });
    this->Y = out.addVariable("mesh2d_node_y", Scalar::Float64, { this->NodeDimension });
    describeAxes(out, this->X, this->Y, this->Wkt);
    const bool isNarrow = this->Content.Nodes <= std::numeric_limits<std::int32_t>::max();
    this->CornerType = isNarrow ? Scalar::Int32 : Scalar::Int64;
    this->Corners =
      out.addVariable("mesh2d_face_nodes", this->CornerType, { this->FaceDimension, three });
    out.setText(this->Corners, "cf_role", "face_node_connectivity");
    out.setInteger(this->Corners, "start_index", 0);
    const std::size_t faces = chunkOf(this->Content.Triangles);
    out.compress(this->Corners, { faces, 3 });
    out.compress(this->X, { chunkOf(this->Content.Nodes) });
    out.compress(this->Y, { chunkOf(this->Content.Nodes) });
    defineCrs(out, this->Wkt);
    this->defineTime();
    for (const UgridArray& array : this->Content.Arrays)
    {
      this->Variables.push_back(this->defineArray(array));
    }
  }

  static std::size_t chunkOf(std::int64_t count)
  {
    return std::size_t(std::clamp<std::int64_t>(count, 1, block));
  }

  void defineTime()
  {
    if (!this->Content.Times.empty())
    {
      this->TimeDimension = this->Output.addUnlimited("time");
      this->Time = this->Output.addVariable("time", Scalar::Float64, { this->TimeDimension });
      this->Output.setText(this->Time, "standard_name", "time");
      this->Output.setText(this->Time, "axis", "T");
      this->Output.setText(this->Time, "units", this->Content.TimeUnits);
      this->Output.setText(this->Time, "calendar", this->Content.Calendar);
    }
  }

  int defineArray(const UgridArray& array) const
  {
    std::vector<int> dimensions;
    std::vector<std::size_t> chunk;
    if (array.Varies)
    {
      dimensions.push_back(this->TimeDimension);
      chunk.push_back(1);
    }
    dimensions.push_back(array.OnCells ? this->FaceDimension : this->NodeDimension);
    chunk.push_back(chunkOf(array.OnCells ? this->Content.Triangles : this->Content.Nodes));
    const int variable = this->Output.addVariable(validName(array.Name), array.Type, dimensions);
    if (array.Type == Scalar::Float32 || array.Type == Scalar::Float64)
    {
      this->Output.fillWithNaN(variable, array.Type);
    }
    else
    {
      this->Output.withoutFill(variable);
    }
    this->Output.setText(variable, "mesh", "mesh2d");
    this->Output.setText(variable, "location", array.OnCells ? "face" : "node");
    this->Output.setText(variable, "long_name", array.LongName);
    this->Output.setText(variable, "standard_name", array.StandardName);
    this->Output.setText(variable, "units", array.Units);
    this->Output.setText(variable, "grid_mapping", this->Wkt.empty() ? "" : "crs");
    this->Output.setText(
      variable, "coordinates", array.OnCells ? "" : "mesh2d_node_x mesh2d_node_y");
    this->Output.compress(variable, chunk);
    return variable;
  }

  void writeMesh() const
  {
    std::vector<double> x;
    std::vector<double> y;
    for (std::int64_t begin = 0; begin < this->Content.Nodes; begin += block)
    {
      const std::int64_t end = std::min(begin + block, this->Content.Nodes);
      x.clear();
      y.clear();
      for (std::int64_t node = begin; node < end; ++node)
      {
        const Point2 p = this->Content.Node(node);
        if (!std::isfinite(p.x) || !std::isfinite(p.y))
        {
          throw IOError(this->Content.Source.empty() ? this->Path : this->Content.Source,
            "has no finite coordinates at point " + std::to_string(node) +
              " (from 0), and a mesh by UGRID needs them; remove the point.");
        }
        x.push_back(p.x);
        y.push_back(p.y);
      }
      this->Output.write(this->X, { std::size_t(begin) }, { x.size() }, x.data());
      this->Output.write(this->Y, { std::size_t(begin) }, { y.size() }, y.data());
    }
    this->CornerType == Scalar::Int32 ? this->writeCorners<std::int32_t>()
                                      : this->writeCorners<std::int64_t>();
  }

  /// The corners of a triangle, counter-clockwise.
  std::array<std::int64_t, 3> cornersOf(std::int64_t triangle) const
  {
    std::array<std::int64_t, 3> corners{};
    std::array<Point2, 3> p{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      corners[i] = this->Content.Corner(triangle, int(i));
      p[i] = this->Content.Node(corners[i]);
    }
    if (cross(p[1] - p[0], p[2] - p[0]) < 0)
    {
      std::swap(corners[1], corners[2]);
    }
    return corners;
  }

  template <typename Id>
  void writeCorners() const
  {
    std::vector<Id> corners;
    for (std::int64_t begin = 0; begin < this->Content.Triangles; begin += block)
    {
      const std::int64_t end = std::min(begin + block, this->Content.Triangles);
      corners.clear();
      for (std::int64_t triangle = begin; triangle < end; ++triangle)
      {
        for (const std::int64_t corner : this->cornersOf(triangle))
        {
          corners.push_back(Id(corner));
        }
      }
      this->Output.write(
        this->Corners, { std::size_t(begin), 0 }, { std::size_t(end - begin), 3 }, corners.data());
    }
  }

  void writeValues(std::size_t index, std::size_t step) const
  {
    const UgridArray& array = this->Content.Arrays[index];
    const auto count = std::size_t(array.OnCells ? this->Content.Triangles : this->Content.Nodes);
    const int variable = this->Variables[index];
    if (array.Varies)
    {
      this->Output.write(variable, { step, 0 }, { 1, count }, array.Values(step));
    }
    else if (step == 0)
    {
      this->Output.write(variable, { 0 }, { count }, array.Values(0));
    }
  }

  const std::string Path;
  const UgridContent& Content;
  NetcdfOutput Output;
  const std::string Wkt;
  Scalar CornerType = Scalar::Int32;
  int NodeDimension = 0;
  int FaceDimension = 0;
  int TimeDimension = 0;
  int X = 0;
  int Y = 0;
  int Corners = 0;
  int Time = 0;
  std::vector<int> Variables;
};

} // namespace

void requireNetcdfFor(const std::string& output)
{
  if (isOpenedBy(output, Opener::Netcdf))
  {
    NetcdfOutput::requireWriter(output);
  }
}

bool writeUgrid(const std::string& path, const UgridContent& content,
  const std::optional<PathState>& before, const std::function<bool()>& aborted)
{
  return UgridWriter(path, content, before).write(aborted);
}

} // namespace tipp

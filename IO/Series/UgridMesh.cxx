// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfMesh.h"

#include "Files/IOError.h"

#include <iterator>
#include <sstream>

namespace tipp
{
namespace
{

std::vector<std::string> wordsIn(const std::string& text)
{
  std::istringstream stream(text);
  return { std::istream_iterator<std::string>(stream), {} };
}

/// The number of dimensions of a mesh topology; 0 if the variable is none. Some files lack cf_role
/// or call the attribute `dimension`.
double topologyDimension(const NetcdfVariable& variable)
{
  const bool hasRole = variable.text("cf_role") == "mesh_topology";
  const bool hasFaces =
    !variable.text("face_node_connectivity").empty() && !variable.text("node_coordinates").empty();
  if (!hasRole && !hasFaces)
  {
    return 0;
  }
  const auto stated = variable.number("topology_dimension");
  return stated ? *stated : variable.number("dimension").value_or(hasFaces ? 2 : 1);
}

bool isVertical(const NetcdfVariable& y)
{
  return y.text("standard_name") == "latitude" ||
    y.text("standard_name") == "projection_y_coordinate" ||
    y.text("units").find("north") != std::string::npos;
}

const NetcdfVariable& require(const std::string& path, const NetcdfContent& content,
  const std::string& name, const std::string& topology)
{
  const NetcdfVariable* const variable = content.find(name);
  if (!variable)
  {
    throw IOError(path,
      "has no variable '" + name + "', which the mesh topology '" + topology +
        "' names; copy it again, or name the file that has the mesh.");
  }
  return *variable;
}

} // namespace

/// https://ugrid-conventions.github.io/ugrid-conventions, versions 0.9 and 1.0.
std::optional<NetcdfMesh> findUgridMesh(const std::string& path, const NetcdfContent& content)
{
  const NetcdfVariable* topology = nullptr;
  double other = 0;
  for (const NetcdfVariable& variable : content.Variables)
  {
    const double dimension = topologyDimension(variable);
    topology = !topology && dimension == 2 ? &variable : topology;
    other = dimension != 2 && dimension != 0 ? dimension : other;
  }
  if (!topology)
  {
    if (other != 0)
    {
      throw IOError(path,
        std::string("has a mesh ") + (other == 3 ? "of volumes" : "of lines") +
          " only, by its mesh topology; name a file that has one of faces.");
    }
    return std::nullopt;
  }
  const std::vector<std::string> names = wordsIn(topology->text("node_coordinates"));
  const std::string corners = topology->text("face_node_connectivity");
  // A file with values alone may repeat the topology and not the mesh.
  if (names.size() < 2 || corners.empty())
  {
    throw IOError(path,
      "has the mesh topology '" + topology->Name +
        "' without node_coordinates or face_node_connectivity; name the file that has the mesh.");
  }
  NetcdfMesh mesh;
  mesh.Kind = "UGRID";
  mesh.X = &require(path, content, names[0], topology->Name);
  mesh.Y = &require(path, content, names[1], topology->Name);
  if (isVertical(*mesh.X) && !isVertical(*mesh.Y))
  {
    std::swap(mesh.X, mesh.Y);
  }
  mesh.Corners = &require(path, content, corners, topology->Name);
  setMeshDimensions(path, content, mesh, topology->text("face_dimension"));
  mesh.Parts.insert(topology->Name);
  for (const NetcdfAttribute& attribute : topology->Attributes)
  {
    const std::vector<std::string> parts = wordsIn(attribute.Text);
    if (attribute.Name.find("coordinates") != std::string::npos ||
      attribute.Name.find("connectivity") != std::string::npos)
    {
      mesh.Parts.insert(parts.begin(), parts.end());
    }
  }
  return mesh;
}

} // namespace tipp

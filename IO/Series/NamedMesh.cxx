// SPDX-License-Identifier: BSD-3-Clause
#include "Series/NetcdfMesh.h"

#include <algorithm>
#include <array>

namespace tipp
{
namespace
{

/// The names of the variables of a model's mesh. All number the nodes from 1.
struct MeshNames
{
  const char* Kind;
  const char* Corners;
  const char* X;
  const char* Y;
};

/// The first that a file has all variables of is used.
constexpr std::array<MeshNames, 19> known = { {
  { "ADCIRC", "element", "x", "y" },
  { "ADCIRC", "element", "longitude", "latitude" },
  { "ADCIRC", "element", "lon", "lat" },
  { "SCHISM", "SCHISM_hgrid_face_nodes", "SCHISM_hgrid_node_x", "SCHISM_hgrid_node_y" },
  { "SCHISM", "SCHISM_hgrid_face_nodes", "lon", "lat" },
  { "SCHISM", "SCHISM_hgrid_face_nodes", "x", "y" },
  { "SCHISM", "ele", "lon", "lat" },
  { "SCHISM", "ele", "x", "y" },
  { "FVCOM", "nv", "lon", "lat" },
  { "FVCOM", "nv", "x", "y" },
  { "FESOM", "elements", "nodes", "nodes" },
  { "FESOM", "elements", "lon", "lat" },
  { "FESOM", "elem", "nodes", "nodes" },
  { "FESOM", "elem", "lon", "lat" },
  { "FESOM", "elements", "longitude", "latitude" },
  { "FESOM", "elem", "longitude", "latitude" },
  { "FESOM", "face_nodes", "lon", "lat" },
  { "SELFE", "elem", "x", "y" },
  { "SELFE", "face_nodes", "x", "y" },
} };

} // namespace

std::optional<NetcdfMesh> findNamedMesh(const std::string& path, const NetcdfContent& content)
{
  // FVCOM in a plane writes longitudes and latitudes of 0.
  const auto isPlanar = [&]
  {
    return std::any_of(content.Attributes.begin(), content.Attributes.end(),
      [](const NetcdfAttribute& attribute)
      { return attribute.Name == "CoordinateSystem" && attribute.Text == "Cartesian"; });
  };
  for (const MeshNames& names : known)
  {
    if (std::string(names.X) == "lon" && isPlanar())
    {
      continue;
    }
    NetcdfMesh mesh;
    mesh.Kind = names.Kind;
    mesh.X = content.find(names.X);
    mesh.Y = content.find(names.Y);
    mesh.Corners = content.find(names.Corners);
    if (mesh.X && mesh.Y && mesh.Corners && mesh.Corners->Dimensions.size() == 2)
    {
      mesh.FirstNode = 1;
      setMeshDimensions(path, content, mesh, "");
      mesh.Parts.insert({ "x", "y", "lon", "lat", "longitude", "latitude", "nodes" });
      return mesh;
    }
  }
  return std::nullopt;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Models/ModelMesh.h"
#include "Models/NodeNumbers.h"

#include <array>
#include <string_view>
#include <utility>

namespace tipp
{
namespace
{

/// Reads a two-dimensional mesh of SMS, which BASEMENT and other models also use
/// (https://www.xmswiki.com/wiki/SMS:2D_Mesh_Files_*.2dm): a line MESH2D, lines `E3T id a b c
/// material` and `ND id x y z` in any order, and others, which are ignored.
class SmsReader
{
public:
  SmsReader(const std::string& path, ModelPart part)
    : Path(path)
    , Part(part)
    , Rows(path, "a mesh of SMS")
  {
    this->Mesh.Columns.push_back({ "z", {} });
  }

  ModelMesh read()
  {
    while (this->Rows.nextIfAny())
    {
      if (this->Rows.fields() > 0)
      {
        this->addCard(this->Rows.text(0));
      }
    }
    if (!this->HasHeader)
    {
      throw IOError(this->Path, "has no line MESH2D; check that it is a mesh of SMS.");
    }
    if (this->Mesh.XY.empty())
    {
      throw IOError(this->Path, "has no nodes; copy it again.");
    }
    this->findCorners();
    if (!this->HasMaterials)
    {
      this->Mesh.Regions.clear();
    }
    return std::move(this->Mesh);
  }

private:
  void addCard(std::string_view card)
  {
    if (card == "MESH2D")
    {
      this->HasHeader = true;
    }
    else if (card == "ND")
    {
      this->addNode();
    }
    else if (this->Part == ModelPart::Triangles)
    {
      if (card == "E3T")
      {
        this->addTriangle();
      }
      else if (card == "E4Q" || card == "E6T" || card == "E8Q" || card == "E9Q")
      {
        this->Rows.fail("the element " + std::string(card) +
          " is not a triangle of three nodes; divide such elements, or use the nodes alone, as "
          "'tipp delaunay' does.");
      }
    }
  }

  void addNode()
  {
    this->Rows.require(5, "a node");
    const std::int64_t number = this->Rows.integer(1);
    if (!this->Numbers.add(number))
    {
      this->Rows.fail("node " + std::to_string(number) + " is given twice.");
    }
    this->Mesh.XY.push_back(this->Rows.number(2));
    this->Mesh.XY.push_back(this->Rows.number(3));
    this->Mesh.Columns[0].Values.push_back(this->Rows.number(4));
  }

  void addTriangle()
  {
    this->Rows.require(5, "a triangle");
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      this->Mesh.Triangles.push_back(this->Rows.integer(2 + corner));
    }
    this->TriangleLines.push_back(this->Rows.lineNumber());
    this->HasMaterials = this->HasMaterials && this->Rows.fields() > 5;
    if (this->HasMaterials)
    {
      this->Mesh.Regions.push_back(this->Rows.number(5));
    }
  }

  /// Replaces the corners' numbers by indices. Triangles usually come before the nodes.
  void findCorners()
  {
    for (std::size_t i = 0; i < this->Mesh.Triangles.size(); ++i)
    {
      std::int64_t& corner = this->Mesh.Triangles[i];
      const std::int64_t index = this->Numbers.find(corner);
      if (index < 0)
      {
        throw IOError(this->Path, this->TriangleLines[i / 3],
          "names node " + std::to_string(corner) + ", which is not given.");
      }
      corner = index;
    }
  }

  const std::string Path;
  const ModelPart Part;
  NumberRows Rows;
  ModelMesh Mesh;
  NodeNumbers Numbers;
  std::vector<std::int64_t> TriangleLines; ///< the line of each triangle
  bool HasHeader = false;
  bool HasMaterials = true; ///< of all triangles so far
};

} // namespace

ModelMesh readSmsMesh(const std::string& path, ModelPart part)
{
  return SmsReader(path, part).read();
}

} // namespace tipp

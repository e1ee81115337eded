// SPDX-License-Identifier: BSD-3-Clause
#include "Cells/CutPolygon.h"
#include "Files/IOError.h"
#include "Files/TextFile.h"
#include "Models/ModelMesh.h"
#include "Models/NodeNumbers.h"
#include "Predicates/Geometry.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace tipp
{
namespace
{

/// Reads a two-dimensional mesh of SMS, which BASEMENT and other models also use
/// (https://www.xmswiki.com/wiki/SMS:2D_Mesh_Files_*.2dm): a line MESH2D, lines `E3T id a b c
/// material`, `E4Q id a b c d material` and `ND id x y z` in any order, and others, which are
/// ignored.
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
    this->addTriangles();
    const bool areUsual = std::is_sorted(this->Mesh.Numbers.begin(), this->Mesh.Numbers.end()) &&
      this->Mesh.Numbers.front() == 1 &&
      this->Mesh.Numbers.back() == std::int64_t(this->Mesh.Numbers.size());
    if (areUsual)
    {
      this->Mesh.Numbers.clear();
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
      if (card == "E3T" || card == "E4Q")
      {
        this->addElement(card == "E3T" ? 3 : 4);
      }
      else if (card == "E6T" || card == "E8Q" || card == "E9Q")
      {
        this->Rows.fail("the element " + std::string(card) +
          " is neither a triangle of three nodes nor a quadrilateral of four; divide such "
          "elements, or use the nodes alone, as "
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
    this->Mesh.Numbers.push_back(number);
    this->Mesh.XY.push_back(this->Rows.number(2));
    this->Mesh.XY.push_back(this->Rows.number(3));
    this->Mesh.Columns[0].Values.push_back(this->Rows.number(4));
  }

  void addElement(std::size_t corners)
  {
    this->Rows.require(2 + corners, corners == 3 ? "a triangle" : "a quadrilateral");
    Element element{ this->Rows.lineNumber(), corners, {}, 0 };
    for (std::size_t corner = 0; corner < corners; ++corner)
    {
      element.Corners[corner] = this->Rows.integer(2 + corner);
    }
    this->HasMaterials = this->HasMaterials && this->Rows.fields() > 2 + corners;
    element.Material = this->HasMaterials ? this->Rows.number(2 + corners) : 0;
    this->Elements.push_back(element);
  }

  /// Adds the elements as triangles. They usually come before the nodes.
  void addTriangles()
  {
    const bool hasOthers = std::any_of(this->Elements.begin(), this->Elements.end(),
      [](const Element& element) { return element.Size != 3; });
    std::int64_t index = 0;
    for (Element& element : this->Elements)
    {
      for (std::size_t i = 0; i < element.Size; ++i)
      {
        element.Corners[i] = this->findNode(element, element.Corners[i]);
      }
      const std::size_t before = this->Mesh.Triangles.size();
      this->cut(element);
      const std::size_t made = (this->Mesh.Triangles.size() - before) / 3;
      this->Mesh.Regions.insert(
        this->Mesh.Regions.end(), this->HasMaterials ? made : 0, element.Material);
      this->Mesh.OriginalCells.insert(
        this->Mesh.OriginalCells.end(), hasOthers ? made : 0, index++);
    }
  }

  /// An element, with the numbers of its nodes and then their indices.
  struct Element
  {
    std::int64_t Line;
    std::size_t Size;
    std::array<std::int64_t, 4> Corners;
    double Material;
  };

  std::int64_t findNode(const Element& element, std::int64_t number) const
  {
    const std::int64_t index = this->Numbers.find(number);
    if (index < 0)
    {
      throw IOError(
        this->Path, element.Line, "names node " + std::to_string(number) + ", which is not given.");
    }
    return index;
  }

  void cut(const Element& element)
  {
    std::vector<CornerTriangle> parts{ { 0, 1, 2 } };
    if (element.Size == 4)
    {
      std::vector<Point2> positions;
      for (const std::int64_t corner : element.Corners)
      {
        const auto at = 2 * std::size_t(corner);
        positions.push_back({ this->Mesh.XY[at], this->Mesh.XY[at + 1] });
      }
      parts.clear();
      if (!cutPolygon(positions, parts))
      {
        throw IOError(this->Path, element.Line,
          "gives a quadrilateral that crosses or touches itself or has no area; correct it.");
      }
    }
    for (const CornerTriangle& part : parts)
    {
      for (const std::size_t corner : part)
      {
        this->Mesh.Triangles.push_back(element.Corners[corner]);
      }
    }
  }

  const std::string Path;
  const ModelPart Part;
  NumberRows Rows;
  ModelMesh Mesh;
  NodeNumbers Numbers;
  std::vector<Element> Elements;
  bool HasHeader = false;
  bool HasMaterials = true; ///< of all elements so far
};

} // namespace

ModelMesh readSmsMesh(const std::string& path, ModelPart part)
{
  return SmsReader(path, part).read();
}

} // namespace tipp

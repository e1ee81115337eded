// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Models/ModelMesh.h"
#include "Models/NodeNumbers.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

constexpr const char* notAscii = "is neither version 2.2 nor 4.1 in ASCII; convert it, as with "
                                 "'gmsh -save -format msh22 FILE -o out.msh'.";

/// Throws IOError for a file that begins as a mesh of Gmsh in binary, or as one of ANSYS Fluent,
/// which has the same extension. Such a file has bytes that are not text.
void refuseOtherMeshes(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    return;
  }
  const InputFile file(path);
  std::string beginning(std::size_t(std::min<std::uint64_t>(file.size(), 64)), '\0');
  file.read(0, beginning.data(), beginning.size());
  if (beginning.substr(0, 1) == "(")
  {
    throw IOError(path,
      "is a mesh of ANSYS Fluent, not of Gmsh; convert it, as with 'meshio convert FILE out.vtu'.");
  }
  LineReader lines(beginning);
  std::string_view line;
  std::vector<std::string_view> fields;
  if (lines.next(line) && line == "$MeshFormat" && lines.next(line) &&
    splitFields(line, ' ', fields) && fields.size() > 1 && fields[1] != "0")
  {
    throw IOError(path, lines.lineNumber(), notAscii);
  }
}

/// Reads a mesh of Gmsh in ASCII, of version 2.2 or 4.1
/// (https://gmsh.info/doc/texinfo/gmsh.html#File-formats). Of its sections, MeshFormat, Entities,
/// Nodes and Elements are read. Points and lines among the elements are left out. The region of a
/// triangle is its first physical group, or 0 without one.
class GmshReader
{
public:
  GmshReader(const std::string& path, ModelPart part)
    : Path(path)
    , Part(part)
    , Rows(path, "a mesh of Gmsh")
  {
    this->Mesh.Columns.push_back({ "z", {} });
  }

  ModelMesh read()
  {
    while (this->Rows.nextIfAny())
    {
      if (this->Rows.fields() > 0 && this->Rows.text(0).substr(0, 1) == "$")
      {
        this->readSection(std::string(this->Rows.text(0)));
      }
    }
    this->requireSection("$MeshFormat");
    this->requireSection("$Nodes");
    if (this->Part == ModelPart::Triangles)
    {
      this->requireSection("$Elements");
    }
    if (!this->HasRegions)
    {
      this->Mesh.Regions.clear();
    }
    return std::move(this->Mesh);
  }

private:
  static constexpr std::int64_t LineType = 1;
  static constexpr std::int64_t TriangleType = 2;
  static constexpr std::int64_t PointType = 15;

  void requireSection(const std::string& name) const
  {
    if (this->Sections.count(name) == 0)
    {
      throw IOError(this->Path,
        "has no section " + name + "; copy it again, or check that it is a mesh of Gmsh.");
    }
  }

  /// Reads a section that has begun, to its end. Other sections are skipped by read().
  void readSection(const std::string& name)
  {
    const bool isFormat = name == "$MeshFormat";
    const bool isRead = name == "$Nodes" || name == "$Entities" ||
      (name == "$Elements" && this->Part == ModelPart::Triangles);
    if (!isFormat && !isRead)
    {
      return;
    }
    if (!isFormat && this->Version == 0)
    {
      this->Rows.fail(
        "has the section " + name + " before $MeshFormat; check that it is a mesh of Gmsh.");
    }
    if (isFormat)
    {
      this->readFormat();
    }
    else
    {
      this->readContent(name);
    }
    this->Rows.next(1, "the end of a section");
    if (this->Rows.text(0) != "$End" + name.substr(1))
    {
      this->Rows.fail("has more lines in the section " + name +
        " than announced; copy the file again or correct the number.");
    }
    this->Sections.insert(name);
  }

  void readContent(const std::string& name)
  {
    const bool isNew = this->Version == 4;
    if (name == "$Nodes")
    {
      isNew ? this->readNodes4() : this->readNodes2();
    }
    else if (name == "$Elements")
    {
      isNew ? this->readElements4() : this->readElements2();
    }
    else
    {
      this->readEntities();
    }
  }

  void readFormat()
  {
    this->Rows.next(2, "the version of the format");
    const double version = this->Rows.number(0);
    if ((version != 2.2 && version != 4.1) || this->Rows.integer(1) != 0)
    {
      this->Rows.fail(notAscii);
    }
    this->Version = version == 2.2 ? 2 : 4;
  }

  /// Reads a count in the given field of the row: there must be as many lines.
  std::int64_t count(std::size_t field) const
  {
    const std::int64_t count = this->Rows.integer(field);
    if (count < 0 || count > this->Rows.remainingLines())
    {
      this->Rows.fail("announces " + std::to_string(count) + " lines, but " +
        std::to_string(this->Rows.remainingLines()) +
        " follow; copy the file again or correct the number.");
    }
    return count;
  }

  void addNumber(std::int64_t number)
  {
    if (!this->Numbers.add(number))
    {
      this->Rows.fail("node " + std::to_string(number) + " is given twice.");
    }
  }

  void addPosition(std::size_t field)
  {
    this->Mesh.XY.push_back(this->Rows.number(field));
    this->Mesh.XY.push_back(this->Rows.number(field + 1));
    this->Mesh.Columns[0].Values.push_back(this->Rows.number(field + 2));
  }

  /// Reads `count` rows of at least `fields` numbers, and calls take() after each.
  template <typename Take>
  void readRows(std::int64_t count, std::size_t fields, const char* what, const Take& take)
  {
    for (; count > 0; --count)
    {
      this->Rows.next(fields, what);
      take();
    }
  }

  void readNodes2()
  {
    this->Rows.next(1, "the number of nodes");
    this->readRows(this->count(0), 4, "a node",
      [this]
      {
        this->addNumber(this->Rows.integer(0));
        this->addPosition(1);
      });
  }

  /// Nodes are in blocks: first the numbers of a block, then the positions.
  void readNodes4()
  {
    this->Rows.next(4, "the numbers of blocks and nodes");
    this->readRows(this->count(0), 4, "a block of nodes",
      [this]
      {
        const std::int64_t nodes = this->count(3);
        this->readRows(
          nodes, 1, "the number of a node", [this] { this->addNumber(this->Rows.integer(0)); });
        this->readRows(nodes, 3, "the position of a node", [this] { this->addPosition(0); });
      });
  }

  /// Adds a triangle, whose corners begin at the given field of the row.
  void addTriangle(std::size_t field, std::int64_t region)
  {
    this->Rows.require(field + 3, "a triangle");
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      const std::int64_t number = this->Rows.integer(field + corner);
      const std::int64_t index = this->Numbers.find(number);
      if (index < 0)
      {
        this->Rows.fail("names node " + std::to_string(number) + ", which is not given.");
      }
      this->Mesh.Triangles.push_back(index);
    }
    this->HasRegions = this->HasRegions || region != 0;
    this->Mesh.Regions.push_back(double(region));
  }

  /// Whether elements of this type are triangles; points and lines are not, and other elements are
  /// an error.
  bool areTriangles(std::int64_t type) const
  {
    if (type != TriangleType && type != LineType && type != PointType)
    {
      this->Rows.fail("the elements of type " + std::to_string(type) +
        " are not triangles of three nodes; divide such elements, or use the nodes alone, as "
        "'tipp delaunay' does.");
    }
    return type == TriangleType;
  }

  void readElements2()
  {
    this->Rows.next(1, "the number of elements");
    for (std::int64_t left = this->count(0); left > 0; --left)
    {
      this->Rows.next(3, "an element");
      if (this->areTriangles(this->Rows.integer(1)))
      {
        const std::int64_t tags = this->Rows.integer(2);
        if (tags < 0 || tags > std::int64_t(this->Rows.fields()))
        {
          this->Rows.fail("announces " + std::to_string(tags) + " tags; correct the line.");
        }
        this->Rows.require(std::size_t(tags) + 6, "a triangle");
        this->addTriangle(3 + std::size_t(tags), tags > 0 ? this->Rows.integer(3) : 0);
      }
    }
  }

  void readElements4()
  {
    this->Rows.next(4, "the numbers of blocks and elements");
    this->readRows(this->count(0), 4, "a block of elements",
      [this]
      {
        const auto group = this->GroupOf.find(this->Rows.integer(1));
        const bool hasTriangles = this->areTriangles(this->Rows.integer(2));
        this->readRows(this->count(3), 1, "an element",
          [&]
          {
            if (hasTriangles)
            {
              this->addTriangle(1, group == this->GroupOf.end() ? 0 : group->second);
            }
          });
      });
  }

  /// Reads the first physical group of each surface. A row of a surface has its number, six bounds,
  /// the number of groups, and the groups.
  void readEntities()
  {
    this->Rows.next(4, "the numbers of entities");
    const std::int64_t surfaces = this->count(2);
    const std::int64_t points = this->count(0);
    const std::int64_t curves = this->count(1);
    this->readRows(points, 1, "a point", [] {});
    this->readRows(curves, 1, "a curve", [] {});
    this->readRows(surfaces, 8, "a surface",
      [this]
      {
        if (this->Rows.integer(7) > 0)
        {
          this->Rows.require(9, "a surface");
          this->GroupOf[this->Rows.integer(0)] = this->Rows.integer(8);
        }
      });
  }

  const std::string Path;
  const ModelPart Part;
  NumberRows Rows;
  int Version = 0;
  std::set<std::string> Sections; ///< those that have been read
  ModelMesh Mesh;
  NodeNumbers Numbers;
  std::map<std::int64_t, std::int64_t> GroupOf; ///< the first physical group of a surface
  bool HasRegions = false;                      ///< a triangle has a physical group
};

} // namespace

ModelMesh readGmshMesh(const std::string& path, ModelPart part)
{
  refuseOtherMeshes(path);
  return GmshReader(path, part).read();
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PartitionedMesh.h"

#include "Files/Checksum.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

namespace tipp
{

namespace fs = std::filesystem;

namespace
{

// Reading is faster without preserving the order.
using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* formatName = "TIPP partitioned mesh";
constexpr int formatVersion = 1;
// Start of the text's last line but one; the checksum covers all bytes before the comma.
constexpr std::string_view checksumStart = ",\n\"xxh3\": \"";
constexpr std::string_view checksumEnd = "\"\n}\n";

OrderedJson packBox(const Box3& box)
{
  return box.Min.x <= box.Max.x ? OrderedJson(vtkBoundsOf(box)) : OrderedJson::array();
}

OrderedJson packPiece(const PieceSummary& piece)
{
  return { { "box", packBox(piece.Box) }, { "extent", packBox(piece.Extent) },
    { "points", piece.Points }, { "cells", piece.Cells }, { "borrowed_cells", piece.BorrowedCells },
    { "ghost_points", piece.GhostPoints }, { "bytes", piece.FileBytes },
    { "table", { piece.TableOffset, piece.TableBytes } },
    { "table_xxh3", checksumText(piece.TableChecksum) } };
}

OrderedJson packArray(const StoredArray& array)
{
  return { { "name", utf8Of(array.Name) }, { "of", array.OfPoints ? "points" : "cells" },
    { "type", scalarName(array.Type) }, { "components", array.Components },
    { "step", array.Step } };
}

std::uint64_t bytesOfTables(const PartitionedMesh& mesh)
{
  return std::accumulate(mesh.Pieces.begin(), mesh.Pieces.end(), std::uint64_t(0),
    [](std::uint64_t bytes, const PieceSummary& piece) { return bytes + piece.TableBytes; });
}

/// Reads the fields of an index; each error names the field.
class Fields
{
public:
  Fields(const Json& json, const std::string& path, std::string where)
    : Object(json)
    , Path(path)
    , Where(std::move(where))
  {
    this->require(json.is_object(), "is no object");
  }

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Path,
      (this->Where.empty() ? "the index" : this->Where) + " " + problem +
        "; copy or make the mesh again.");
  }

  /// The problem comes in two parts, so that no text is built for the thousands of fields that
  /// pass.
  void require(bool holds, const char* problem, const char* name = "") const
  {
    if (!holds)
    {
      this->fail(std::string(problem) + name);
    }
  }

  const Json& get(const char* name) const
  {
    const auto found = this->Object.find(name);
    this->require(found != this->Object.end(), "has no ", name);
    return *found;
  }

  /// Null if there is none.
  const Json* find(const char* name) const
  {
    const auto found = this->Object.find(name);
    return found == this->Object.end() ? nullptr : &*found;
  }

  std::int64_t integer(const char* name, std::int64_t least, std::int64_t most) const
  {
    const std::optional<std::int64_t> value = integerOf(this->get(name));
    this->require(value && *value >= least && *value <= most, "has a wrong ", name);
    return *value;
  }

  std::string text(const char* name) const
  {
    const Json& value = this->get(name);
    this->require(value.is_string(), "has a wrong ", name);
    return value.get<std::string>();
  }

  const Json& list(const char* name) const
  {
    const Json& value = this->get(name);
    this->require(value.is_array(), "has a wrong ", name);
    return value;
  }

  /// An empty list denotes an empty box.
  Box3 box(const char* name) const
  {
    const Json& value = this->list(name);
    std::array<double, 6> result = vtkBoundsOf(Box3::empty());
    this->require(value.empty() || value.size() == 6, "has a wrong ", name);
    for (std::size_t i = 0; i < value.size(); ++i)
    {
      this->require(value[i].is_number(), "has a wrong ", name);
      result[i] = value[i].get<double>();
      const bool good = std::isfinite(result[i]) && (i % 2 == 0 || result[i - 1] <= result[i]);
      this->require(good, "has a wrong ", name);
    }
    return boxOfVtkBounds<3>(result.data());
  }

  static std::optional<std::int64_t> integerOf(const Json& value)
  {
    if (value.is_number_unsigned() &&
      value.get<std::uint64_t>() > std::uint64_t(std::numeric_limits<std::int64_t>::max()))
    {
      return std::nullopt;
    }
    return value.is_number_integer() ? std::make_optional(value.get<std::int64_t>()) : std::nullopt;
  }

private:
  const Json& Object;
  const std::string& Path;
  std::string Where;
};

StoredArray parseArray(const Fields& fields, std::size_t steps)
{
  StoredArray array;
  array.Name = fields.text("name");
  const std::string of = fields.text("of");
  fields.require(of == "points" || of == "cells", "is neither of points nor of cells");
  array.OfPoints = of == "points";
  const std::optional<Scalar> type = scalarFromName(fields.text("type"));
  fields.require(type.has_value(), "has a wrong type");
  array.Type = *type;
  array.Components = int(fields.integer("components", 1, 1 << 20));
  array.Step = int(fields.integer("step", -1, std::int64_t(steps) - 1));
  return array;
}

PieceSummary parsePiece(const Fields& fields, const PartitionedMesh& mesh)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
  PieceSummary piece;
  piece.Box = fields.box("box");
  piece.Extent = fields.box("extent");
  piece.Points = fields.integer("points", 0, mesh.Points);
  piece.Cells = fields.integer("cells", 0, mesh.Cells);
  piece.BorrowedCells = fields.integer("borrowed_cells", 0, mesh.Cells);
  piece.GhostPoints = fields.integer("ghost_points", 0, mesh.Duplicated ? mesh.Points : 0);
  piece.FileBytes = std::uint64_t(fields.integer("bytes", 0, most));
  const Json& table = fields.list("table");
  fields.require(table.size() == 2, "has a wrong table");
  const std::optional<std::int64_t> offset = Fields::integerOf(table[0]);
  const std::optional<std::int64_t> bytes = Fields::integerOf(table[1]);
  fields.require(
    offset && bytes && *offset >= 0 && *bytes >= 0 && *bytes % 8 == 0 && *bytes <= most - *offset,
    "has a wrong table");
  piece.TableOffset = std::uint64_t(*offset);
  piece.TableBytes = std::uint64_t(*bytes);
  fields.require(
    parseChecksum(fields.text("table_xxh3"), piece.TableChecksum), "has a wrong table_xxh3");
  return piece;
}

void parseArrays(const Fields& fields, const std::string& path, PartitionedMesh& mesh)
{
  std::set<std::tuple<bool, std::string, int>> names;
  for (const Json& json : fields.list("arrays"))
  {
    const std::string where = "array " + std::to_string(mesh.Arrays.size());
    StoredArray array = parseArray(Fields(json, path, where), mesh.Times.size());
    const bool isNew = names.emplace(array.OfPoints, array.Name, array.Step).second &&
      (array.Step < 0 || names.count({ array.OfPoints, array.Name, -1 }) == 0);
    fields.require(isNew, "has two arrays named ", array.Name.c_str());
    const bool ordered = mesh.Arrays.empty() || mesh.Arrays.back().OfPoints || !array.OfPoints;
    fields.require(ordered, "has arrays of points after those of cells");
    mesh.Arrays.push_back(std::move(array));
  }
}

void parsePieces(const Fields& fields, const std::string& path, PartitionedMesh& mesh)
{
  const Json& list = fields.list("pieces");
  fields.require(std::int64_t(list.size()) <= mostPieces, "has too many pieces");
  std::int64_t cells = 0;
  for (const Json& json : list)
  {
    const std::string where = "piece " + std::to_string(mesh.Pieces.size());
    mesh.Pieces.push_back(parsePiece(Fields(json, path, where), mesh));
    fields.require(mesh.Pieces.back().Cells <= mesh.Cells - cells, "has wrong counts of cells");
    cells += mesh.Pieces.back().Cells;
  }
  fields.require(cells == mesh.Cells, "has wrong counts of cells");
}

/// Parses the text, and sets `checksum` to the one that it names and has.
Json parseJson(const std::string& text, const std::string& path, std::uint64_t& checksum)
{
  constexpr std::size_t digits = 16;
  constexpr std::size_t tail = checksumStart.size() + digits + checksumEnd.size();
  const std::size_t hashed = text.size() - std::min(tail, text.size());
  const std::string_view last = std::string_view(text).substr(hashed);
  if (last.size() < tail || last.substr(0, checksumStart.size()) != checksumStart ||
    last.substr(tail - checksumEnd.size()) != checksumEnd ||
    !parseChecksum(std::string(last.substr(checksumStart.size(), digits)), checksum))
  {
    throw IOError(
      path, "is not the whole index of a partitioned mesh; copy or make the mesh again.");
  }
  if (checksumOf(text.data(), hashed) != checksum)
  {
    throw IOError(path, "does not have the checksum it names; copy or make the mesh again.");
  }
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
  {
    throw IOError(path, "is not JSON; copy or make the mesh again.");
  }
  return json;
}

constexpr const char* indexName = "index.json";
constexpr const char* tablesName = "tables.bin";
constexpr const char* pvtuName = "mesh.pvtu";
constexpr const char* vtkHdfName = "mesh.vtkhdf";

/// Whether the path is that of a mesh's index or of its view for vtkHDFReader.
bool isFileOfMesh(const fs::path& path)
{
  return path.filename() == indexName || path.filename() == vtkHdfName;
}

std::string indexOf(const std::string& path)
{
  std::error_code ignored;
  const fs::path given = path;
  const bool isFolder = fs::is_directory(given, ignored);
  return isFolder         ? (given / indexName).string()
    : isFileOfMesh(given) ? (given.parent_path() / indexName).string()
                          : path;
}

std::string readText(const std::string& path)
{
  constexpr std::uint64_t most = std::uint64_t(1) << 32;
  const InputFile file(path);
  if (file.size() > most)
  {
    throw IOError(path, "is larger than any such file of a partitioned mesh; check the name.");
  }
  std::string text(std::size_t(file.size()), '\0');
  file.read(0, text.data(), text.size());
  return text;
}

void requireSize(const std::string& path, std::uint64_t bytes)
{
  std::error_code failure;
  const std::uint64_t size = fs::file_size(path, failure);
  if (failure)
  {
    throw IOError(path,
      "is missing from the partitioned mesh (" + failure.message() +
        "); copy or make the mesh again.");
  }
  if (size != bytes)
  {
    throw IOError(path,
      "has " + std::to_string(size) + " bytes where the index says " + std::to_string(bytes) +
        "; copy or make the mesh again.");
  }
}

} // namespace

std::string indexText(const PartitionedMesh& mesh)
{
  OrderedJson arrays = OrderedJson::array();
  std::transform(mesh.Arrays.begin(), mesh.Arrays.end(), std::back_inserter(arrays), packArray);
  OrderedJson pieces = OrderedJson::array();
  std::transform(mesh.Pieces.begin(), mesh.Pieces.end(), std::back_inserter(pieces), packPiece);
  OrderedJson json = {
    { "format", formatName },
    { "version", formatVersion },
    { "cell_type", mesh.CellSize == 3 ? "triangle" : "tetrahedron" },
    { "point_type", scalarName(mesh.PointType) },
    { "borrowers", mesh.Duplicated ? "duplicate" : "reference" },
    { "points", mesh.Points },
    { "cells", mesh.Cells },
    { "domain", packBox(mesh.Domain) },
    { "tiling", mesh.Tiling },
    { "times", mesh.Times },
    { "tables_bytes", bytesOfTables(mesh) },
    { "arrays", std::move(arrays) },
    { "pieces", std::move(pieces) },
    { "pvtu_bytes", mesh.PvtuBytes },
    { "pvtu_xxh3", checksumText(mesh.PvtuChecksum) },
    { "vtkhdf_bytes", mesh.VtkHdfBytes },
    { "vtkhdf_xxh3", checksumText(mesh.VtkHdfChecksum) },
  };
  if (!mesh.Description.isEmpty())
  {
    json["description"] = OrderedJson::parse(descriptionText(mesh.Description, false));
  }
  // One line per field, and one per piece.
  std::string text = "{";
  for (const auto& [name, value] : json.items())
  {
    text += (text.size() > 1 ? ",\n" : "\n") + OrderedJson(name).dump() + ": ";
    if (value.is_array() && !value.empty() && value[0].is_object())
    {
      for (std::size_t i = 0; i < value.size(); ++i)
      {
        text += (i == 0 ? "[\n  " : ",\n  ") +
          value[i].dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
      }
      text += "\n]";
    }
    else
    {
      text += value.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
    }
  }
  const std::string checksum = checksumText(checksumOf(text.data(), text.size()));
  text.append(checksumStart).append(checksum).append(checksumEnd);
  return text;
}

PartitionedMesh parseIndex(const std::string& text, const std::string& path)
{
  constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max() / 64;
  PartitionedMesh mesh;
  const Json json = parseJson(text, path, mesh.IndexChecksum);
  const Fields fields(json, path, "");
  fields.require(fields.text("format") == formatName, "is not one of a partitioned mesh");
  if (fields.integer("version", 1, most) != formatVersion)
  {
    throw IOError(path,
      "is of version " + std::to_string(fields.integer("version", 1, most)) +
        ", and this program reads version 1; use a newer one.");
  }
  const std::string cellType = fields.text("cell_type");
  fields.require(cellType == "triangle" || cellType == "tetrahedron", "has a wrong cell_type");
  mesh.CellSize = cellType == "triangle" ? 3 : 4;
  const std::string pointType = fields.text("point_type");
  fields.require(pointType == "Float64" || pointType == "Float32", "has a wrong point_type");
  mesh.PointType = pointType == "Float64" ? Scalar::Float64 : Scalar::Float32;
  const std::string borrowers = fields.text("borrowers");
  fields.require(
    borrowers == "duplicate" || borrowers == "reference", "has a wrong value of borrowers");
  mesh.Duplicated = borrowers == "duplicate";
  mesh.Points = fields.integer("points", 0, most);
  mesh.Cells = fields.integer("cells", 0, most);
  mesh.Domain = fields.box("domain");
  mesh.Tiling = fields.text("tiling");
  for (const Json& time : fields.list("times"))
  {
    fields.require(time.is_number() && std::isfinite(time.get<double>()), "has wrong times");
    mesh.Times.push_back(time.get<double>());
  }
  if (const Json* const description = fields.find("description"))
  {
    mesh.Description = parseDescription(description->dump(), path);
  }
  parseArrays(fields, path, mesh);
  parsePieces(fields, path, mesh);
  fields.require(std::uint64_t(fields.integer("tables_bytes", 0, most)) == bytesOfTables(mesh),
    "has a wrong tables_bytes");
  mesh.PvtuBytes = std::uint64_t(fields.integer("pvtu_bytes", 0, most));
  fields.require(
    parseChecksum(fields.text("pvtu_xxh3"), mesh.PvtuChecksum), "has a wrong pvtu_xxh3");
  if (json.contains("vtkhdf_bytes"))
  {
    mesh.VtkHdfBytes = std::uint64_t(fields.integer("vtkhdf_bytes", 1, most));
    fields.require(
      parseChecksum(fields.text("vtkhdf_xxh3"), mesh.VtkHdfChecksum), "has a wrong vtkhdf_xxh3");
  }
  return mesh;
}

std::string pieceName(std::size_t piece)
{
  const std::string number = std::to_string(piece);
  return "pieces/" + std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".vtu";
}

std::string PartitionedMesh::piecePath(std::size_t piece) const
{
  return this->Path + "/" + pieceName(piece);
}

std::string PartitionedMesh::tablesPath() const
{
  return this->Path + "/" + tablesName;
}

std::string PartitionedMesh::indexPath() const
{
  return this->Path + "/" + indexName;
}

std::string PartitionedMesh::pvtuPath() const
{
  return this->Path + "/" + pvtuName;
}

std::string PartitionedMesh::vtkHdfPath() const
{
  return this->Path + "/" + vtkHdfName;
}

namespace
{

PartitionedMesh openIndex(const std::string& index)
{
  PartitionedMesh mesh = parseIndex(readText(index), index);
  const fs::path folder = fs::path(index).parent_path();
  mesh.Path = folder.empty() ? "." : folder.string();
  std::uint64_t tables = 0;
  for (std::size_t i = 0; i < mesh.Pieces.size(); ++i)
  {
    const PieceSummary& piece = mesh.Pieces[i];
    requireSize(mesh.piecePath(i), piece.FileBytes);
    if (piece.TableOffset != tables || piece.TableBytes > (std::uint64_t(1) << 62) - tables)
    {
      throw IOError(index, "has tables out of order; copy or make the mesh again.");
    }
    tables += piece.TableBytes;
  }
  requireSize(mesh.tablesPath(), tables);
  requireSize(mesh.pvtuPath(), mesh.PvtuBytes);
  if (mesh.VtkHdfBytes > 0)
  {
    requireSize(mesh.vtkHdfPath(), mesh.VtkHdfBytes);
  }
  return mesh;
}

} // namespace

PartitionedMesh openPartitionedMesh(const std::string& path)
{
  const std::string index = indexOf(path);
  for (int triesLeft = 16;; --triesLeft)
  {
    const PathState state = stateOf(index);
    try
    {
      PartitionedMesh mesh = openIndex(index);
      mesh.IndexState = state;
      return mesh;
    }
    catch (const IOError&)
    {
      if (stateOf(index).Values == state.Values)
      {
        throw;
      }
      if (triesLeft == 0)
      {
        failReplaced(path);
      }
    }
  }
}

bool wasReplaced(const PartitionedMesh& mesh)
{
  return mesh.IndexState.Values && stateOf(mesh.indexPath()).Values != mesh.IndexState.Values;
}

void failReplaced(const std::string& path)
{
  throw IOError(path, "was replaced or removed while it was read; read it again.");
}

void verifyViews(const PartitionedMesh& mesh)
{
  const auto verify = [](const std::string& path, std::uint64_t checksum)
  {
    if (fileChecksum(path) != checksum)
    {
      throw IOError(
        path, "does not have the checksum that the index gives; copy or make the mesh again.");
    }
  };
  readUnchanged(mesh,
    [&]
    {
      verify(mesh.pvtuPath(), mesh.PvtuChecksum);
      if (mesh.VtkHdfBytes > 0)
      {
        verify(mesh.vtkHdfPath(), mesh.VtkHdfChecksum);
      }
    });
}

bool isPartitionedMesh(const std::string& path)
{
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
  {
    const auto has = [&](const char* name)
    { return fs::is_regular_file(fs::path(path) / name, ignored); };
    // With the extension, a folder that lacks these files is reported as a damaged mesh, unless it
    // is a flat mesh.
    return (has(indexName) && has(tablesName)) ||
      (isOpenedBy(path, Opener::Pieces) && !has("cells.npy"));
  }
  const fs::path folder = fs::path(path).parent_path();
  return isFileOfMesh(path) && fs::is_regular_file(folder / indexName, ignored) &&
    fs::is_regular_file(folder / tablesName, ignored);
}

} // namespace tipp

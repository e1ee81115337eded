// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioned/PartitionedMesh.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Partitioned/Checksum.h"

#include <filesystem>
#include <system_error>

namespace tipp
{

namespace fs = std::filesystem;

namespace
{

constexpr const char* indexName = "index.json";
constexpr const char* tablesName = "tables.bin";
constexpr const char* pvtuName = "mesh.pvtu";

std::string indexOf(const std::string& path)
{
  std::error_code ignored;
  return fs::is_directory(path, ignored) ? (fs::path(path) / indexName).string() : path;
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

PartitionedMesh openPartitionedMesh(const std::string& path)
{
  const std::string index = indexOf(path);
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
  return mesh;
}

void verifyPvtu(const PartitionedMesh& mesh)
{
  const std::string text = readText(mesh.pvtuPath());
  if (checksumOf(text.data(), text.size()) != mesh.PvtuChecksum)
  {
    throw IOError(mesh.pvtuPath(),
      "does not have the checksum that the index gives; copy or make the mesh again.");
  }
}

bool isPartitionedMesh(const std::string& path)
{
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
  {
    return fs::is_regular_file(fs::path(path) / indexName, ignored) &&
      fs::is_regular_file(fs::path(path) / tablesName, ignored);
  }
  return fs::path(path).filename() == indexName &&
    fs::is_regular_file(fs::path(path).parent_path() / tablesName, ignored);
}

} // namespace tipp

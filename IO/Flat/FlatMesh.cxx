// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatMesh.h"

#include "Files/IOError.h"
#include "Files/PendingOutput.h"
#include "Npy/NpyFile.h"
#include "Parallel/ParallelFor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <stdexcept>

namespace tipp
{

namespace
{

// A block of 32-bit ids stays in the L1 cache while it is widened.
constexpr std::int64_t blockIds = 4096;

} // namespace

CellReader::CellReader(const FlatMesh& mesh, int threads)
  : Cells(mesh.Cells)
  , Points(mesh.Points.Tuples)
  , CellSize(mesh.CellSize)
  , Threads(threads)
  , File(mesh.Cells.Path)
{
}

void CellReader::read(std::int64_t first, std::int64_t cells, std::vector<std::int64_t>& ids) const
{
  if (first < 0 || cells < 0 || cells > this->Cells.Tuples - first)
  {
    throw std::out_of_range("cells beyond the mesh are asked for");
  }
  const std::int64_t firstId = first * this->CellSize;
  const std::int64_t count = cells * this->CellSize;
  ids.resize(std::size_t(count));
  // Blocks per thread, enough to amortise the system calls.
  constexpr std::int64_t share = 64 * blockIds;
  parallelFor((count + share - 1) / share, this->Threads,
    [&](std::int64_t i)
    {
      poll();
      const std::int64_t from = i * share;
      const std::int64_t end = std::min(from + share, count);
      for (std::int64_t at = from; at < end; at += blockIds)
      {
        this->readBlock(firstId + at, std::min(blockIds, end - at), ids.data() + at);
      }
    });
}

void CellReader::readBlock(std::int64_t firstId, std::int64_t count, std::int64_t* ids) const
{
  const std::size_t size = scalarSize(this->Cells.Type);
  const std::uint64_t offset = this->Cells.Offset + std::uint64_t(firstId) * size;
  if (this->Cells.Type == Scalar::Int32)
  {
    std::array<std::int32_t, blockIds> narrow;
    this->File.read(offset, narrow.data(), std::size_t(count) * size);
    std::copy(narrow.begin(), narrow.begin() + count, ids);
  }
  else
  {
    this->File.read(offset, ids, std::size_t(count) * size);
  }
  if (!areBelow(ids, std::size_t(count), this->Points))
  {
    this->reportBadId(firstId, count, ids);
  }
}

void CellReader::reportBadId(
  std::int64_t firstId, std::int64_t count, const std::int64_t* ids) const
{
  const std::int64_t* const bad = std::find_if(
    ids, ids + count, [this](std::int64_t id) { return id < 0 || id >= this->Points; });
  const std::int64_t cell = (firstId + (bad - ids)) / this->CellSize;
  throw IOError(this->File.path(),
    "gives cell " + std::to_string(cell) + " the vertex id " + std::to_string(*bad) +
      ", but the mesh has " + std::to_string(this->Points) +
      " points, counted from 0; correct the cells.");
}

std::string arrayFileName(const std::string& name)
{
  constexpr char digits[] = "0123456789ABCDEF";
  std::string file;
  for (const char c : name)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '/' || c == '\\' || c == '%' || byte < 0x20 || byte == 0x7f ||
      (c == '.' && file.empty()))
    {
      file += { '%', digits[byte >> 4], digits[byte & 15] };
    }
    else
    {
      file += c;
    }
  }
  return file;
}

std::string arrayNameOf(const std::string& fileName)
{
  std::string name;
  for (std::size_t i = 0; i < fileName.size(); ++i)
  {
    unsigned int byte = 0;
    const char* const digits = fileName.data() + i + 1;
    if (fileName[i] == '%' && i + 2 < fileName.size() &&
      std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2)
    {
      name += static_cast<char>(byte);
      i += 2;
    }
    else
    {
      name += fileName[i];
    }
  }
  return name;
}

namespace
{

namespace fs = std::filesystem;

RawArray rawArray(const NpyArray& file, const std::string& name, std::int64_t tuples,
  std::int64_t components, std::int64_t step = 0)
{
  RawArray array{ name, file.Path, file.Offset, file.Type, int(components), tuples };
  array.Offset += std::uint64_t(step) * array.bytes();
  return array;
}

/// Opens a table of `least` or one more columns, of one of two types.
RawArray openTable(const std::string& folder, const std::string& name, std::int64_t least,
  std::array<Scalar, 2> types, const std::string& wanted)
{
  const NpyArray file = openNpyArray(InputFile(folder + "/" + name + ".npy"));
  const bool isOfType = file.Type == types[0] || file.Type == types[1];
  if (file.Shape.size() != 2 || (file.Shape[1] != least && file.Shape[1] != least + 1) || !isOfType)
  {
    throw IOError(
      file.Path, "is " + file.shapeText() + " " + scalarName(file.Type) + "; save " + wanted + ".");
  }
  return rawArray(file, name, file.Shape[0], file.Shape[1]);
}

std::vector<double> readTimes(const std::string& folder)
{
  const std::string path = folder + "/time.npy";
  if (!fs::exists(path))
  {
    return {};
  }
  const NpyArray file = openNpyArray(InputFile(path));
  if (file.Shape.size() != 1 || file.Type != Scalar::Float64)
  {
    throw IOError(path,
      "is " + file.shapeText() + " " + scalarName(file.Type) +
        "; save one time a step as float64.");
  }
  std::vector<double> times(std::size_t(file.Shape[0]));
  InputFile(path).read(file.Offset, times.data(), times.size() * sizeof(double));
  const auto later = [](double a, double b) { return !(a < b); };
  if (std::adjacent_find(times.begin(), times.end(), later) != times.end() ||
    !std::all_of(times.begin(), times.end(), [](double t) { return std::isfinite(t); }))
  {
    throw IOError(path, "holds times that are not finite and ascending; sort the steps by time.");
  }
  return times;
}

constexpr const char* descriptionName = "/description.json";

/// Reads what the folder says of its numbers; nothing if it says nothing.
MeshDescription readDescription(const std::string& folder)
{
  constexpr std::uint64_t most = std::uint64_t(1) << 26;
  const std::string path = folder + descriptionName;
  std::error_code ignored;
  if (!fs::exists(path, ignored))
  {
    return {};
  }
  const InputFile file(path);
  if (file.size() > most)
  {
    throw IOError(path, "is larger than any description of a mesh; remove it.");
  }
  std::string text(std::size_t(file.size()), '\0');
  file.read(0, text.data(), text.size());
  return parseDescription(text, path);
}

/// The number of components if the shape from `axis` on is (n), (n, 1) or (n, c); 0 otherwise.
std::int64_t componentsFrom(const NpyArray& file, std::size_t axis, std::int64_t tuples)
{
  const std::size_t dimensions = file.Shape.size();
  if (dimensions <= axis || dimensions > axis + 2 || file.Shape[axis] != tuples)
  {
    return 0;
  }
  return dimensions == axis + 1 ? 1 : file.Shape[axis + 1];
}

void openData(const std::string& path, std::int64_t tuples, std::int64_t steps, const char* what,
  std::vector<RawArray>& plain, std::vector<std::vector<RawArray>>& series)
{
  const NpyArray file = openNpyArray(InputFile(path));
  const std::string name = arrayNameOf(fs::path(path).stem().string());
  // If both layouts fit, the first axis is time.
  const std::int64_t varying = steps > 0 && !file.Shape.empty() && file.Shape[0] == steps
    ? componentsFrom(file, 1, tuples)
    : 0;
  const std::int64_t components = varying > 0 ? varying : componentsFrom(file, 0, tuples);
  constexpr std::int64_t limit = std::numeric_limits<int>::max() / 8;
  if (components <= 0 || components > limit)
  {
    const std::string n = std::to_string(tuples);
    throw IOError(path,
      "is " + file.shapeText() + " where the mesh has " + n + " " + what + "; save " + n +
        " numbers or " + n + " x c" +
        (steps > 0 ? ", with a leading axis of " + std::to_string(steps) + " if it varies in time."
                   : "."));
  }
  if (varying == 0)
  {
    plain.push_back(rawArray(file, name, tuples, components));
    return;
  }
  series.emplace_back();
  for (std::int64_t step = 0; step < steps; ++step)
  {
    series.back().push_back(rawArray(file, name, tuples, components, step));
  }
}

/// The folder's .npy files sorted by name, so that the arrays' order is the same on every machine.
std::vector<std::string> arrayFiles(const std::string& folder)
{
  std::vector<std::string> paths;
  std::error_code failure;
  if (fs::is_directory(folder, failure))
  {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure))
    {
      if (extensionOf(entry.path().string()) == ".npy" &&
        entry.path().filename().string().front() != '.')
      {
        paths.push_back(entry.path().string());
      }
    }
  }
  if (failure && failure != std::errc::no_such_file_or_directory)
  {
    throw IOError(folder, "cannot be listed (" + failure.message() + ").");
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

bool isFlatFolder(const std::string& path)
{
  std::error_code failure;
  return fs::is_regular_file(path + "/cells.npy", failure) &&
    fs::is_regular_file(path + "/points.npy", failure);
}

FlatMesh openFlatFolder(const std::string& path)
{
  if (!isFlatFolder(path))
  {
    throw IOError(path,
      "is a folder without cells.npy and points.npy; 'tipp flatten' makes one of any VTK file.");
  }
  FlatMesh mesh;
  mesh.Path = path;
  mesh.Cells = openTable(path, "cells", 3, { Scalar::Int32, Scalar::Int64 },
    "m x 3 vertex ids (triangles) or m x 4 (tetrahedra) as int32 or int64");
  mesh.CellSize = mesh.Cells.Components;
  mesh.Points = openTable(path, "points", 2, { Scalar::Float32, Scalar::Float64 },
    "n x 2 or n x 3 coordinates as float64 or float32");
  if (mesh.CellSize == 4 && mesh.Points.Components != 3)
  {
    throw IOError(path, "holds tetrahedra with points of 2 coordinates; give the points a third.");
  }
  mesh.Times = readTimes(path);
  const auto steps = std::int64_t(mesh.Times.size());
  for (const std::string& file : arrayFiles(path + "/point_data"))
  {
    openData(file, mesh.Points.Tuples, steps, "points", mesh.PointData, mesh.PointSeries);
  }
  for (const std::string& file : arrayFiles(path + "/cell_data"))
  {
    openData(file, mesh.Cells.Tuples, steps, "cells", mesh.CellData, mesh.CellSeries);
  }
  mesh.Description = readDescription(path);
  return mesh;
}

void writeDescription(const std::string& folder, const MeshDescription& description)
{
  if (!description.isEmpty())
  {
    const std::string text = descriptionText(description, true) + "\n";
    PendingFile file(folder + descriptionName);
    file.file().write(0, text.data(), text.size());
    file.commit();
  }
}

/// Returns false if `aborted`, called between steps, returned true.
bool writeArray(const std::string& path, const FlatArray& array, bool table,
  const std::function<bool()>& aborted = {})
{
  std::vector<std::int64_t> shape;
  if (array.Steps > 0)
  {
    shape.push_back(array.Steps);
  }
  shape.push_back(array.Tuples);
  if (array.Components > 1 || table)
  {
    shape.push_back(array.Components);
  }
  NpyWriter writer(path, scalarDescr(array.Type), shape);
  const std::size_t stepBytes =
    std::size_t(array.Tuples) * std::size_t(array.Components) * scalarSize(array.Type);
  const std::int64_t steps = std::max<std::int64_t>(array.Steps, 1);
  for (std::int64_t step = 0; step < steps; ++step)
  {
    if (aborted && aborted())
    {
      return false;
    }
    writer.write(array.StepValues
        ? array.StepValues(step)
        : static_cast<const char*>(array.Values) + std::size_t(step) * stepBytes,
      stepBytes);
  }
  writer.close();
  return true;
}

void writeCells(const std::string& path, const FlatContent& content)
{
  const std::int64_t count = std::int64_t(content.Cells.size()) / content.CellSize;
  FlatArray array{ "cells", Scalar::Int64, content.CellSize, count, 0, content.Cells.data(), {} };
  std::vector<std::int32_t> narrow;
  if (content.Points.Tuples <= std::numeric_limits<std::int32_t>::max())
  {
    narrow.assign(content.Cells.begin(), content.Cells.end());
    array.Type = Scalar::Int32;
    array.Values = narrow.data();
  }
  writeArray(path, array, true);
}

bool writeData(const std::string& folder, const std::vector<FlatArray>& arrays,
  const std::function<bool()>& aborted)
{
  std::filesystem::create_directory(folder);
  for (const FlatArray& array : arrays)
  {
    const std::string name = arrayFileName(array.Name) + ".npy";
    if (name.size() > NAME_MAX)
    {
      throw IOError("The array '" + array.Name.substr(0, 40) + "...' needs a file name of " +
        std::to_string(name.size()) + " bytes, more than " + std::to_string(NAME_MAX) +
        "; give it a shorter name.");
    }
    const std::string path = folder + "/" + name;
    if (array.Name.empty() || std::filesystem::exists(path))
    {
      throw IOError(folder,
        "cannot hold the array '" + array.Name +
          "', which has no name or that of another; rename it.");
    }
    if (!writeArray(path, array, false, aborted))
    {
      return false;
    }
  }
  return true;
}

} // namespace

namespace
{

/// Whether a file may be a flat mesh by its name. VTK reads surfaces with other polygons, too, so
/// that .vtp files are left to it.
bool isVtuName(const std::string& path)
{
  const std::string extension = extensionOf(path);
#ifdef TIPP_WITHOUT_VTK
  return extension == ".vtu" || extension == ".vtp";
#else
  return extension == ".vtu";
#endif
}

} // namespace

FlatMesh openFlatMesh(const std::string& path)
{
  std::error_code failure;
  if (std::filesystem::is_directory(path, failure))
  {
    return openFlatFolder(path);
  }
  if (isVtuName(path))
  {
    return openFlatVtu(path);
  }
  throw IOError(path,
    "is neither a folder of .npy arrays nor a .vtu file; 'tipp flatten' makes such a folder of any "
    "VTK file.");
}

bool isFlatMesh(const std::string& path)
{
  std::error_code failure;
  return std::filesystem::is_directory(path, failure) ? isFlatFolder(path)
                                                      : isVtuName(path) && isFlatVtu(path);
}

bool writeFlatMesh(
  const std::string& path, const FlatContent& content, const std::function<bool()>& aborted)
{
  requireFolderName(path);
  PendingFolder folder(path);
  const std::string& in = folder.temporaryPath();
  writeCells(in + "/cells.npy", content);
  writeArray(in + "/points.npy", content.Points, true);
  writeDescription(in, content.Description);
  if (!content.Times.empty())
  {
    const auto steps = std::int64_t(content.Times.size());
    writeArray(
      in + "/time.npy", { "time", Scalar::Float64, 1, steps, 0, content.Times.data(), {} }, false);
  }
  if (!writeData(in + "/point_data", content.PointData, aborted) ||
    !writeData(in + "/cell_data", content.CellData, aborted) || (aborted && aborted()))
  {
    return false;
  }
  folder.commit();
  return true;
}

} // namespace tipp

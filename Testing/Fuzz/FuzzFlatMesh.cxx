// SPDX-License-Identifier: BSD-3-Clause
// Changes bytes of valid flat meshes (folders of .npy files, and .vtu files) and opens them. If a
// mesh opens, all its arrays must lie inside its files and be readable. Otherwise the error must be
// an IOError.
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "FuzzDriver.h"
#include "Loading/VertexLoader.h"
#include "Mutate.h"

#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

namespace
{

namespace fs = std::filesystem;
using namespace tipp;

std::string contentOf(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

/// Valid meshes to start with, in a temporary folder.
class Seeds
{
public:
  Seeds()
  {
    std::string pattern = (fs::temp_directory_path() / "tippFuzzXXXXXX").string();
    if (!mkdtemp(pattern.data()))
    {
      std::perror("fuzzFlatMesh");
      std::exit(2);
    }
    this->Folder = pattern;
    this->writeFolder();
    for (const int header : { 32, 64 })
    {
      this->writeVtu(header);
    }
  }
  ~Seeds() { fs::remove_all(this->Folder); }
  Seeds(const Seeds&) = delete;
  Seeds& operator=(const Seeds&) = delete;

  fs::path flat() const { return this->Folder / "flat"; }
  fs::path vtu(int header) const { return this->Folder / (std::to_string(header) + ".vtu"); }
  fs::path scratch(const char* name) const { return this->Folder / name; }

private:
  void writeFolder() const
  {
    const std::vector<double> xy{ 0, 0, 1, 0, 1, 1, 0, 1 };
    const std::vector<float> level(8, 0.5F);
    FlatContent content;
    content.Cells = { 0, 1, 2, 0, 2, 3 };
    content.Points = { "points", Scalar::Float64, 2, 4, 0, xy.data(), {} };
    content.PointData = { { "level", Scalar::Float32, 1, 4, 2, level.data(), {} } };
    content.CellData = { { "pair", Scalar::Float64, 2, 2, 0, xy.data(), {} } };
    content.Times = { 0, 1 };
    content.Description.TimeUnits = "days since 2001-02-03";
    content.Description.Crs = "EPSG:4326";
    content.Description.add("level", false, { "water level", "", "m", -99999, {} });
    content.Description.add("pair", true, { "", "", "", std::nullopt, { "u", "v" } });
    writeFlatMesh(this->flat().string(), content);
  }

  void writeVtu(int header) const
  {
    vtkNew<vtkUnstructuredGrid> grid;
    vtkNew<vtkPoints> points;
    vtkNew<vtkDoubleArray> heat;
    heat->SetName("heat");
    for (int i = 0; i < 5; ++i)
    {
      points->InsertNextPoint(i == 1, i == 2, i == 3);
      heat->InsertNextValue(i);
    }
    grid->SetPoints(points);
    grid->GetPointData()->AddArray(heat);
    for (const vtkIdType first : { 0, 1 })
    {
      const vtkIdType ids[] = { first, first + 1, first + 2, first + 3 };
      grid->InsertNextCell(VTK_TETRA, 4, ids);
    }
    vtkNew<vtkXMLUnstructuredGridWriter> writer;
    writer->SetFileName(this->vtu(header).c_str());
    writer->SetInputData(grid);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->SetHeaderType(header);
    writer->Write();
  }

  fs::path Folder;
};

const Seeds& seeds()
{
  static const Seeds made;
  return made;
}

std::string mutated(const fs::path& path, std::mt19937_64& random)
{
  const std::string bytes = contentOf(path);
  // The length of the header: 128 bytes in these .npy files, the XML part in a .vtu file.
  const std::size_t data = bytes.find("encoding=\"raw\"");
  return test::mutate(bytes, data == std::string::npos ? 128 : data + 40, random);
}

void write(const fs::path& path, const std::string& bytes)
{
  std::ofstream(path, std::ios::binary) << bytes;
}

/// A random mesh with one changed file, or a changed .vtu file.
std::string drawMesh(std::mt19937_64& random)
{
  if (random() % 2)
  {
    const fs::path path = seeds().scratch("changed.vtu");
    write(path, mutated(seeds().vtu(random() % 2 ? 32 : 64), random));
    return path.string();
  }
  const char* const files[] = { "cells.npy", "points.npy", "time.npy", "point_data/level.npy",
    "cell_data/pair.npy", "description.json" };
  const char* const changed = files[random() % 6];
  const fs::path folder = seeds().scratch("changed");
  for (const char* const file : files)
  {
    fs::create_directories((folder / file).parent_path());
    const fs::path from = seeds().flat() / file;
    write(folder / file, file == changed ? mutated(from, random) : contentOf(from));
  }
  return folder.string();
}

/// Reads all arrays of the mesh. Throws IOError if they cannot be read.
void readAll(const FlatMesh& mesh, Loader kind)
{
  std::vector<RawArray> arrays = mesh.PointData;
  arrays.push_back(mesh.Points);
  for (const auto& series : mesh.PointSeries)
  {
    arrays.insert(arrays.end(), series.begin(), series.end());
  }
  LoaderOptions options;
  options.Kind = kind;
  options.M = 3;
  const auto loader = makeVertexLoader(arrays, options);
  const CellReader cells(mesh);
  std::vector<std::int64_t> ids;
  for (std::int64_t cell = 0; cell < mesh.Cells.Tuples; ++cell)
  {
    cells.read(cell, 1, ids);
    std::vector<std::vector<char>> values;
    std::vector<void*> out;
    for (const RawArray& array : arrays)
    {
      values.emplace_back(ids.size() * array.tupleBytes());
      out.push_back(values.back().data());
    }
    loader->load(ids.data(), ids.size(), out.data());
  }
}

bool liesInItsFile(const RawArray& array)
{
  return array.Tuples >= 0 && array.Components > 0 &&
    array.Offset + array.bytes() <= fs::file_size(array.Path);
}

bool passes(std::uint64_t seed, std::uint64_t number)
{
  std::seed_seq both{ seed, number };
  std::mt19937_64 random(both);
  const std::string path = drawMesh(random);
  try
  {
    const FlatMesh mesh = openFlatMesh(path);
    bool whole = liesInItsFile(mesh.Cells) && liesInItsFile(mesh.Points);
    for (const RawArray& array : mesh.CellData)
    {
      whole = whole && liesInItsFile(array);
    }
    if (whole)
    {
      const Loader kinds[] = { Loader::Direct, Loader::Fine, Loader::Mmap };
      readAll(mesh, kinds[random() % 3]);
      return true;
    }
    std::printf("an array does not lie in its file: ");
  }
  catch (const IOError&)
  {
    return true;
  }
  catch (const std::exception& error)
  {
    std::printf("%s: ", error.what());
  }
  std::printf("case %llu of seed %llu\n", (unsigned long long)number, (unsigned long long)seed);
  return false;
}

} // namespace

int main(int argc, char** argv)
{
  return test::fuzz("fuzzFlatMesh", argc, argv, passes);
}

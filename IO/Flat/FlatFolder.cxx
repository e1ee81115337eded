// SPDX-License-Identifier: BSD-3-Clause
#include "Flat/FlatFolder.h"

#include "Files/Extension.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Flat/ArrayFileName.h"
#include "Flat/NpyArray.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace tipp
{
namespace
{

namespace fs = std::filesystem;

RawArray rawArray(const NpyArray& file, const std::string& name, std::int64_t tuples,
  std::int64_t components, std::int64_t step = 0)
{
  RawArray array;
  array.Name = name;
  array.Path = file.Path;
  array.Type = file.Type;
  array.Components = int(components);
  array.Tuples = tuples;
  array.Offset = file.Offset + std::uint64_t(step) * array.bytes();
  return array;
}

RawArray openCells(const std::string& folder)
{
  const NpyArray file = openNpyArray(folder + "/cells.npy");
  const bool ids = file.Type == Scalar::Int32 || file.Type == Scalar::Int64;
  if (file.Shape.size() != 2 || (file.Shape[1] != 3 && file.Shape[1] != 4) || !ids)
  {
    throw IOError(file.Path,
      "is " + file.shapeText() + " " + scalarName(file.Type) +
        "; save m x 3 vertex ids (triangles) or m x 4 (tetrahedra) as int32 or int64.");
  }
  return rawArray(file, "cells", file.Shape[0], file.Shape[1]);
}

RawArray openPoints(const std::string& folder)
{
  const NpyArray file = openNpyArray(folder + "/points.npy");
  const bool real = file.Type == Scalar::Float32 || file.Type == Scalar::Float64;
  if (file.Shape.size() != 2 || (file.Shape[1] != 2 && file.Shape[1] != 3) || !real)
  {
    throw IOError(file.Path,
      "is " + file.shapeText() + " " + scalarName(file.Type) +
        "; save n x 2 or n x 3 coordinates as float64 or float32.");
  }
  return rawArray(file, "points", file.Shape[0], file.Shape[1]);
}

std::vector<double> readTimes(const std::string& folder)
{
  const std::string path = folder + "/time.npy";
  if (!fs::exists(path))
  {
    return {};
  }
  const NpyArray file = openNpyArray(path);
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
  const NpyArray file = openNpyArray(path);
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

} // namespace

FlatMesh openFlatFolder(const std::string& path)
{
  if (!isFlatFolder(path))
  {
    throw IOError(path,
      "is a folder without cells.npy and points.npy; 'tipp flatten' makes one of any VTK file.");
  }
  FlatMesh mesh;
  mesh.Path = path;
  mesh.Cells = openCells(path);
  mesh.CellSize = mesh.Cells.Components;
  mesh.Points = openPoints(path);
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
  return mesh;
}

bool isFlatFolder(const std::string& path)
{
  std::error_code failure;
  return fs::is_regular_file(path + "/cells.npy", failure) &&
    fs::is_regular_file(path + "/points.npy", failure);
}

} // namespace tipp

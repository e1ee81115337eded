// SPDX-License-Identifier: BSD-3-Clause
// Prints the checksums of meshes, rasters and files that are the same on every kind of processor.
#include "Dem/MakeDem.h"
#include "Distributions/GeneratePoints.h"
#include "Files/Checksum.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Las/WriteLas.h"
#include "Points/ReadPoints.h"
#include "Triangulation/Triangulate.h"
#include "Triangulation3D/Tetrahedralize.h"

#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace tipp;

constexpr std::int64_t pointCount = 30000;

void print(const std::string& what, const void* data, std::size_t bytes)
{
  std::printf("%s %s\n", checksumText(checksumOf(data, bytes)).c_str(), what.c_str());
}

/// Points with heights that need no function of the C library.
PointTable tableOf(const std::string& distribution)
{
  PointTable table;
  table.XY = generatePoints(*distributionFromName(distribution), pointCount, 7);
  std::vector<double> heights;
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const double x = table.XY[2 * i];
    const double y = table.XY[2 * i + 1];
    heights.push_back((x - 0.3 * y) * (x + y) / (1 + x * x + y * y));
  }
  table.Columns.push_back({ "z", std::move(heights) });
  return table;
}

void printTriangles(const std::string& distribution)
{
  const std::vector<double> xy = tableOf(distribution).XY;
  TriangulationOptions options;
  options.Threads = 2;
  const Triangulation mesh = triangulate(PointsView(xy.data(), xy.size() / 2, 2), options);
  print(
    "triangles of " + distribution, mesh.Ids32.data(), mesh.Ids32.size() * sizeof(std::int32_t));
}

void printTetrahedra(const std::string& distribution)
{
  const PointTable table = tableOf(distribution);
  std::vector<Point3> points;
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    points.push_back({ table.XY[2 * i], table.XY[2 * i + 1], table.Columns[0].Values[i] });
  }
  TetrahedralizationOptions options;
  options.Threads = 2;
  const Tetrahedralization mesh = tetrahedralize(points.data(), points.size(), options);
  print("tetrahedra of " + distribution, mesh.Ids.data(), mesh.Ids.size() * sizeof(std::int32_t));
}

void printRaster(std::uint64_t memory)
{
  DemRequest request;
  request.Raster.Resolution = 0.005;
  request.Bands = { "elevation", "slope", "hillshade" };
  request.Threads = 2;
  TerrainSettings settings;
  BandValues samples;
  makeDem(streamTable(tableOf("uniform"), {}), request, memory, {}, settings, samples);
  for (std::size_t band = 0; band < samples.size(); ++band)
  {
    print("band " + request.Bands[band] + (memory > 0 ? ", out of core" : ""), samples[band].data(),
      samples[band].size() * sizeof(double));
  }
}

void printFile(const std::string& path)
{
  const InputFile file(path);
  std::vector<char> bytes(file.size());
  file.read(0, bytes.data(), bytes.size());
  print("file " + path, bytes.data(), bytes.size());
  removeFile(path);
}

void printLaz(const std::string& path)
{
  LasOptions options;
  options.Software = "printChecksums";
  options.Scale = { 1e-6 };
  options.Threads = 2;
  writeLas(*streamTable(tableOf("uniform"), {}), path, options);
  printFile(path);
}

} // namespace

int main()
{
  try
  {
    for (const std::string& distribution : distributionNames())
    {
      printTriangles(distribution);
    }
    for (const char* const distribution : { "uniform", "clustered", "lattice", "circle" })
    {
      printTetrahedra(distribution);
    }
    printRaster(0);
    printRaster(std::uint64_t(1) << 23);
    printLaz("checksums.las");
    printLaz("checksums.laz");
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "RealData.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace tipp
{
namespace test
{
namespace
{

/// The output of `program` (xz or gzip) for a compressed file.
std::string decompressed(const std::string& program, const std::string& path)
{
  const std::string command = program + " --decompress --stdout '" + path + "'";
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  char part[1 << 16];
  for (std::size_t n; pipe && (n = std::fread(part, 1, sizeof(part), pipe)) > 0;)
  {
    text.append(part, n);
  }
  if (!pipe || pclose(pipe) != 0)
  {
    throw std::runtime_error(path + ": " + program + " could not decompress it; is it installed?");
  }
  return text;
}

} // namespace

std::string realData(const std::string& name)
{
  const std::string path = std::string(TIPP_SHARED_DATA) + "/" + name;
  return std::ifstream(path) ? path : std::string();
}

AdcircMesh readAdcirc(const std::string& path)
{
  std::ifstream file(path);
  std::string title;
  std::size_t elements = 0;
  std::size_t nodes = 0;
  std::getline(file, title);
  file >> elements >> nodes;
  AdcircMesh mesh;
  std::int64_t id = 0;
  double depth = 0;
  for (std::size_t i = 0; file && i < nodes; ++i)
  {
    double x = 0;
    double y = 0;
    file >> id >> x >> y >> depth;
    mesh.Nodes.insert(mesh.Nodes.end(), { x, y });
  }
  for (std::size_t i = 0; file && i < elements; ++i)
  {
    int corners = 0;
    std::int64_t a = 0;
    std::int64_t b = 0;
    std::int64_t c = 0;
    file >> id >> corners >> a >> b >> c;
    mesh.Elements.push_back(canonical(a - 1, b - 1, c - 1));
  }
  if (!file)
  {
    throw std::runtime_error(path + ": not a whole mesh in ADCIRC's format");
  }
  return mesh;
}

TetrahedralMesh readDolfin(const std::string& path)
{
  std::istringstream text(decompressed("gzip", path));
  TetrahedralMesh mesh;
  double p[3];
  std::int64_t v[4];
  for (std::string line; std::getline(text, line);)
  {
    if (std::sscanf(line.c_str(), " <vertex index=\"%*d\" x=\"%lf\" y=\"%lf\" z=\"%lf\"", p, p + 1,
          p + 2) == 3)
    {
      mesh.Points.insert(mesh.Points.end(), p, p + 3);
    }
    else if (std::sscanf(line.c_str(),
               " <tetrahedron index=\"%*d\" v0=\"%" SCNd64 "\" v1=\"%" SCNd64 "\" v2=\"%" SCNd64
               "\" v3=\"%" SCNd64 "\"",
               v, v + 1, v + 2, v + 3) == 4)
    {
      mesh.Cells.insert(mesh.Cells.end(), v, v + 4);
    }
  }
  const auto isNoPoint = [&](std::int64_t id)
  { return id < 0 || 3 * std::size_t(id) >= mesh.Points.size(); };
  if (mesh.Cells.empty() || std::any_of(mesh.Cells.begin(), mesh.Cells.end(), isNoPoint))
  {
    throw std::runtime_error(path + ": not a whole mesh of tetrahedra in dolfin's format");
  }
  return mesh;
}

Coordinates readCompressedTable(
  const std::string& path, char separator, bool header, std::size_t x, std::size_t y)
{
  std::istringstream text(decompressed("xz", path));
  std::string line;
  if (header)
  {
    std::getline(text, line);
  }
  Coordinates xy;
  while (std::getline(text, line))
  {
    double found[2] = {};
    std::size_t column = 0;
    for (std::size_t at = 0; at < line.size(); ++column)
    {
      const std::size_t end = std::min(line.find(separator, at), line.size());
      if (column == x || column == y)
      {
        found[column == y] = std::strtod(line.c_str() + at, nullptr);
      }
      at = end + 1;
    }
    if (column <= std::max(x, y))
    {
      throw std::runtime_error(path + ": a line has too few columns: " + line);
    }
    xy.insert(xy.end(), found, found + 2);
  }
  return xy;
}

} // namespace test
} // namespace tipp

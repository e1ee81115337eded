// SPDX-License-Identifier: BSD-3-Clause
#include "RealData.h"

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

std::string decompressed(const std::string& path)
{
  const std::string command = "xz --decompress --stdout '" + path + "'";
  FILE* pipe = popen(command.c_str(), "r");
  std::string text;
  char part[1 << 16];
  for (std::size_t n; pipe && (n = std::fread(part, 1, sizeof(part), pipe)) > 0;)
  {
    text.append(part, n);
  }
  if (!pipe || pclose(pipe) != 0)
  {
    throw std::runtime_error(path + ": xz could not decompress it; is xz-utils installed?");
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

Coordinates readCompressedTable(
  const std::string& path, char separator, bool header, std::size_t x, std::size_t y)
{
  std::istringstream text(decompressed(path));
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

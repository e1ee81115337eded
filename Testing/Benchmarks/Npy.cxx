// SPDX-License-Identifier: BSD-3-Clause
#include "Npy.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <regex>
#include <stdexcept>

namespace tipp
{
namespace benchmark
{

std::vector<double> readNpy(const std::string& path)
{
  const auto fail = [&](const std::string& why) -> std::runtime_error
  { return std::runtime_error(path + ": " + why + "; expected an n x 2 float64 .npy"); };
  std::ifstream file(path, std::ios::binary);
  char magic[10] = {};
  if (!file.read(magic, 10) || std::string(magic, 6) != "\x93NUMPY" || magic[6] != 1)
  {
    throw fail("not a version 1 .npy file");
  }
  std::string header(std::uint8_t(magic[8]) + 256u * std::uint8_t(magic[9]), ' ');
  file.read(&header[0], std::streamsize(header.size()));
  std::smatch shape;
  if (!file || header.find("'<f8'") == std::string::npos ||
      header.find("'fortran_order': False") == std::string::npos ||
      !std::regex_search(header, shape, std::regex("\\(([0-9]{1,15}), ([0-9]{1,6})\\)")))
  {
    throw fail("unexpected header");
  }
  const std::size_t rows = std::stoull(shape[1]);
  const std::size_t columns = std::stoull(shape[2]);
  const auto start = file.tellg();
  file.seekg(0, std::ios::end);
  if (columns < 2 || std::size_t(file.tellg() - start) != rows * columns * sizeof(double))
  {
    throw fail("the size of the file is not that of its array");
  }
  file.seekg(start);
  std::vector<double> xy(2 * rows);
  std::vector<double> row(columns);
  for (std::size_t i = 0; i < rows; ++i)
  {
    file.read(reinterpret_cast<char*>(row.data()), std::streamsize(columns * sizeof(double)));
    std::copy_n(row.begin(), 2, xy.begin() + std::ptrdiff_t(2 * i));
  }
  return xy;
}

} // namespace benchmark
} // namespace tipp

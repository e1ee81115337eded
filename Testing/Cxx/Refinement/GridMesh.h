// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGridMesh_h
#define tippGridMesh_h

#include "Meshes/MeshOptions.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace tipp
{
namespace test
{

/// Squares of side 1, each cut into two triangles. Node column + row * (columns + 1) is at (column,
/// row).
struct GridMesh
{
  /// `hasSquare(column, row)` chooses the squares.
  GridMesh(int columns, int rows, const std::function<bool(int, int)>& hasSquare)
  {
    for (int row = 0; row <= rows; ++row)
    {
      for (int column = 0; column <= columns; ++column)
      {
        this->XY.insert(this->XY.end(), { double(column), double(row) });
      }
    }
    for (int row = 0; row < rows; ++row)
    {
      for (int column = 0; column < columns; ++column)
      {
        const std::int64_t a = std::int64_t(row) * (columns + 1) + column;
        const std::int64_t above = a + columns + 1;
        if (hasSquare(column, row))
        {
          this->Triangles.insert(
            this->Triangles.end(), { a, a + 1, above + 1, a, above + 1, above });
        }
      }
    }
  }
  GridMesh(int columns, int rows)
    : GridMesh(columns, rows, [](int, int) { return true; })
  {
  }

  TrianglesView view() const { return { this->Triangles.data(), this->Triangles.size() / 3 }; }
  std::size_t nodes() const { return this->XY.size() / 2; }

  std::vector<double> XY;
  std::vector<std::int64_t> Triangles;
};

} // namespace test
} // namespace tipp

#endif

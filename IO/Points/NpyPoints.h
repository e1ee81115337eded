// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNpyPoints_h
#define tippNpyPoints_h

#include "Npy/NpyFile.h"
#include "Points/ColumnChoice.h"
#include "Points/ReadPoints.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// The points of an n x 2 or n x 3 array of float64 or float32, from the first on. Throws IOError.
class NpyPointRows
{
public:
  NpyPointRows(const std::string& path, const PointOptions& options);

  std::int64_t rows() const { return this->Reader.rows(); }
  void skip(std::int64_t rows) { this->Reader.skipRows(rows); }

  /// The name of the column that is neither x nor y, if there are three.
  const std::vector<std::string>& further() const { return this->Further; }

  /// The next rows: x and y in turn, and the further column, null if there is none.
  void read(std::size_t count, double* xy, double* further);

private:
  template <typename Scalar>
  void readRows(std::size_t count, double* xy, double* further);

  NpyReader Reader;
  std::size_t Width;
  ColumnChoice Choice;
  std::vector<std::string> Further;
};

/// Points from an .npy table of two or three columns, named x, y and z.
/// Of its rows, the share that is the part's of so many parts.
PointTable readNpyPoints(
  const std::string& path, const PointOptions& options, int part = 0, int parts = 1);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteLas_h
#define tippWriteLas_h

#include "Files/PendingOutput.h"
#include "Las/LasTransform.h"
#include "Points/ReadPoints.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

struct LasOptions
{
  std::string Software; ///< the program, for the header
  /// The scales of x, y and z, or one for all; empty: those of LAS inputs if they agree, the finest
  /// of each axis if not, and for other inputs the decimals that the coordinates have. Coordinates
  /// are rounded to multiples of scales that are given.
  std::vector<double> Scale = {};
  int Threads = 0; ///< 0: defaultThreads()
  /// The state of the output's path when the run began: see PendingFile.
  std::optional<PathState> Before = {};
};

/// What was written, and what was not.
struct LasReport
{
  std::int64_t Points = 0;
  std::int64_t NotFinite = 0; ///< points without a number as x, y or z, which are left out
  int Format = 6;             ///< the format of the points
  LasTransform Transform;
  std::vector<std::string> Warnings; ///< sentences
  std::int64_t LeftOut = 0;          ///< as PointTable::LeftOut
  std::int64_t ThinnedOut = 0;
  ReadFigures Read;
  std::vector<TableReport> Tables;
};

/// Writes points to a LAS file of version 1.4, or a LAZ file if the name ends so. Their format is
/// 6, 7 (with colour) or 8 (with infrared, too) as the points have them.
///
/// The columns z (or elevation), intensity, classification, gps_time, red, green, blue and nir
/// become the fields of these names if all of their values fit; other columns become extra bytes of
/// float64. Without heights z is 0. Makes two passes. Throws IOError, also if there are no points.
VTKTIPPIO_EXPORT LasReport writeLas(
  PointStream& points, const std::string& output, const LasOptions& options);

/// Reads files of points, and writes them in the same way. If all are LAS files, all of their
/// fields and the extra bytes that all have are written as they are; if only some are, a warning
/// says what is lost. Throws IOError.
VTKTIPPIO_EXPORT LasReport copyToLas(const std::vector<std::string>& inputs,
  const PointOptions& reading, const std::string& output, const LasOptions& options);

} // namespace tipp

#endif

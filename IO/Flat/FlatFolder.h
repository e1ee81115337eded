// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFlatFolder_h
#define tippFlatFolder_h

#include "Flat/FlatMesh.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Returns the file name, without extension, for an array: slashes, control characters, per cent
/// signs and a leading dot become % and two hexadecimal digits.
VTKTIPPIO_EXPORT std::string arrayFileName(const std::string& name);

/// The inverse of arrayFileName(). A % that two hexadecimal digits do not follow is kept.
VTKTIPPIO_EXPORT std::string arrayNameOf(const std::string& fileName);

/// An array in memory to be written: Tuples x Components values, or Steps times as many if it
/// varies in time.
struct FlatArray
{
  std::string Name;
  Scalar Type = Scalar::Float64;
  int Components = 1;
  std::int64_t Tuples = 0;
  std::int64_t Steps = 0; ///< 0: the array does not vary in time
  const void* Values = nullptr;
  std::shared_ptr<const void> Owner; ///< owns Values, or null if the caller does
};

struct FlatContent
{
  int CellSize = 3;
  std::vector<std::int64_t> Cells;
  FlatArray Points;
  std::vector<FlatArray> PointData;
  std::vector<FlatArray> CellData;
  std::vector<double> Times;
};

/// Writes a folder that openFlatMesh can open; point indices as int32 if they fit. The folder is
/// published only when it is complete. Returns false if `aborted`, called between arrays, returned
/// true; throws IOError.
VTKTIPPIO_EXPORT bool writeFlatMesh(
  const std::string& path, const FlatContent& content, const std::function<bool()>& aborted = {});

} // namespace tipp

#endif

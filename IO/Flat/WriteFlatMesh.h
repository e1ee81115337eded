// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteFlatMesh_h
#define tippWriteFlatMesh_h

#include "Flat/RawArray.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// An array in memory, to be written: tuples of some components, or of a step each.
struct FlatArray
{
  std::string Name;
  Scalar Type = Scalar::Float64;
  int Components = 1;
  std::int64_t Tuples = 0;
  std::int64_t Steps = 0; ///< 0: it does not vary in time
  const void* Values = nullptr;
  std::shared_ptr<const void> Owner; ///< keeps Values alive, where it must
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

/// Writes the folder that openFlatMesh opens; ids as int32 where they fit. The folder appears whole
/// or not at all: false if `aborted`, asked between arrays, said so; throws IOError.
VTKTIPPIO_EXPORT bool writeFlatMesh(
  const std::string& path, const FlatContent& content, const std::function<bool()>& aborted = {});

} // namespace tipp

#endif

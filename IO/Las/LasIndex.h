// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasIndex_h
#define tippLasIndex_h

#include "Las/LasHeader.h"
#include "Predicates/Geometry.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// Records [Begin, End) of a file.
struct RecordRange
{
  std::uint64_t Begin;
  std::uint64_t End;
};

/// What the LASindex of a LAS or LAZ file says.
struct IndexedRecords
{
  /// The records that may lie in the box, ascending and apart; nullopt: there is no usable index.
  std::optional<std::vector<RecordRange>> Ranges;
  std::string Remark; ///< why the index is not used, or empty
};

/// Looks a box up in the LASindex of a file: the file of the same name with .lax, else the one
/// among the file's records (LAStools' format: a quadtree, and for each cell ranges of records). An
/// index that is older than the file or does not have exactly its records is not used; another one
/// is believed.
VTKTIPPIO_EXPORT IndexedRecords findIndexedRecords(
  const std::string& path, const LasHeader& header, const Box2& box);

} // namespace tipp

#endif

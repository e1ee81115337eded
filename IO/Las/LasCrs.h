// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasCrs_h
#define tippLasCrs_h

#include <cstdint>
#include <string>

namespace tipp
{

class InputFile;

/// Where a LAS file's variable length records lie.
struct LasRecordPlaces
{
  std::uint64_t Begin = 0;
  std::uint64_t End = 0;
  std::uint32_t Count = 0;
  std::uint64_t ExtendedBegin = 0;
  std::uint32_t ExtendedCount = 0;
};

struct LasCrs
{
  std::string Text;       ///< WKT, "EPSG:code" or "EPSG:code+code"; may be empty
  bool IsUnknown = false; ///< there is one, but neither WKT nor EPSG codes
};

/// The coordinate reference system that the records tell. What is damaged in them counts as absent,
/// since the points can be read without.
LasCrs readLasCrs(const InputFile& file, const LasRecordPlaces& places);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLasRecords_h
#define tippLasRecords_h

#include "Las/LasHeader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace tipp
{

/// The point records of a LAS file as its specification lays them out.
class LasRecords
{
public:
  virtual ~LasRecords() = default;
  /// Records from `first` on, which are there. Throws IOError.
  virtual void read(std::int64_t first, std::size_t count, char* records) = 0;
};

/// Throws IOError; for LAZ, too, where LASzip was not there to build with.
std::unique_ptr<LasRecords> openLasRecords(const std::string& path, const LasHeader& header);

/// Of a LAZ file, which LASzip decompresses.
std::unique_ptr<LasRecords> openLazRecords(const std::string& path, const LasHeader& header);

} // namespace tipp

#endif

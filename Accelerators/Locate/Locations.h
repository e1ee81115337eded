// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLocations_h
#define tippLocations_h

#include "Locate/CellLocator.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace tipp
{

/// Buffers locations and passes them to a TakeLocations in batches.
class Locations
{
public:
  explicit Locations(const TakeLocations& take)
    : Take(take)
  {
  }

  void add(std::int64_t point, const CellLocation& at)
  {
    this->Points[std::size_t(this->Count)] = point;
    this->At[std::size_t(this->Count)] = at;
    ++this->Count == Most ? this->flush() : void();
  }
  void flush()
  {
    this->Count > 0 ? this->Take(this->Points.data(), this->At.data(), this->Count) : void();
    this->Count = 0;
  }

private:
  static constexpr std::int64_t Most = 128;
  const TakeLocations& Take;
  std::int64_t Count = 0;
  std::array<std::int64_t, Most> Points;
  std::array<CellLocation, Most> At;
};

} // namespace tipp

#endif

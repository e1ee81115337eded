// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLocations_h
#define tippLocations_h

#include "Predicates/Geometry.h"
#include "Resample/SimplexMesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace tipp
{

/// Points to locate: points[asked[i]] for all i < count, or points[i] if `asked` is null.
struct AskedPoints
{
  const Point3* Points = nullptr;
  const std::int64_t* Asked = nullptr;
  std::int64_t Count = 0; ///< number of points to locate

  std::int64_t index(std::int64_t i) const { return this->Asked ? this->Asked[i] : i; }
  const Point3& at(std::int64_t i) const { return this->Points[this->index(i)]; }
};

/// Receives some of the locations: `count` indices into the array of all points, and the points'
/// locations. The arrays are valid during the call only.
using TakeLocations =
  std::function<void(const std::int64_t* points, const CellLocation* at, std::int64_t count)>;

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
    if (++this->Count == Most)
    {
      this->flush();
    }
  }
  void flush()
  {
    if (this->Count > 0)
    {
      this->Take(this->Points.data(), this->At.data(), this->Count);
    }
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

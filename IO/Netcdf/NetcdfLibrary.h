// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfLibrary_h
#define tippNetcdfLibrary_h

#include "Netcdf/NetcdfContent.h"

#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// A part of a variable: from an index on, a number of values along each dimension.
struct NetcdfPart
{
  int Variable = 0;
  std::vector<std::int64_t> Start;
  std::vector<std::int64_t> Count;

  bool operator==(const NetcdfPart& other) const
  {
    return this->Variable == other.Variable && this->Start == other.Start &&
      this->Count == other.Count;
  }
};

template <typename Archive>
void serialize(Archive& archive, NetcdfPart& part)
{
  archive(part.Variable, part.Start, part.Count);
}

/// A file opened by the NetCDF library. Damaged files crash or hang it, so it is used in a
/// HelperProcess. All functions throw std::runtime_error with what the library reports.
class NetcdfLibrary
{
public:
  NetcdfLibrary() = default;
  ~NetcdfLibrary();
  NetcdfLibrary(const NetcdfLibrary&) = delete;
  NetcdfLibrary& operator=(const NetcdfLibrary&) = delete;

  NetcdfContent open(const std::string& path);
  /// Reads values in their own type.
  void read(const NetcdfPart& part, void* to);

private:
  NetcdfVariable describe(int id) const;
  std::vector<NetcdfAttribute> attributesOf(int variable, int count) const;
  NetcdfAttribute attributeOf(int variable, int index) const;
  void enlargeCache(const NetcdfPart& part);

  int File = -1;
  std::vector<std::size_t> CacheBytes; ///< of each variable, as far as it was enlarged
};

} // namespace tipp

#endif

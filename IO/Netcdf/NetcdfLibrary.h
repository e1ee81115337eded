// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNetcdfLibrary_h
#define tippNetcdfLibrary_h

#include "Netcdf/NetcdfContent.h"

#include <cstddef>
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

  /// `group` as for NetcdfFile.
  NetcdfContent open(const std::string& path, const std::string& group);
  /// Reads values in their own type.
  void read(const NetcdfPart& part, void* to);

private:
  /// A variable, by its group's number and its own.
  struct Variable
  {
    int Group;
    int Id;
  };

  void addGroup(int group, const std::string& prefix, bool withGroups, NetcdfContent& content);
  static void addDimensions(int group, NetcdfContent& content);
  static NetcdfVariable describe(const Variable& variable);
  static std::vector<NetcdfAttribute> attributesOf(const Variable& variable, int count);
  static NetcdfAttribute attributeOf(const Variable& variable, int index);
  void enlargeCache(const NetcdfPart& part);

  int File = -1;
  std::vector<Variable> Variables;     ///< by NetcdfVariable::Id
  std::vector<std::size_t> CacheBytes; ///< of each variable, as far as it was enlarged
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Replaces Netcdf/NetcdfLibrary.cxx in a build without the NetCDF library.
#include "Netcdf/NetcdfHook.h"

#include <stdexcept>

namespace tipp
{

NetcdfHook& netcdfHook()
{
  static NetcdfHook hook;
  return hook;
}

NetcdfLibrary::~NetcdfLibrary() = default;

NetcdfContent NetcdfLibrary::open(const std::string& path, const std::string& group)
{
  if (!group.empty())
  {
    throw std::runtime_error("groups are not read in this build");
  }
  NetcdfContent content = netcdfHook().open(path);
  this->Variables.clear();
  for (NetcdfVariable& variable : content.Variables)
  {
    variable.Id = int(this->Variables.size());
    this->Variables.push_back({ 0, variable.Id });
  }
  return content;
}

void NetcdfLibrary::read(const NetcdfPart& part, void* to)
{
  if (part.Variable < 0 || std::size_t(part.Variable) >= this->Variables.size())
  {
    throw std::runtime_error("there is no such variable");
  }
  netcdfHook().read(part, to);
}

} // namespace tipp

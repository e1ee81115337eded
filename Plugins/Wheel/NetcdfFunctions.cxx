// SPDX-License-Identifier: BSD-3-Clause
// NetCDF files, read by Python's packages for them.
#include "Binding.h"

#include "Netcdf/NetcdfHook.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace tipp::python
{
namespace
{

using Attributes = std::vector<std::tuple<std::string, std::string, std::vector<double>, bool>>;
/// Name, type as the code of a number or "S" for text, numbers of dimensions, attributes.
using Variable = std::tuple<std::string, std::string, std::vector<int>, Attributes>;
using Dimensions = std::vector<std::tuple<std::string, std::int64_t>>;

/// Calls work(module) with the Python module that reads the files, and throws its errors as
/// std::runtime_error.
template <typename Work>
auto withModule(const Work& work)
{
  const nb::gil_scoped_acquire lock;
  try
  {
    return work(nb::module_::import_("tipp._netcdf"));
  }
  catch (const nb::python_error& error)
  {
    throw std::runtime_error(nb::cast<std::string>(nb::str(error.value())));
  }
}

std::vector<NetcdfAttribute> attributesOf(const Attributes& given)
{
  std::vector<NetcdfAttribute> attributes;
  for (const auto& [name, text, numbers, isFloat] : given)
  {
    attributes.push_back({ name, text, numbers, isFloat });
  }
  return attributes;
}

NetcdfContent openFile(const std::string& path)
{
  return withModule(
    [&path](const nb::module_& module)
    {
      using Description = std::tuple<Dimensions, std::vector<Variable>, Attributes>;
      const auto [dimensions, variables, attributes] =
        nb::cast<Description>(module.attr("open_file")(nb::bytes(path.data(), path.size())));
      NetcdfContent content;
      for (const auto& [name, size] : dimensions)
      {
        content.Dimensions.push_back({ name, size });
      }
      for (const auto& [name, type, axes, ofVariable] : variables)
      {
        NetcdfVariable variable;
        variable.Name = name;
        variable.Type = scalarFromName(type);
        variable.IsText = type == "S";
        variable.Dimensions = axes;
        variable.Attributes = attributesOf(ofVariable);
        content.Variables.push_back(std::move(variable));
      }
      content.Attributes = attributesOf(attributes);
      return content;
    });
}

void readPart(const NetcdfPart& part, void* to)
{
  withModule(
    [&](const nb::module_& module)
    {
      const auto bytes =
        nb::cast<nb::bytes>(module.attr("read_part")(part.Variable, part.Start, part.Count));
      // The caller's memory has the size that the description gave.
      std::memcpy(to, bytes.c_str(), bytes.size());
    });
}

std::string missingPackage()
{
  return withModule([](const nb::module_& module)
    { return nb::cast<std::string>(module.attr("missing_package")()); });
}

} // namespace

void addNetcdfFunctions()
{
  netcdfHook() = { missingPackage, openFile, readPart };
}

} // namespace tipp::python

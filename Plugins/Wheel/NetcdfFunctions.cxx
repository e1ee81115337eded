// SPDX-License-Identifier: BSD-3-Clause
// NetCDF files, read and written by Python's packages for them.
#include "Binding.h"

#include "Files/RawArray.h"
#include "Netcdf/NetcdfHook.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace tipp::python
{
namespace
{

using Attributes = std::vector<std::tuple<std::string, std::string, std::vector<double>, bool>>;
/// Name, type as the code of a number or "S" for text, numbers of dimensions, attributes.
using Variable = std::tuple<std::string, std::string, std::vector<int>, Attributes>;
using Dimensions = std::vector<std::tuple<std::string, std::int64_t>>;

/// Calls work(), which uses Python, and throws its errors as std::runtime_error.
template <typename Work>
auto withPython(const Work& work)
{
  const nb::gil_scoped_acquire lock;
  try
  {
    return work();
  }
  catch (const nb::python_error& error)
  {
    throw std::runtime_error(nb::cast<std::string>(nb::str(error.value())));
  }
}

/// The same with the Python module that reads the files.
template <typename Work>
auto withModule(const Work& work)
{
  return withPython([&work] { return work(nb::module_::import_("tipp._netcdf")); });
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

std::string missingPackage(bool isToWrite)
{
  return withModule([isToWrite](const nb::module_& module)
    { return nb::cast<std::string>(module.attr("missing_package")(isToWrite)); });
}

nb::bytes bytesOf(const std::string& text)
{
  return nb::bytes(text.data(), text.size());
}

nb::list listOf(const std::vector<NetcdfAttribute>& attributes)
{
  nb::list list;
  for (const NetcdfAttribute& attribute : attributes)
  {
    list.append(nb::make_tuple(attribute.Name, bytesOf(attribute.Text), attribute.Numbers));
  }
  return list;
}

/// A variable for tipp._netcdf_output: name, type, numbers of its dimensions, attributes, chunk,
/// and whether missing values have the usual fill value, NaN or none.
nb::tuple definitionOf(const NetcdfVariable& variable, const NetcdfStorage& storage)
{
  using Fill = NetcdfStorage::Fill;
  const char* const missing = storage.Missing == Fill::NaN ? "nan"
    : storage.Missing == Fill::None                        ? "none"
                                                           : "usual";
  return nb::make_tuple(bytesOf(variable.Name), scalarName(*variable.Type), variable.Dimensions,
    listOf(variable.Attributes), storage.Chunk, missing);
}

nb::module_ outputModule()
{
  return nb::module_::import_("tipp._netcdf_output");
}

/// A file that tipp._netcdf_output writes.
class PythonSink : public NetcdfSink
{
public:
  explicit PythonSink(nb::object file)
    : File(std::move(file))
  {
  }
  ~PythonSink() override
  {
    const nb::gil_scoped_acquire lock;
    this->File.reset();
  }

  void write(const NetcdfPart& part, const void* values, std::size_t bytes) override
  {
    withPython(
      [&]
      {
        // The memory is only read, and only during the call.
        auto* const memory = static_cast<char*>(const_cast<void*>(values));
        const auto view = nb::steal(PyMemoryView_FromMemory(memory, Py_ssize_t(bytes), PyBUF_READ));
        outputModule().attr("write_part")(this->File, part.Variable, part.Start, part.Count, view);
      });
  }

  void close() override
  {
    withPython([this] { outputModule().attr("close_file")(this->File); });
  }

private:
  nb::object File;
};

std::unique_ptr<NetcdfSink> createFile(
  const std::string& path, const NetcdfDefinitions& definitions)
{
  return withPython(
    [&]() -> std::unique_ptr<NetcdfSink>
    {
      nb::list dimensions;
      for (const NetcdfDimension& dimension : definitions.Content.Dimensions)
      {
        dimensions.append(nb::make_tuple(dimension.Name, dimension.Size));
      }
      nb::list variables;
      for (const NetcdfVariable& variable : definitions.Content.Variables)
      {
        variables.append(definitionOf(variable, definitions.Storage[std::size_t(variable.Id)]));
      }
      return std::make_unique<PythonSink>(outputModule().attr("create_file")(bytesOf(path),
        definitions.IsClassic, dimensions, variables, listOf(definitions.Content.Attributes)));
    });
}

} // namespace

void addNetcdfFunctions()
{
  netcdfHook() = { missingPackage, openFile, readPart, createFile };
}

} // namespace tipp::python

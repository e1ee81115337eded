// SPDX-License-Identifier: BSD-3-Clause
#include "Binding.h"

#include "Commands/RunTool.h"
#include "Crs/WriteGeoKeys.h"
#include "Files/IOError.h"

#include <nanobind/stl/string.h>

#include <cstdio>
#include <string>
#include <vector>

namespace tipp::python
{
namespace
{

/// Runs the command line tool and returns its exit code. `words`: the arguments as bytes, because
/// names of files need not be text. Call it once in a process, on the main thread: it changes the
/// handlers of signals.
int runWords(const nb::list& words)
{
  std::vector<std::string> texts = { "tipp" };
  for (const auto& word : words)
  {
    const auto bytes = nb::cast<nb::bytes>(word);
    texts.emplace_back(bytes.c_str(), bytes.size());
  }
  std::vector<char*> pointers;
  for (std::string& text : texts)
  {
    pointers.push_back(text.data());
  }
  pointers.push_back(nullptr);
  const int code = withoutLock([&] { return runTool(int(texts.size()), pointers.data()); });
  std::fflush(nullptr); // the process may end without it
  return code;
}

/// Translates a reference system by a function of tipp._crs, as CrsTranslator.
std::string translateCrs(const char* function, const std::string& crs)
{
  const nb::gil_scoped_acquire lock;
  try
  {
    const nb::bytes text(crs.data(), crs.size());
    const auto result = nb::cast<nb::bytes>(nb::module_::import_("tipp._crs").attr(function)(text));
    return { result.c_str(), result.size() };
  }
  catch (const nb::python_error& error)
  {
    throw IOError(nb::cast<std::string>(nb::str(error.value())));
  }
}

} // namespace

void addToolFunctions(nb::module_& module)
{
  crsTranslator() = { [](const std::string& crs) { return translateCrs("translate", crs); },
    [](const std::string& crs) { return translateCrs("to_wkt1", crs); } };
  module.def("run_tool", &runWords);
}

} // namespace tipp::python

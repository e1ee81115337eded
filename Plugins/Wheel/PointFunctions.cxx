// SPDX-License-Identifier: BSD-3-Clause
#include "Arrays.h"
#include "Functions.h"
#include "Reporter.h"

#include "Points/PointStream.h"
#include "Points/ReadPoints.h"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstring>
#include <optional>

namespace tipp::python
{
namespace
{

using Strings = std::vector<std::string>;

nb::object copyOf(const std::vector<double>& values, std::size_t columns)
{
  RawBuffer buffer(values.size() * sizeof(double));
  if (!values.empty())
  {
    std::memcpy(buffer.data(), values.data(), buffer.size());
  }
  return arrayOf(std::move(buffer), Scalar::Float64, columns);
}

/// Returns (n, 2) coordinates, the columns by name, and the reference system or an empty text.
nb::tuple readPointFiles(const Strings& paths, const std::optional<Strings>& columns,
  const std::vector<int>& classes, int returns, const Strings& keep)
{
  const auto isKept = [&keep](const char* flag)
  { return std::find(keep.begin(), keep.end(), flag) != keep.end(); };
  PointOptions options;
  options.Columns = columns;
  options.Las.Classes = classes;
  options.Las.Kind = LasSelection::Returns(returns);
  options.Las.KeepWithheld = isKept("withheld");
  options.Las.KeepSynthetic = isKept("synthetic");
  options.Las.KeepOverlap = isKept("overlap");
  std::string crs;
  const PointTable table = withoutLock(
    [&]
    {
      crs = openPointStream(paths, options)->crs();
      return readPoints(paths, options);
    });
  nb::dict named;
  for (const PointTable::Column& column : table.Columns)
  {
    named[column.Name.c_str()] = copyOf(column.Values, 1);
  }
  return nb::make_tuple(copyOf(table.XY, 2), named, crs);
}

} // namespace

void addPointFunctions(nb::module_& module)
{
  module.def("read_points", &readPointFiles, nb::arg("paths"), nb::arg("columns").none(),
    nb::arg("classes"), nb::arg("returns"), nb::arg("keep"));
}

} // namespace tipp::python

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPythonBinding_h
#define tippPythonBinding_h

#include "Arrays/Buffer.h"
#include "Arrays/Scalar.h"
#include "Parallel/Stopwatch.h"
#include "Points/ReadPoints.h"
#include "Resample/SimplexMesh.h"
#include "Series/MeshSeries.h"
#include "Triangulation/PointsView.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tipp
{
struct RunStatistics;
}

namespace tipp::python
{

namespace nb = nanobind;

/// Returns an entry of the options. Throws TypeError if it is not of this type.
template <typename Value>
Value of(const nb::dict& options, const char* name)
{
  Value value{};
  if (!nb::try_cast(options[name], value))
  {
    throw nb::type_error(
      (std::string(name) + " has a value of a wrong type, or one that is too large.").c_str());
  }
  return value;
}

/// How the output of a model is read.
inline SeriesOptions seriesOptions(const nb::dict& options)
{
  return { of<std::vector<std::string>>(options, "values"), of<bool>(options, "wrap") };
}

/// A NumPy array of any type, to read only. The Python side makes sure that it is in C order.
using InputArray = nb::ndarray<nb::ro, nb::device::cpu, nb::c_contig>;

inline Scalar scalarOf(nb::dlpack::dtype type)
{
  using Code = nb::dlpack::dtype_code;
  const bool isReal = type.code == std::uint8_t(Code::Float);
  const bool isSigned = type.code == std::uint8_t(Code::Int);
  switch (type.bits)
  {
    case 8:
      return isSigned ? Scalar::Int8 : Scalar::UInt8;
    case 16:
      return isSigned ? Scalar::Int16 : Scalar::UInt16;
    case 32:
      return isReal ? Scalar::Float32 : isSigned ? Scalar::Int32 : Scalar::UInt32;
    default:
      return isReal ? Scalar::Float64 : isSigned ? Scalar::Int64 : Scalar::UInt64;
  }
}

/// Returns a view of points of shape (n, 2) or (n, 3), float32 or float64, without a copy.
inline PointsView viewOf(const InputArray& points)
{
  const std::size_t count = points.shape(0);
  const std::size_t stride = points.shape(1);
  return scalarOf(points.dtype()) == Scalar::Float32
    ? PointsView(static_cast<const float*>(points.data()), count, stride)
    : PointsView(static_cast<const double*>(points.data()), count, stride);
}

/// The number of values in each row of an array.
inline std::size_t componentsOf(const InputArray& array)
{
  return array.ndim() > 1 ? array.shape(1) : 1;
}

/// An array of a mesh, and its name.
using NamedArray = std::pair<std::string, InputArray>;

/// Returns the arrays of a dictionary. Throws std::runtime_error if one has fewer rows than there
/// are points or cells (`of`).
std::vector<NamedArray> namedArrays(
  const nb::dict& arrays, const InputArray& due, const std::string& of);

/// Describes a mesh of triangles or tetrahedra, without a copy.
inline SimplexMesh meshOf(const InputArray& points, const InputArray& cells)
{
  SimplexMesh mesh;
  mesh.Points = points.data();
  mesh.Float = scalarOf(points.dtype()) == Scalar::Float32;
  mesh.PointCount = std::int64_t(points.shape(0));
  mesh.Ids = cells.data();
  mesh.Wide = scalarOf(cells.dtype()) == Scalar::Int64;
  mesh.Cells = std::int64_t(cells.shape(0));
  mesh.Dimension = int(cells.shape(1)) - 1;
  return mesh;
}

/// Returns a NumPy array of this shape that takes over the memory of the buffer.
template <typename Value>
nb::object arrayOf(Buffer<Value>&& buffer, const std::vector<std::size_t>& shape)
{
  Value* const memory = buffer.release();
  const nb::capsule owner(memory, [](void* p) noexcept { std::free(p); });
  return nb::cast(nb::ndarray<nb::numpy, Value>(memory, shape.size(), shape.data(), owner));
}

/// The same for rows of `columns` values; for one column, an array of one dimension.
template <typename Value>
nb::object arrayOf(Buffer<Value>&& buffer, std::size_t columns = 1)
{
  const std::size_t rows = buffer.size() / columns;
  return arrayOf(std::move(buffer),
    columns == 1 ? std::vector<std::size_t>{ rows } : std::vector<std::size_t>{ rows, columns });
}

/// The same for a buffer of bytes that holds values of this type.
inline nb::object arrayOf(Buffer<char>&& bytes, Scalar type, std::size_t columns = 1)
{
  nb::object result;
  withScalar(type,
    [&](auto value) { result = arrayOf(Buffer<decltype(value)>(std::move(bytes)), columns); });
  return result;
}

/// Returns a copy of the values as a NumPy array of rows.
template <typename Value>
nb::object copyOf(const std::vector<Value>& values, std::size_t columns = 1)
{
  Buffer<Value> buffer(values.size());
  std::copy(values.begin(), values.end(), buffer.begin());
  return arrayOf(std::move(buffer), columns);
}

/// Returns a copy of structures of 64-bit ids as a NumPy array with a row for each.
template <typename Row>
nb::object idRowsOf(const std::vector<Row>& rows)
{
  constexpr std::size_t columns = sizeof(Row) / sizeof(std::int64_t);
  static_assert(sizeof(Row) % sizeof(std::int64_t) == 0, "a row must consist of 64-bit ids");
  Buffer<Row> buffer(rows.size());
  std::copy(rows.begin(), rows.end(), buffer.begin());
  return arrayOf(Buffer<std::int64_t>(std::move(buffer)), columns);
}

/// Returns a copy of an array's memory, which has the type of Value or of its members.
template <typename Value>
std::vector<Value> vectorOf(const InputArray& array)
{
  const auto* const first = static_cast<const Value*>(array.data());
  return { first, first + array.nbytes() / sizeof(Value) };
}

/// Returns the counts of a run and, as "seconds", the time of each phase.
nb::dict statisticsDict(const RunStatistics& statistics);

/// A Python function that gets the finished fraction, or None.
using Progress = std::optional<nb::callable>;

/// Passes progress to a Python function, and finds out whether to continue: the work stops on
/// Ctrl-C, or if the function raises or returns False. Only the thread that constructed the object
/// calls Python; it must have released the GIL.
class Reporter
{
public:
  explicit Reporter(Progress progress)
    : Function(std::move(progress))
    , Owner(std::this_thread::get_id())
  {
  }

  /// Returns false if the work must stop.
  bool operator()(double fraction);

  /// Returns the progress function for a core. This object must outlive it.
  std::function<bool(double)> function()
  {
    return [this](double fraction) { return (*this)(fraction); };
  }

  /// Raises the exception that stopped the work. Requires the GIL.
  void raiseIfStopped() const;

  /// Reports that the work is done, or raises the exception that stopped it. Requires the GIL.
  void finish();

private:
  bool ask(double fraction);

  Progress Function;
  std::thread::id Owner;
  Stopwatch SinceAsked;
  bool Stopped = false;
  std::exception_ptr Raised;
};

/// Calls work() without the GIL.
template <typename Work>
auto withoutLock(const Work& work)
{
  const nb::gil_scoped_release released;
  return work();
}

/// Returns a selection of points of LAS files. `returns`: a LasSelection::Returns. `keep`: the
/// flags of LasSelection::keep().
inline LasSelection lasSelection(
  const std::vector<int>& classes, int returns, const std::vector<std::string>& keep)
{
  LasSelection selection;
  selection.Classes = classes;
  selection.Kind = LasSelection::Returns(returns);
  for (const std::string& flag : keep)
  {
    selection.keep(flag);
  }
  return selection;
}

void addTriangulateFunctions(nb::module_& module);
void addFileFunctions(nb::module_& module);
void addGridFunctions(nb::module_& module);
void addMeshFunctions(nb::module_& module);
/// Sets what reads NetCDF files.
void addNetcdfFunctions();
void addOverlapFunctions(nb::module_& module);
void addQueryClass(nb::module_& module);
void addSeriesFunctions(nb::module_& module);
void addToolFunctions(nb::module_& module);

/// Issues Python warnings of what readers report, and of a reference system that is not understood.
inline void warnOfFiles(const std::vector<TableReport>& reports, const std::string& crsProblem)
{
  nb::list sentences;
  for (const TableReport& report : reports)
  {
    for (const std::string& warning : report.Warnings)
    {
      sentences.append(report.Path + ": " + warning);
    }
  }
  if (!crsProblem.empty())
  {
    sentences.append(crsProblem + ".");
  }
  if (sentences.size() > 0)
  {
    nb::module_::import_("tipp._engine").attr("warn")(sentences);
  }
}

} // namespace tipp::python

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPythonBinding_h
#define tippPythonBinding_h

#include "Arrays/Buffer.h"
#include "Arrays/Scalar.h"
#include "Partitioned/ReadPiece.h"
#include "Triangulation/Triangulate.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace tipp::python
{

namespace nb = nanobind;

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

inline std::size_t bytesOf(Scalar scalar)
{
  std::size_t bytes = 0;
  withScalar(scalar, [&](auto value) { bytes = sizeof(value); });
  return bytes;
}

/// Returns a NumPy array that takes over memory from malloc(), and frees it.
inline nb::object owningArray(void* memory, Scalar scalar, const std::vector<std::size_t>& shape)
{
  const nb::capsule owner(memory, [](void* p) noexcept { std::free(p); });
  nb::object result;
  withScalar(scalar,
    [&](auto value)
    {
      using Value = decltype(value);
      result = nb::cast(nb::ndarray<nb::numpy, Value>(
        static_cast<Value*>(memory), shape.size(), shape.data(), owner));
    });
  return result;
}

template <typename Value>
constexpr Scalar scalarType();
template <>
constexpr Scalar scalarType<std::int32_t>()
{
  return Scalar::Int32;
}
template <>
constexpr Scalar scalarType<std::int64_t>()
{
  return Scalar::Int64;
}

/// Returns a NumPy array that takes over the memory of the buffer, as rows of `columns` values.
template <typename Value>
nb::object arrayOf(Buffer<Value>&& buffer, std::size_t columns)
{
  const std::size_t rows = buffer.size() / columns;
  return owningArray(buffer.release(), scalarType<Value>(), { rows, columns });
}

inline nb::object arrayOf(Buffer<char>&& buffer, Scalar scalar, std::size_t columns)
{
  const std::size_t rows = buffer.size() / bytesOf(scalar) / columns;
  return owningArray(buffer.release(), scalar,
    columns == 1 ? std::vector<std::size_t>{ rows } : std::vector<std::size_t>{ rows, columns });
}

inline nb::object copyOf(const std::vector<double>& values, std::size_t columns)
{
  Buffer<char> buffer(values.size() * sizeof(double));
  if (!values.empty())
  {
    std::memcpy(buffer.data(), values.data(), buffer.size());
  }
  return arrayOf(std::move(buffer), Scalar::Float64, columns);
}

/// Passes progress to a Python callable, which may be None, and finds out whether to continue: the
/// work stops on Ctrl-C, or if the callable raises or returns False. Only the thread that
/// constructed the object calls Python; it must have released the GIL.
class Reporter
{
public:
  explicit Reporter(nb::object callable)
    : Callable(std::move(callable))
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

private:
  nb::object Callable;
  std::thread::id Owner;
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

/// Returns a view of points of shape (n, 2) or (n, 3), float32 or float64, without a copy.
PointsView viewOf(const InputArray& points);

/// Returns the options that triangulations with and without constraints share. `reporter` must
/// outlive the result.
TriangulationOptions triangulationOptions(
  double maximumEdge, int columns, int rows, bool stages, int threads, Reporter& reporter);

/// Returns a triangulation of `points` points for Python: triangles, duplicates, rejected,
/// warnings, statistics and, if requested, neighbors. Takes over the memory of the triangles.
nb::dict triangulationDict(
  Triangulation&& triangulation, std::size_t points, bool longEdgesLeftOut, bool wantsNeighbors);

void addTriangulateFunctions(nb::module_& module);
void addConstraintFunctions(nb::module_& module);
void addFileFunctions(nb::module_& module);
void addLocatorClass(nb::module_& module);
void addDemFunction(nb::module_& module);
void addPointFunctions(nb::module_& module);
void addQueryClass(nb::module_& module);
void addResampleFunction(nb::module_& module);

} // namespace tipp::python

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteVtkXml_h
#define tippWriteVtkXml_h

#include "Arrays/Scalar.h"
#include "Files/PendingOutput.h"
#include "vtkTIPPIOModule.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace tipp
{

/// The Scalar of a C++ type.
template <typename T>
constexpr Scalar scalarOfType()
{
  static_assert(std::is_arithmetic_v<T> && sizeof(T) != 2);
  return std::is_floating_point_v<T> ? (sizeof(T) == 4 ? Scalar::Float32 : Scalar::Float64)
    : sizeof(T) == 1                 ? (std::is_signed_v<T> ? Scalar::Int8 : Scalar::UInt8)
    : sizeof(T) == 4                 ? (std::is_signed_v<T> ? Scalar::Int32 : Scalar::UInt32)
                                     : (std::is_signed_v<T> ? Scalar::Int64 : Scalar::UInt64);
}

/// An array of a VTK XML file.
struct XmlArray
{
  std::string Name;
  Scalar Type = Scalar::Float64;
  int Components = 1;
  std::uint64_t Bytes = 0;
  std::function<void(std::ostream&)> Write;     ///< writes all Bytes
  std::vector<std::string> ComponentNames = {}; ///< empty, or a name for each component
};

/// Returns an array of values in the caller's memory, which must outlive it.
template <typename T>
XmlArray xmlArray(std::string name, const T* values, std::size_t count, int components = 1)
{
  const std::uint64_t bytes = count * sizeof(T);
  return { std::move(name), scalarOfType<T>(), components, bytes,
    [values, bytes](std::ostream& to)
    { to.write(reinterpret_cast<const char*>(values), std::streamsize(bytes)); } };
}

/// Returns an array whose value i is T(valueAt(i)), computed when the file is written.
template <typename T, typename ValueAt>
XmlArray computedXmlArray(
  std::string name, std::size_t count, const ValueAt& valueAt, int components = 1)
{
  return { std::move(name), scalarOfType<T>(), components, count * sizeof(T),
    [count, valueAt](std::ostream& to)
    {
      constexpr std::size_t most = 1 << 14;
      std::vector<T> chunk;
      for (std::size_t first = 0; first < count; first += most)
      {
        chunk.clear();
        for (std::size_t i = first; i < std::min(count, first + most); ++i)
        {
          chunk.push_back(T(valueAt(i)));
        }
        to.write(
          reinterpret_cast<const char*>(chunk.data()), std::streamsize(chunk.size() * sizeof(T)));
      }
    } };
}

/// A section of a VTK XML file, such as PointData.
struct XmlSection
{
  std::string Name;
  std::vector<XmlArray> Arrays;
  std::string Scalars; ///< the name of the array of scalars; empty: none
};

/// The points of an image in a VTK XML file.
struct XmlGrid
{
  std::array<int, 6> Extent = {}; ///< first and last index along x, y and z
  std::array<double, 3> Origin = {};
  std::array<double, 3> Spacing = { 1, 1, 1 };
};

/// The content of a VTK XML file of one piece.
struct XmlPiece
{
  std::string Type; ///< UnstructuredGrid, PolyData or ImageData
  /// The attributes of the piece, such as NumberOfPoints, and their values.
  std::vector<std::pair<std::string, std::uint64_t>> Counts;
  std::vector<XmlSection> Sections;
  std::optional<XmlGrid> Grid = std::nullopt; ///< of ImageData
};

/// Writes a piece with its arrays raw and appended. `before` as for PendingFile. Returns false, and
/// publishes no file, if `isStopped` returns true at the end. Throws IOError.
VTKTIPPIO_EXPORT bool writeXmlPiece(const std::string& path, const std::optional<PathState>& before,
  const XmlPiece& piece, const std::function<bool()>& isStopped = {});

} // namespace tipp

#endif

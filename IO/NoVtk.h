// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippNoVtk_h
#define tippNoVtk_h

#include "Files/InputFile.h"
#include "Files/RawArray.h"
#include "Flat/FlattenDataSet.h"
#include "Flat/Flattened.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tipp
{

/// In a build without VTK: throws IOError for a file of a mesh that only VTK reads, and says how
/// PyVista makes a partitioned mesh of it.
[[noreturn]] VTKTIPPIO_EXPORT void refuseVtkMesh(const std::string& path);

/// Does the same for a file whose cells are wanted, and says how PyVista writes these.
[[noreturn]] VTKTIPPIO_EXPORT void refuseVtkCells(const std::string& path);

/// Reads an array as another type.
template <typename T>
std::vector<T> valuesOf(const RawArray& array)
{
  std::vector<T> result;
  withScalar(array.Type,
    [&](auto zero)
    {
      std::vector<decltype(zero)> values(std::size_t(array.Tuples) * std::size_t(array.Components));
      if (!values.empty())
      {
        InputFile(array.Path).read(array.Offset, values.data(), values.size() * sizeof(zero));
      }
      result.assign(values.begin(), values.end());
    });
  return result;
}

/// Flattens a .vti file that can be read in place. Throws IOError, also for any other file.
VTKTIPPIO_EXPORT Flattened flattenVtkImage(const std::string& path);

} // namespace tipp

#endif

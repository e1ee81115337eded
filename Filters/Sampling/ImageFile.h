// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippImageFile_h
#define tippImageFile_h

#include "Arrays/Scalar.h"
#include "Files/PendingOutput.h"
#include "Raster/RasterFile.h"
#include "Resample/Lattice.h"
#include "vtkTIPPFiltersModule.h"

#include <optional>
#include <string>
#include <vector>

namespace tipp
{

/// An array of an image, in the caller's memory.
struct ImageArray
{
  std::string Name;
  Scalar Type = Scalar::Float64;
  int Components = 1;
  const void* Values = nullptr; ///< one tuple for each sample, or for each cell between samples
  std::vector<std::string> ComponentNames = {}; ///< empty, or a name for each component
};

/// The arrays of an image. Not owned.
struct ImageArrays
{
  Lattice Grid;
  std::vector<ImageArray> OfPoints; ///< of the samples
  std::vector<ImageArray> OfCells;
};

/// Writes a .vti file. `before` as for PendingFile. Throws IOError.
VTKTIPPFILTERS_EXPORT void writeVti(
  const std::string& path, const std::optional<PathState>& before, const ImageArrays& image);

/// Returns the pixels whose centres are the samples of the lattice's first layer.
VTKTIPPFILTERS_EXPORT RasterGrid pixelsOf(const Lattice& lattice);

} // namespace tipp

#endif

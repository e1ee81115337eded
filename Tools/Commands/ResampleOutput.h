// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOutput_h
#define tippResampleOutput_h

#include "Files/PendingOutput.h"

#include <string>

class vtkImageData;

namespace tipp
{

/// Writes an image with all its arrays to a .vti file. Throws IOError. In all functions here,
/// `before` is the state of the path before the computation: only that file is replaced.
void writeImage(const std::string& path, vtkImageData* image, const PathState& before);

/// Writes the array `name` of an image to a .npy file. Throws IOError.
void writeNpy(
  const std::string& path, const std::string& name, vtkImageData* image, const PathState& before);

/// Writes an image of one layer as a GeoTIFF. Samples are the pixels' centres, and each array
/// becomes a band. Throws IOError.
void writeGeoTiff(const std::string& path, vtkImageData* image, const std::string& crs,
  double noData, int threads, const PathState& before);

} // namespace tipp

#endif

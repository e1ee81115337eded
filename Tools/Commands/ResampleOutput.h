// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOutput_h
#define tippResampleOutput_h

#include "Files/PendingOutput.h"

#include <string>

class vtkImageData;

namespace tipp
{

/// Writes an image with all arrays to a .vti file. Throws IOError.
void writeImage(const std::string& path, vtkImageData* image, const PathState& before);

/// Writes one array of an image to a .npy file. Throws IOError.
void writeNpy(
  const std::string& path, const std::string& name, vtkImageData* image, const PathState& before);

/// Writes an image of one layer as a GeoTIFF: a sample is the centre of a pixel, and an array is a
/// band. Throws IOError.
void writeGeoTiff(const std::string& path, vtkImageData* image, const std::string& crs,
  double noData, int threads, const PathState& before);

} // namespace tipp

#endif

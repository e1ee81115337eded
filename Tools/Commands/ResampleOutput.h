// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOutput_h
#define tippResampleOutput_h

#include "Files/PendingOutput.h"
#include "Ranks/Communicator.h"

#include <string>
#include <vector>

class vtkImageData;
class vtkDataSet;

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

/// If every rank has read the whole mesh: hides the cells of the other ranks' shares.
void hideOtherShares(vtkDataSet* mesh, Communicator& ranks);

/// For each name what it is in the mesh of all ranks: 'p' for a point array, 'c' for a cell array,
/// ' ' for neither. Ranks without a cell may lack arrays that others have. Collective.
std::string associationsOf(
  const std::vector<std::string>& arrays, vtkDataSet* mesh, Communicator& ranks);

} // namespace tipp

#endif

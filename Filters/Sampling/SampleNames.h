// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleNames_h
#define tippSampleNames_h

namespace tipp
{

/// The name of the point array with the heights of a surface.
constexpr const char* elevationName = "elevation";

/// The name of the array with the share of each pixel, or of each cell, that a mesh covers.
constexpr const char* coveredShareName = "CoveredShare";

/// The name of the array that is 1 at samples in a cell and 0 elsewhere.
constexpr const char* validMaskName = "vtkValidPointMask";

/// The name of the array that hides points and cells, as VTK has it.
constexpr const char* ghostArrayName = "vtkGhostType";

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleImage_h
#define tippResampleImage_h

#include "Commands/ResampleArguments.h"
#include "Files/PendingOutput.h"
#include "Sampling/ImageFile.h"

#include <cstdint>
#include <set>
#include <string>

namespace tipp
{

/// The names of a mesh's arrays.
struct ArrayNames
{
  std::set<std::string> OfPoints;
  std::set<std::string> OfCells;
};

/// Throws IOError for a name, other than `except`, that the mesh does not have.
void requireArrays(
  const ResampleArguments& arguments, const ArrayNames& known, const std::string& except);

/// Throws IOError if a mesh of volumes needs a range along z that is not given.
void requireZ(const ResampleArguments& arguments, bool hasVolumes);

/// Returns why a mesh cannot be resampled, from the message of an exception: without the names of
/// the filter's properties, with the options of the command.
std::string reasonOf(std::string message);

/// The value of samples outside of the mesh, as --null or the format has it.
double nullValueOf(const ResampleArguments& arguments);

/// Writes the image as its extension says. `before`: the state of the path before the computation;
/// only that file is replaced. Throws IOError.
void writeImage(
  const ResampleArguments& arguments, const ImageArrays& image, const PathState& before);

/// Figures of a run.
struct ResampleFigures
{
  std::int64_t Hits = 0; ///< samples in cells
  std::int64_t Samples = 0;
  std::int64_t Cells = 0;
  double Seconds = 0;
  std::string Device;
};

/// Warns if there is one sample, because the distance of samples is larger than the range.
void warnOfOneSample(const ResampleArguments& arguments, std::int64_t samples);

/// Prints the last line of a run.
void summarize(const ResampleArguments& arguments, const ResampleFigures& figures);

} // namespace tipp

#endif

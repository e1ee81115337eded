// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeResampleRun_h
#define tippRangeResampleRun_h

#include "Output/FilterPipeline.h"
#include "Ranks/Communicator.h"
#include "Resample/Lattice.h"
#include "Sampling/SampledImage.h"
#include "Sampling/SamplingRange.h"

#include "vtkRangeResampleFilter.h"

#include <exception>
#include <memory>
#include <vector>

class vtkDataArraySelection;
class vtkImageData;
class vtkPointSet;
class vtkInformation;

/// One execution of the filter.
class vtkRangeResampleFilter::Run
{
public:
  Run(vtkRangeResampleFilter* filter, tipp::Communicator& ranks)
    : Filter(filter)
    , Ranks(ranks)
    , Progress(filter)
  {
  }

  ///@{
  /// Begin and end the execution. Throw tipp::RankFailure on all ranks. Collective.
  void start(vtkInformationVector* input, vtkInformation* outInfo);
  void finish(vtkImageData* output);
  ///@}

  /// Requests all pieces and adds them. Errors are reported in finish(), where all ranks
  /// synchronise.
  void addPieces(vtkInformationVector* input);

private:
  bool severalRanks() const { return this->Ranks.size() > 1; }
  void makeImage(const std::vector<vtkPointSet*>& meshes, vtkInformation* outInfo);
  void add(const std::vector<vtkPointSet*>& meshes);
  void makeOutput(vtkImageData* output);
  void dropFlatElevation(tipp::SampledImage& image);
  tipp::SamplingSettings settings(bool merging) const;
  bool samplesElevation(
    const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes) const;
  std::vector<vtkPointSet*> meshesIn(vtkInformationVector* input) const;
  void warn(const tipp::SampledImage& image) const;
  void warnOfCounts(const tipp::SampledImage& image, std::int64_t hits);
  void warnOfMissing(tipp::SampledImage& image, vtkDataArraySelection* selection, bool ofCells);

  vtkRangeResampleFilter* Filter;
  tipp::Communicator& Ranks;
  tipp::Monitor Progress;
  int Piece = 0;
  bool AddsElevation = false; ///< the elevation array is added to each mesh
  bool HasOwnElevation = false;
  tipp::HeightRange
    Heights; ///< with several pieces: z range of the meshes whose elevation was added
  bool Stopped = false;
  bool WantsAll = true; ///< the whole image, not a part
  std::exception_ptr Problem;
  tipp::Lattice Wanted; ///< this rank's output lattice
  std::unique_ptr<tipp::SampledImage> Image;
};

#endif

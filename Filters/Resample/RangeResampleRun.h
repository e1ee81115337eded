// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRangeResampleRun_h
#define tippRangeResampleRun_h

#include "vtkRangeResampleFilter.h"

#include "Messages/Postbox.h"
#include "Output/Monitor.h"
#include "Resample/Elevation.h"
#include "Resample/Lattice.h"
#include "Resample/SampledImage.h"

#include <exception>
#include <memory>
#include <vector>

class vtkDataArraySelection;
class vtkImageData;
class vtkPointSet;

/// One update.
class vtkRangeResampleFilter::Run
{
public:
  Run(vtkRangeResampleFilter* filter, tipp::Postbox& ranks)
    : Filter(filter)
    , Ranks(ranks)
    , Progress(filter)
  {
  }

  ///@{
  /// Throws tipp::RankFailure, on all ranks. Collective.
  void start(vtkInformationVector* input, vtkInformation* outInfo);
  void finish(vtkImageData* output);
  ///@}

  /// Asks for all pieces and adds them. What fails here is told in finish(), where all ranks meet.
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
  tipp::Postbox& Ranks;
  tipp::Monitor Progress;
  int Piece = 0;
  bool AddsElevation = false; ///< to each mesh
  bool HasOwnElevation = false;
  tipp::HeightRange Heights; ///< of the meshes that it was added to, with several pieces
  bool Stopped = false;
  bool WantsAll = true; ///< and not a part of the image
  std::exception_ptr Problem;
  tipp::Lattice Wanted; ///< of this rank
  std::unique_ptr<tipp::SampledImage> Image;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
// The execution of vtkRangeResampleFilter.
#include "vtkRangeResampleFilter.h"

#include "Output/FilterPipeline.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Ranks/Communicator.h"
#include "Sampling/SampledImage.h"
#include "Sampling/SamplingRange.h"
#include "Vtk/VtkMessages.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataArraySelection.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{

/// Runs `work`; replaces std::bad_alloc by an error with advice for resampling.
template <typename Work>
void withMemoryAdvice(const Work& work)
{
  try
  {
    work();
  }
  catch (const std::bad_alloc&)
  {
    throw std::runtime_error(
      "there is not enough memory for the samples: use a smaller range or fewer samples.");
  }
}

} // namespace

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

  /// Begins the execution. Throws tipp::RankFailure on all ranks. Collective.
  void start(vtkInformationVector* input, vtkInformation* outInfo)
  {
    this->Ranks.together(
      [&]
      {
        if (this->Filter->UseInputBounds && this->Filter->NumberOfInputPieces > 1)
        {
          throw std::runtime_error(
            "with NumberOfInputPieces above 1 the bounds of the input are not "
            "known in time: turn UseInputBounds off, set SamplingBounds.");
        }
        withMemoryAdvice([&] { this->makeImage(this->meshesIn(input), outInfo); });
      });
  }

  /// Requests all pieces and adds them. Errors are reported in finish(), where all ranks
  /// synchronise.
  void addPieces(vtkInformationVector* input)
  {
    const int count = this->Filter->NumberOfInputPieces;
    vtkAlgorithmOutput* const source = this->Filter->GetInputConnection(0, 0);
    for (; this->Piece < count; ++this->Piece)
    {
      bool read = true;
      if (this->Piece > 0)
      {
        tipp::askForPiece(input->GetInformationObject(0), this->Ranks.rank() * count + this->Piece,
          this->Ranks.size() * count);
        read = source->GetProducer()->GetExecutive()->Update(source->GetIndex()) != 0;
      }
      if (!this->Problem && !this->Stopped)
      {
        try
        {
          if (!read)
          {
            throw std::runtime_error(
              "the input has not made its piece " + std::to_string(this->Piece) + ".");
          }
          withMemoryAdvice([&] { this->add(this->meshesIn(input)); });
        }
        catch (const std::exception&)
        {
          this->Problem = std::current_exception();
        }
      }
      // Sources may require that all ranks request all pieces.
      if ((this->Problem || this->Stopped) && !this->severalRanks())
      {
        return;
      }
    }
  }

  /// Ends the execution. Throws tipp::RankFailure on all ranks. Collective.
  void finish(vtkImageData* output)
  {
    this->Ranks.together(
      [&]
      {
        if (this->Problem)
        {
          std::rethrow_exception(this->Problem);
        }
        if (this->Stopped)
        {
          throw tipp::RankFailure(this->Ranks.rank(), true, "The run was stopped.");
        }
        withMemoryAdvice([&] { this->makeOutput(output); });
      });
  }

private:
  bool severalRanks() const { return this->Ranks.size() > 1; }

  /// The meshes of the input; empty if it has no data yet.
  std::vector<vtkPointSet*> meshesIn(vtkInformationVector* input) const
  {
    vtkDataObject* const data = vtkDataObject::GetData(input);
    return data ? tipp::meshesOf(data, this->Filter->NumberOfThreads) : std::vector<vtkPointSet*>();
  }

  tipp::SamplingSettings settings(bool merging) const
  {
    vtkRangeResampleFilter* const filter = this->Filter;
    tipp::SamplingSettings settings;
    settings.Selected = [filter](bool ofCells, const std::string& name)
    {
      vtkDataArraySelection* const selection =
        ofCells ? filter->CellDataArraySelection : filter->PointDataArraySelection;
      return selection->ArrayIsEnabled(name.c_str()) != 0;
    };
    settings.NullValue = filter->NullValue;
    if (filter->UseNoDataValue)
    {
      settings.NoData = filter->NoDataValue;
    }
    settings.Device.Kind = static_cast<tipp::Device>(filter->Device);
    settings.Device.Index = filter->DeviceIndex;
    settings.Device.Name = filter->DeviceName ? filter->DeviceName : "";
    settings.Threads = tipp::threadCount(filter->NumberOfThreads);
    settings.Merging = merging;
    return settings;
  }

  /// Whether the elevation of the meshes is to be sampled. Collective.
  bool samplesElevation(const std::vector<vtkPointSet*>& meshes, const std::vector<int>& axes) const
  {
    return this->Filter->SampleElevation && axes == std::vector<int>{ 0, 1 } &&
      this->Filter->PointDataArraySelection->ArrayIsEnabled(tipp::elevationName) &&
      (this->Filter->NumberOfInputPieces > 1 || tipp::haveElevation(meshes, this->Ranks));
  }

  void makeImage(const std::vector<vtkPointSet*>& meshes, vtkInformation* outInfo)
  {
    vtkRangeResampleFilter* const filter = this->Filter;
    const std::array<double, 6> bounds = filter->UseInputBounds
      ? tipp::boundsOf(meshes, this->Ranks)
      : tipp::toArray(filter->SamplingBounds);
    this->Wanted = tipp::rangeLattice(
      bounds, filter->Dimensions(bounds, meshes, this->Ranks), tipp::toArray(filter->Delta));
    const std::array<int, 6> whole = this->Wanted.Extent;
    const std::vector<int> axes = tipp::surfaceAxes({ whole[1] + 1, whole[3] + 1, whole[5] + 1 });
    if (filter->GatherOnRoot && this->severalRanks())
    {
      if (this->Ranks.rank() != 0)
      {
        this->Wanted.Extent = { 0, -1, 0, -1, 0, -1 };
      }
    }
    else if (outInfo->Has(Pipeline::UPDATE_EXTENT()))
    {
      outInfo->Get(Pipeline::UPDATE_EXTENT(), this->Wanted.Extent.data());
      this->WantsAll = this->severalRanks() || this->Wanted.Extent == whole;
    }
    this->AddsElevation = this->samplesElevation(meshes, axes);
    tipp::Lattice local = this->Wanted;
    if (this->severalRanks())
    {
      local.Extent = whole;
      local = filter->NumberOfInputPieces == 1 ? tipp::cropped(local, meshes, axes) : local;
    }
    const bool merging =
      this->severalRanks() || filter->NumberOfInputPieces > 1 || meshes.size() > 1;
    tipp::SamplingSettings settings = this->settings(merging);
    settings.Axes = axes;
    tipp::refuseTooLarge(local, this->Wanted, this->severalRanks(), meshes, settings);
    this->Image = std::make_unique<tipp::SampledImage>(local, settings);
  }

  void add(const std::vector<vtkPointSet*>& meshes)
  {
    for (std::size_t i = 0; i < meshes.size() && !this->Stopped; ++i)
    {
      const auto report = [&](double done)
      {
        const double ofPiece = (double(i) + done) / double(meshes.size());
        return this->Progress((this->Piece + ofPiece) / this->Filter->NumberOfInputPieces);
      };
      vtkSmartPointer<vtkPointSet> mesh = meshes[i];
      if (this->AddsElevation)
      {
        mesh = tipp::withElevation(meshes[i]);
        this->HasOwnElevation =
          this->HasOwnElevation || meshes[i]->GetPointData()->HasArray(tipp::elevationName);
        this->Filter->NumberOfInputPieces > 1 ? this->Heights.add(mesh) : void();
      }
      this->Stopped = !this->Image->add(mesh, report);
    }
  }

  void makeOutput(vtkImageData* output)
  {
    this->Image->finish();
    tipp::SampledImage* image = this->Image.get();
    std::unique_ptr<tipp::SampledImage> together;
    tipp::Stopwatch watch;
    tipp::SamplingReport report;
    report.Statistics = this->Image->statistics();
    if (this->severalRanks())
    {
      together = std::make_unique<tipp::SampledImage>(this->Wanted, this->settings(true));
      tipp::exchangeSamples(*image, *together, this->Ranks);
      this->warn(*together);
      image = together.get();
    }
    this->dropFlatElevation(*image);
    report.ExchangeSeconds = watch.restart();
    this->warn(*this->Image);
    report.Threads = this->settings(true).Threads;
    report.Hits = tipp::fillImage(*image, report.Threads, output);
    report.Samples = image->samples();
    report.OutputSeconds = watch.restart();
    tipp::fillTable(report, this->Filter->Statistics);
    this->warnOfCounts(*image, report.Hits);
    this->warnOfMissing(*image, this->Filter->PointDataArraySelection, false);
    this->warnOfMissing(*image, this->Filter->CellDataArraySelection, true);
  }

  /// Removes the elevation array if all points have the same z. With several pieces this is known
  /// only after the last one. Collective.
  void dropFlatElevation(tipp::SampledImage& image)
  {
    if (!this->AddsElevation || this->Filter->NumberOfInputPieces == 1)
    {
      return;
    }
    this->Heights.gather(this->Ranks);
    std::vector<std::int64_t> kept{ this->HasOwnElevation ? 1 : 0 };
    this->Ranks.sum(kept);
    if (kept[0] == 0 && (this->Heights.isFlat() || image.dimension() == 3))
    {
      std::vector<tipp::SampledImage::Array>& arrays = image.arrays();
      arrays.erase(
        std::remove_if(arrays.begin(), arrays.end(),
          [](const tipp::SampledImage::Array& array) { return array.Name == tipp::elevationName; }),
        arrays.end());
    }
  }

  void warn(const tipp::SampledImage& image) const
  {
    for (const std::string& warning : image.warnings())
    {
      vtkWarningWithObjectMacro(this->Filter, << warning);
    }
  }

  /// Warns on the first rank of counts summed over all ranks. Collective.
  void warnOfCounts(const tipp::SampledImage& image, std::int64_t hits)
  {
    std::vector<std::int64_t> sums{ this->Image->statistics().NotFinite,
      this->Image->statistics().Cells, hits, image.samples() };
    this->Ranks.sum(sums);
    if (this->Ranks.rank() != 0)
    {
      return;
    }
    if (sums[0] > 0)
    {
      vtkWarningWithObjectMacro(this->Filter,
        << sums[0]
        << (sums[0] == 1
               ? " cell has a corner with a NaN or infinite coordinate and yields no value."
               : " cells have a corner with a NaN or infinite coordinate and yield no "
                 "value."));
    }
    if (sums[1] > 0 && sums[2] == 0 && sums[3] > 0 && this->WantsAll)
    {
      vtkWarningWithObjectMacro(this->Filter,
        "No sample lies in a cell of the mesh: check the range and the number of samples.");
    }
  }

  void warnOfMissing(tipp::SampledImage& image, vtkDataArraySelection* selection, bool ofCells)
  {
    for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
    {
      const char* const name = selection->GetArrayName(i);
      const tipp::SampledImage::Array* array = image.findArray(name);
      if (selection->GetArraySetting(i) && (!array || array->OfCells != ofCells) &&
        this->Image->statistics().Cells > 0)
      {
        vtkWarningWithObjectMacro(this->Filter,
          "There is no " << (ofCells ? "cell" : "point") << " array '" << name
                         << "' in the input, so it is not sampled"
                         << tipp::listOfNames(this->Image->namesOf(ofCells), "; there are ")
                         << ".");
      }
    }
  }

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

int vtkRangeResampleFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const outInfo = outputs->GetInformationObject(0);
  vtkImageData* const output = vtkImageData::GetData(outInfo);
  output->Initialize();
  try
  {
    tipp::Communicator ranks(this->Controller);
    Run run(this, ranks);
    run.start(inputs[0], outInfo);
    run.addPieces(inputs[0]);
    run.finish(output);
  }
  catch (const std::exception& error)
  {
    output->Initialize();
    const auto* const failure = dynamic_cast<const tipp::RankFailure*>(&error);
    if (failure && failure->Aborted)
    {
      return 1;
    }
    vtkErrorMacro("Resampling: " << error.what());
    return 0;
  }
  vtkDataObject* const input = vtkDataObject::GetData(inputs[0]);
  if (this->PassFieldArrays && input)
  {
    output->GetFieldData()->PassData(input->GetFieldData());
  }
  return 1;
}

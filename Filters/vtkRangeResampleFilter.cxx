// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRangeResampleFilter.h"

#include "OpenCL/Devices.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Pipeline/FilterPipeline.h"
#include "Ranks/Communicator.h"
#include "Sampling/ImageOutput.h"
#include "Sampling/SampledImage.h"
#include "Sampling/SamplingRange.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkRangeResampleFilter);

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// What is kept from one time step to the next.
class vtkRangeResampleFilter::Kept : public tipp::KeptClaims
{
};

vtkRangeResampleFilter::vtkRangeResampleFilter()
{
  this->PointDataArraySelection->SetUnknownArraySetting(1);
  this->CellDataArraySelection->SetUnknownArraySetting(1);
  for (vtkDataArraySelection* selection :
    { this->PointDataArraySelection.Get(), this->CellDataArraySelection.Get() })
  {
    selection->AddObserver(vtkCommand::ModifiedEvent, this, &vtkRangeResampleFilter::Modified);
  }
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkRangeResampleFilter::~vtkRangeResampleFilter() = default;

void vtkRangeResampleFilter::SetDeviceChoice(const char* text)
{
  tipp::runReported(this, nullptr, "", nullptr,
    [&]
    {
      const tipp::DeviceChoice choice = tipp::parseDeviceChoice(text ? text : "auto");
      this->SetDevice(int(choice.Kind));
      this->SetDeviceIndex(choice.Index);
      this->SetDeviceName(choice.Name.c_str());
    });
}

vtkStringArray* vtkRangeResampleFilter::GetDeviceChoices()
{
  this->DeviceChoices->Reset();
  for (const std::string& choice : tipp::deviceChoices(tipp::listDevices()))
  {
    this->DeviceChoices->InsertNextValue(choice);
  }
  return this->DeviceChoices;
}

int vtkRangeResampleFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

int vtkRangeResampleFilter::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const inInfo = inputs[0]->GetInformationObject(0);
  const bool hasSteps =
    inInfo->Has(Pipeline::TIME_STEPS()) && inInfo->Length(Pipeline::TIME_STEPS()) > 1;
  if (hasSteps != bool(this->KeptForSteps))
  {
    this->KeptForSteps = hasSteps ? std::make_unique<Kept>() : nullptr;
  }
  vtkInformation* const outInfo = outputs->GetInformationObject(0);
  outInfo->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  return tipp::runReported(this, nullptr, "Resampling: ", nullptr,
    [&]
    {
      const std::array<double, 3> delta = tipp::toArray(this->Delta);
      const bool byDelta = delta[0] > 0 || delta[1] > 0 || delta[2] > 0;
      // Bounds are not needed if all SamplingDimensions are given; any valid ones will do.
      tipp::Box3 bounds = this->UseInputBounds ? tipp::Box3{ { 0, 0, 0 }, { 1, 1, 1 } }
                                               : tipp::boxOfVtkBounds<3>(this->SamplingBounds);
      std::array<int, 3> dimensions = tipp::toArray(this->SamplingDimensions);
      const bool chosen = std::count(dimensions.begin(), dimensions.end(), 0) > 0;
      if (chosen || (byDelta && this->UseInputBounds))
      {
        if (this->NumberOfInputPieces > 1)
        {
          throw std::runtime_error(
            "with NumberOfInputPieces above 1 the input is not known in time: turn UseInputBounds "
            "off, set SamplingBounds, and give SamplingDimensions a number along every axis.");
        }
        tipp::Communicator ranks(this->Controller);
        vtkDataObject* const input = tipp::updatedInput(this, ranks.rank(), ranks.size(), outInfo);
        ranks.together(
          [&]
          {
            if (!input)
            {
              throw std::runtime_error("the input has not been made, so its extent is not known.");
            }
            const std::vector<vtkPointSet*> meshes = tipp::meshesOf(input, this->NumberOfThreads);
            bounds = this->UseInputBounds ? tipp::boundsOf(meshes, ranks) : bounds;
            dimensions = tipp::chosenDimensions(bounds, dimensions, meshes, ranks);
          });
      }
      tipp::Lattice lattice = tipp::rangeLattice(bounds, dimensions, delta);
      outInfo->Set(Pipeline::WHOLE_EXTENT(), lattice.Extent.data(), 6);
      if (!this->UseInputBounds || byDelta || chosen)
      {
        outInfo->Set(vtkDataObject::ORIGIN(), lattice.Min.data(), 3);
        outInfo->Set(vtkDataObject::SPACING(), lattice.Delta.data(), 3);
      }
    });
}

int vtkRangeResampleFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  const bool several = tipp::hasSeveralRanks(this->Controller);
  const int count = this->NumberOfInputPieces;
  tipp::askForUpdatePiece(inputs[0]->GetInformationObject(0),
    several ? this->Controller->GetLocalProcessId() * count : 0,
    several ? this->Controller->GetNumberOfProcesses() * count : count);
  return 1;
}

/// One execution of the filter.
class vtkRangeResampleFilter::Resampling
{
public:
  Resampling(vtkRangeResampleFilter* filter, tipp::Communicator& ranks)
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
        if (this->Filter->Method == METHOD_CONSERVATIVE && this->severalRanks())
        {
          throw std::runtime_error("conservative means are computed on one rank: run it alone.");
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
        tipp::askForUpdatePiece(input->GetInformationObject(0),
          this->Ranks.rank() * count + this->Piece, this->Ranks.size() * count);
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
  /// Runs `work`; replaces std::bad_alloc by an error with advice for resampling.
  static void withMemoryAdvice(const std::function<void()>& work)
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

  bool severalRanks() const { return this->Ranks.size() > 1; }

  /// The meshes of the input; empty if it has no data yet.
  std::vector<vtkPointSet*> meshesIn(vtkInformationVector* input) const
  {
    vtkDataObject* const data = vtkDataObject::GetData(input);
    return data ? tipp::meshesOf(data, this->Filter->NumberOfThreads) : std::vector<vtkPointSet*>();
  }

  tipp::SamplingSettings settings() const
  {
    vtkRangeResampleFilter* const filter = this->Filter;
    tipp::SamplingSettings settings;
    settings.Selected = [filter](bool ofCells, const std::string& name)
    {
      vtkDataArraySelection* const selection =
        ofCells ? filter->GetCellDataArraySelection() : filter->GetPointDataArraySelection();
      return selection->ArrayIsEnabled(name.c_str()) != 0;
    };
    settings.NullValue = filter->NullValue;
    if (filter->UseNoDataValue)
    {
      settings.NoData = filter->NoDataValue;
    }
    settings.Device.Kind = static_cast<tipp::Device>(filter->Device);
    settings.Device.Index = filter->DeviceIndex;
    settings.Device.Name = filter->DeviceName;
    settings.Threads = tipp::threadCount(filter->NumberOfThreads);
    settings.Merging = true;
    settings.Conservative = filter->Method == METHOD_CONSERVATIVE;
    settings.CoveredShare = filter->PassCoveredShare;
    return settings;
  }

  void makeImage(const std::vector<vtkPointSet*>& meshes, vtkInformation* outInfo)
  {
    vtkRangeResampleFilter* const filter = this->Filter;
    const tipp::Box3 bounds = filter->UseInputBounds
      ? tipp::boundsOf(meshes, this->Ranks)
      : tipp::boxOfVtkBounds<3>(filter->SamplingBounds);
    this->Wanted = tipp::rangeLattice(bounds,
      tipp::chosenDimensions(
        bounds, tipp::toArray(filter->SamplingDimensions), meshes, this->Ranks),
      tipp::toArray(filter->Delta));
    const std::array<int, 6> whole = this->Wanted.Extent;
    const std::vector<int> axes = tipp::surfaceAxes({ whole[1] + 1, whole[3] + 1, whole[5] + 1 });
    if (filter->StrictBounds && !filter->UseInputBounds && filter->NumberOfInputPieces == 1)
    {
      tipp::requireSensible(bounds, meshes, axes, this->Ranks);
    }
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
    this->AddsElevation = filter->SampleElevation && axes == std::vector<int>{ 0, 1 } &&
      filter->PointDataArraySelection->ArrayIsEnabled(tipp::elevationName) &&
      (filter->NumberOfInputPieces > 1 || tipp::haveElevation(meshes, this->Ranks));
    tipp::Lattice local = this->Wanted;
    if (this->severalRanks())
    {
      local.Extent = whole;
      local = filter->NumberOfInputPieces == 1 ? tipp::cropped(local, meshes, axes) : local;
    }
    tipp::SamplingSettings settings = this->settings();
    settings.Axes = axes;
    settings.Merging = this->severalRanks() || filter->NumberOfInputPieces > 1 || meshes.size() > 1;
    const bool keeps = !settings.Merging && !settings.NoData && !settings.Conservative &&
      settings.Device.Kind != tipp::Device::OpenCL;
    settings.Kept = keeps ? filter->KeptForSteps.get() : nullptr;
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
        if (this->Filter->NumberOfInputPieces > 1)
        {
          this->Heights.add(meshes[i]);
        }
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
    if (this->severalRanks())
    {
      together = std::make_unique<tipp::SampledImage>(this->Wanted, this->settings());
      tipp::exchangeSamples(*image, *together, this->Ranks);
      tipp::warn(this->Filter, together->warnings());
      image = together.get();
    }
    this->dropFlatElevation(*image);
    tipp::SamplingStatistics statistics = this->Image->statistics();
    statistics.ExchangeSeconds = watch.restart();
    tipp::warn(this->Filter, this->Image->warnings());
    const int threads = tipp::threadCount(this->Filter->NumberOfThreads);
    const std::int64_t hits = tipp::fillImage(*image, threads, output);
    statistics.OutputSeconds = watch.restart();
    tipp::fillTable(statistics, image->samples(), hits, threads, this->Filter->Statistics);
    this->warnOfCounts(*image, hits);
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
    if (!this->Heights.HasArray && (this->Heights.isFlat() || image.dimension() == 3))
    {
      image.removeArray(tipp::elevationName);
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
  tipp::HeightRange Heights;  ///< with several pieces: of the meshes whose elevation was added
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
  return tipp::runReported(this, nullptr, "Resampling: ", outputs,
    [&]
    {
      tipp::Communicator ranks(this->Controller);
      Resampling run(this, ranks);
      run.start(inputs[0], outInfo);
      run.addPieces(inputs[0]);
      run.finish(output);
      vtkDataObject* const input = vtkDataObject::GetData(inputs[0]);
      if (this->PassFieldArrays && input)
      {
        output->GetFieldData()->PassData(input->GetFieldData());
      }
    });
}

void vtkRangeResampleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(SamplingBounds);
  vtkTIPPPrintMacro(SamplingDimensions);
  vtkTIPPPrintMacro(Delta);
  vtkTIPPPrintMacro(UseInputBounds);
  vtkTIPPPrintMacro(StrictBounds);
  vtkTIPPPrintMacro(NullValue);
  vtkTIPPPrintMacro(UseNoDataValue);
  vtkTIPPPrintMacro(NoDataValue);
  vtkTIPPPrintMacro(SampleElevation);
  vtkTIPPPrintMacro(PassFieldArrays);
  vtkTIPPPrintMacro(Method);
  vtkTIPPPrintMacro(PassCoveredShare);
  vtkTIPPPrintMacro(Device);
  vtkTIPPPrintMacro(DeviceIndex);
  vtkTIPPPrintMacro(DeviceName);
  vtkTIPPPrintMacro(NumberOfThreads);
  vtkTIPPPrintMacro(NumberOfInputPieces);
  vtkTIPPPrintMacro(GatherOnRoot);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "PointDataArraySelection:\n";
  this->PointDataArraySelection->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CellDataArraySelection:\n";
  this->CellDataArraySelection->PrintSelf(os, indent.GetNextIndent());
}

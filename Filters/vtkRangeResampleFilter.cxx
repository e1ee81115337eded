// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRangeResampleFilter.h"

#include "Compatibility.h"
#include "OpenCL/DeviceList.h"
#include "Output/Monitor.h"
#include "Resample/ExchangeSamples.h"
#include "Resample/ImageOutput.h"
#include "Resample/SampledImage.h"
#include "Resample/SamplingRange.h"
#include "Resample/UpdatedInput.h"
#include "Triangulation/Stopwatch.h"

#include "vtkCommand.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArraySelection.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <omp.h>

#include <algorithm>
#include <cstring>

vtkStandardNewMacro(vtkRangeResampleFilter);
vtkCxxSetObjectMacro(vtkRangeResampleFilter, Controller, vtkMultiProcessController);

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{

template <std::size_t N, typename T>
std::array<T, N> toArray(const T (&values)[N])
{
  std::array<T, N> result;
  std::copy(values, values + N, result.begin());
  return result;
}

/// The controller if there is more than one rank.
vtkMultiProcessController* ranksOf(vtkMultiProcessController* controller)
{
  return controller && controller->GetNumberOfProcesses() > 1 ? controller : nullptr;
}

bool failedAnywhere(vtkMultiProcessController* controller, bool failed)
{
  const int mine = failed;
  int any = mine;
  if (controller)
  {
    controller->AllReduce(&mine, &any, 1, vtkCommunicator::MAX_OP);
  }
  return any != 0;
}

} // namespace

/// What lasts from the first of the input's pieces to the last.
class vtkRangeResampleFilter::Run
{
public:
  explicit Run(vtkRangeResampleFilter* filter)
    : Filter(filter)
    , Ranks(ranksOf(filter->Controller))
    , Progress(filter)
  {
  }

  /// Another piece; throws. False if the user stopped it.
  bool add(vtkDataObject* input, vtkInformation* outInfo);

  /// Makes the output; throws.
  void finish(vtkImageData* output);

  bool last() const { return this->Piece == this->Filter->NumberOfInputPieces; }
  int piece() const { return this->Piece; }

private:
  void start(const std::vector<vtkPointSet*>& meshes, vtkInformation* outInfo);
  tipp::SamplingSettings settings(bool merging) const;
  void warn(const tipp::SampledImage& image) const;
  void warnOfMissing(vtkDataArraySelection* selection, bool ofCells);

  vtkRangeResampleFilter* Filter;
  vtkMultiProcessController* Ranks;
  tipp::Monitor Progress;
  int Piece = 0;
  tipp::Lattice Wanted; ///< of this rank
  std::unique_ptr<tipp::SampledImage> Image;
  double ExchangeSeconds = 0;
};

tipp::SamplingSettings vtkRangeResampleFilter::Run::settings(bool merging) const
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
  settings.Device.Kind = filter->Device == DEVICE_OPENMP ? tipp::Device::OpenMP
    : filter->Device == DEVICE_OPENCL                    ? tipp::Device::OpenCL
                                                         : tipp::Device::Auto;
  settings.Device.Index = filter->DeviceIndex;
  settings.Device.Name = filter->DeviceName ? filter->DeviceName : "";
  settings.Threads = filter->NumberOfThreads > 0 ? filter->NumberOfThreads : omp_get_max_threads();
  settings.Merging = merging;
  return settings;
}

void vtkRangeResampleFilter::Run::start(
  const std::vector<vtkPointSet*>& meshes, vtkInformation* outInfo)
{
  vtkRangeResampleFilter* const filter = this->Filter;
  const std::array<double, 6> bounds =
    filter->UseInputBounds ? tipp::boundsOf(meshes, this->Ranks) : toArray(filter->SamplingBounds);
  this->Wanted =
    tipp::rangeLattice(bounds, filter->Dimensions(bounds, meshes), toArray(filter->Delta));
  const std::array<int, 6> whole = this->Wanted.Extent;
  const std::vector<int> axes = tipp::surfaceAxes({ whole[1] + 1, whole[3] + 1, whole[5] + 1 });
  if (filter->GatherOnRoot && this->Ranks)
  {
    if (this->Ranks->GetLocalProcessId() != 0)
    {
      this->Wanted.Extent = { 0, -1, 0, -1, 0, -1 };
    }
  }
  else if (outInfo->Has(Pipeline::UPDATE_EXTENT()))
  {
    outInfo->Get(Pipeline::UPDATE_EXTENT(), this->Wanted.Extent.data());
  }
  tipp::Lattice local = this->Wanted;
  if (this->Ranks)
  {
    local.Extent = whole;
    local = filter->NumberOfInputPieces == 1 ? tipp::cropped(local, meshes, axes) : local;
  }
  const bool merging = this->Ranks || filter->NumberOfInputPieces > 1 || meshes.size() > 1;
  tipp::SamplingSettings settings = this->settings(merging);
  settings.Axes = axes;
  settings.Progress = [this](double done)
  {
    const int pieces = this->Filter->NumberOfInputPieces;
    return this->Progress((this->Piece + done) / pieces);
  };
  tipp::refuseTooLarge(local, this->Wanted, this->Ranks != nullptr, meshes, settings);
  this->Image = std::make_unique<tipp::SampledImage>(local, settings);
}

bool vtkRangeResampleFilter::Run::add(vtkDataObject* input, vtkInformation* outInfo)
{
  const std::vector<vtkPointSet*> meshes = tipp::meshesOf(input);
  if (!this->Image)
  {
    this->start(meshes, outInfo);
  }
  for (vtkPointSet* mesh : meshes)
  {
    if (!this->Image->lattice().empty() && !this->Image->add(mesh))
    {
      return false;
    }
  }
  ++this->Piece;
  return true;
}

void vtkRangeResampleFilter::Run::finish(vtkImageData* output)
{
  this->Image->finish();
  tipp::SampledImage* image = this->Image.get();
  std::unique_ptr<tipp::SampledImage> together;
  const tipp::Stopwatch watch;
  if (this->Ranks)
  {
    together = std::make_unique<tipp::SampledImage>(this->Wanted, this->settings(true));
    tipp::exchangeSamples(*image, *together, this->Ranks);
    image = together.get();
  }
  this->ExchangeSeconds = watch.seconds();
  this->warn(*this->Image);
  const double fillBegin = watch.seconds();
  const int threads = this->settings(true).Threads;
  const std::int64_t hits = tipp::fillImage(*image, threads, output);
  tipp::SamplingReport report;
  report.Statistics = this->Image->statistics();
  report.Samples = std::int64_t(image->valid().size());
  report.Hits = hits;
  report.Threads = threads;
  report.ExchangeSeconds = this->ExchangeSeconds;
  report.OutputSeconds = watch.seconds() - fillBegin;
  tipp::fillTable(report, this->Filter->Statistics);
  this->warnOfMissing(this->Filter->PointDataArraySelection, false);
  this->warnOfMissing(this->Filter->CellDataArraySelection, true);
}

void vtkRangeResampleFilter::Run::warn(const tipp::SampledImage& image) const
{
  for (const std::string& warning : image.warnings())
  {
    vtkWarningWithObjectMacro(this->Filter, << warning);
  }
}

void vtkRangeResampleFilter::Run::warnOfMissing(vtkDataArraySelection* selection, bool ofCells)
{
  for (int i = 0; i < selection->GetNumberOfArrays(); ++i)
  {
    const char* const name = selection->GetArrayName(i);
    const tipp::SampledImage::Array* array = this->Image->findArray(name);
    if (selection->GetArraySetting(i) && (!array || array->OfCells != ofCells) &&
      this->Image->statistics().Cells > 0)
    {
      vtkWarningWithObjectMacro(this->Filter,
        "There is no " << (ofCells ? "cell" : "point") << " array '" << name
                       << "' in the input, so it is not sampled.");
    }
  }
}

vtkRangeResampleFilter::vtkRangeResampleFilter()
  : PointDataArraySelection(vtkDataArraySelection::New())
  , CellDataArraySelection(vtkDataArraySelection::New())
{
  this->PointDataArraySelection->SetUnknownArraySetting(1);
  this->CellDataArraySelection->SetUnknownArraySetting(1);
  for (vtkDataArraySelection* selection :
    { this->PointDataArraySelection, this->CellDataArraySelection })
  {
    selection->AddObserver(vtkCommand::ModifiedEvent, this, &vtkRangeResampleFilter::Modified);
  }
  this->vtkRangeResampleFilter::SetController(vtkMultiProcessController::GetGlobalController());
}

vtkRangeResampleFilter::~vtkRangeResampleFilter()
{
  this->vtkRangeResampleFilter::SetController(nullptr);
  this->vtkRangeResampleFilter::SetDeviceName(nullptr);
  this->PointDataArraySelection->Delete();
  this->CellDataArraySelection->Delete();
}

void vtkRangeResampleFilter::SetDeviceChoice(const char* text)
{
  try
  {
    const tipp::DeviceChoice choice = tipp::parseDeviceChoice(text ? text : "auto");
    this->SetDevice(choice.Kind == tipp::Device::OpenMP ? DEVICE_OPENMP
        : choice.Kind == tipp::Device::OpenCL           ? DEVICE_OPENCL
                                                        : DEVICE_AUTO);
    this->SetDeviceIndex(choice.Index);
    this->SetDeviceName(choice.Name.empty() ? nullptr : choice.Name.c_str());
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
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

vtkTable* vtkRangeResampleFilter::GetStatistics()
{
  return this->Statistics;
}

int vtkRangeResampleFilter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

/// SamplingDimensions, with numbers where they are 0.
std::array<int, 3> vtkRangeResampleFilter::Dimensions(
  const std::array<double, 6>& bounds, const std::vector<vtkPointSet*>& meshes) const
{
  const std::array<int, 3> given = toArray(this->SamplingDimensions);
  if (std::count(given.begin(), given.end(), 0) == 0)
  {
    return given;
  }
  return tipp::chosenDimensions(
    bounds, given, tipp::areSurfaces(meshes, ranksOf(this->Controller)));
}

int vtkRangeResampleFilter::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* const outInfo = outputs->GetInformationObject(0);
  outInfo->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  try
  {
    const std::array<double, 3> delta = toArray(this->Delta);
    const bool byDelta = delta[0] > 0 || delta[1] > 0 || delta[2] > 0;
    // Given SamplingDimensions need no bounds; any valid ones will do.
    std::array<double, 6> bounds = { 0, 1, 0, 1, 0, 1 };
    if (!this->UseInputBounds)
    {
      bounds = toArray(this->SamplingBounds);
    }
    const int* const given = this->SamplingDimensions;
    const bool chosen = std::count(given, given + 3, 0) > 0;
    std::vector<vtkPointSet*> meshes;
    if (chosen || (byDelta && this->UseInputBounds))
    {
      if (this->NumberOfInputPieces > 1)
      {
        throw std::runtime_error(
          "with NumberOfInputPieces above 1 the input is not known in time: turn UseInputBounds "
          "off, set SamplingBounds, and give SamplingDimensions a number along every axis.");
      }
      vtkDataObject* const input = tipp::updatedInput(this, ranksOf(this->Controller), outInfo);
      meshes = input ? tipp::meshesOf(input) : meshes;
      bounds = this->UseInputBounds ? tipp::boundsOf(meshes, ranksOf(this->Controller)) : bounds;
    }
    tipp::Lattice lattice = tipp::rangeLattice(bounds, this->Dimensions(bounds, meshes), delta);
    outInfo->Set(Pipeline::WHOLE_EXTENT(), lattice.Extent.data(), 6);
    if (!this->UseInputBounds || byDelta || chosen)
    {
      outInfo->Set(vtkDataObject::ORIGIN(), lattice.Min.data(), 3);
      outInfo->Set(vtkDataObject::SPACING(), lattice.Delta.data(), 3);
    }
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro("Resampling: " << error.what());
    return 0;
  }
}

int vtkRangeResampleFilter::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  vtkInformation* const inInfo = inputs[0]->GetInformationObject(0);
  vtkMultiProcessController* const ranks = ranksOf(this->Controller);
  const int count = this->NumberOfInputPieces;
  const int rank = ranks ? ranks->GetLocalProcessId() : 0;
  const int size = ranks ? ranks->GetNumberOfProcesses() : 1;
  const int piece = this->Current ? this->Current->piece() : 0;
  inInfo->Remove(Pipeline::UPDATE_EXTENT());
  if (inInfo->Has(Pipeline::WHOLE_EXTENT())) // a structured grid
  {
    inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), rank * count + piece);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), size * count);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  return 1;
}

int vtkRangeResampleFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const outInfo = outputs->GetInformationObject(0);
  vtkDataObject* const input = vtkDataObject::GetData(inputs[0]);
  vtkImageData* const output = vtkImageData::GetData(outInfo);
  vtkMultiProcessController* const ranks = ranksOf(this->Controller);
  std::string problem;
  bool stopped = false;
  const auto attempt = [&](const auto& work)
  {
    try
    {
      work();
    }
    catch (const std::bad_alloc&)
    {
      problem = "there is not enough memory for the samples: use a smaller range or fewer samples.";
    }
    catch (const std::exception& error)
    {
      problem = error.what();
    }
  };
  attempt(
    [&]
    {
      if (!this->Current)
      {
        if (this->UseInputBounds && this->NumberOfInputPieces > 1)
        {
          throw std::runtime_error(
            "with NumberOfInputPieces above 1 the bounds of the input are not "
            "known in time: turn UseInputBounds off, set SamplingBounds.");
        }
        this->Current = std::make_unique<Run>(this);
      }
      stopped = !this->Current->add(input, outInfo);
    });
  if (problem.empty() && !stopped && !this->Current->last())
  {
    request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
    return 1;
  }
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  const std::unique_ptr<Run> run = std::move(this->Current);
  output->Initialize();
  // All ranks go on, or none: an exchange without one of them would never end.
  const bool failed = failedAnywhere(ranks, !problem.empty() || stopped);
  if (!failed)
  {
    attempt([&] { run->finish(output); });
  }
  if (!problem.empty())
  {
    output->Initialize();
    vtkErrorMacro("Resampling: " << problem);
    return 0;
  }
  if (failed && !stopped)
  {
    vtkErrorMacro("Resampling: another rank failed or was stopped; see its message.");
    return 0;
  }
  if (this->PassFieldArrays && !failed)
  {
    output->GetFieldData()->PassData(input->GetFieldData());
  }
  return 1;
}

void vtkRangeResampleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto list = [&](const char* name, const auto& values)
  {
    os << indent << name << ":";
    for (const auto value : values)
    {
      os << " " << value;
    }
    os << "\n";
  };
  list("SamplingBounds", this->SamplingBounds);
  list("SamplingDimensions", this->SamplingDimensions);
  list("Delta", this->Delta);
  const auto one = [&](const char* name, const auto& value)
  { os << indent << name << ": " << value << "\n"; };
  one("UseInputBounds", this->UseInputBounds);
  one("NullValue", this->NullValue);
  one("UseNoDataValue", this->UseNoDataValue);
  one("NoDataValue", this->NoDataValue);
  one("PassFieldArrays", this->PassFieldArrays);
  one("Device", this->Device);
  one("DeviceIndex", this->DeviceIndex);
  one("DeviceName", this->DeviceName ? this->DeviceName : "(none)");
  one("NumberOfThreads", this->NumberOfThreads);
  one("NumberOfInputPieces", this->NumberOfInputPieces);
  one("GatherOnRoot", this->GatherOnRoot);
  os << indent << "Controller: " << this->Controller << "\n";
  os << indent << "PointDataArraySelection:\n";
  this->PointDataArraySelection->PrintSelf(os, indent.GetNextIndent());
  os << indent << "CellDataArraySelection:\n";
  this->CellDataArraySelection->PrintSelf(os, indent.GetNextIndent());
}

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRangeResampleFilter.h"

#include "Messages/Postbox.h"
#include "OpenCL/DeviceList.h"
#include "Output/Monitor.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Stopwatch.h"
#include "Resample/ExchangeSamples.h"
#include "Resample/ImageOutput.h"
#include "Resample/SampledImage.h"
#include "Resample/SamplingRange.h"
#include "Resample/UpdatedInput.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
#include "vtkExecutive.h"
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

#include <algorithm>
#include <exception>
#include <memory>
#include <stdexcept>

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

/// What to do where memory is short is another thing here than for a triangulation.
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

/// Asks the input for a piece of all ranks' pieces.
void askForPiece(vtkInformation* inInfo, int piece, int pieces)
{
  inInfo->Remove(Pipeline::UPDATE_EXTENT());
  if (inInfo->Has(Pipeline::WHOLE_EXTENT())) // a structured grid
  {
    inInfo->Set(Pipeline::UPDATE_EXTENT(), inInfo->Get(Pipeline::WHOLE_EXTENT()), 6);
  }
  inInfo->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
  inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
}

/// The meshes of the input; none if it has no data yet.
std::vector<vtkPointSet*> meshesIn(vtkInformationVector* input)
{
  vtkDataObject* const data = vtkDataObject::GetData(input);
  return data ? tipp::meshesOf(data) : std::vector<vtkPointSet*>();
}

} // namespace

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
  tipp::SamplingSettings settings(bool merging) const;
  void warn(const tipp::SampledImage& image) const;
  void warnOfMissing(tipp::SampledImage& image, vtkDataArraySelection* selection, bool ofCells);

  vtkRangeResampleFilter* Filter;
  tipp::Postbox& Ranks;
  tipp::Monitor Progress;
  int Piece = 0;
  bool Stopped = false;
  std::exception_ptr Problem;
  tipp::Lattice Wanted; ///< of this rank
  std::unique_ptr<tipp::SampledImage> Image;
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
  settings.Threads = tipp::threadCount(filter->NumberOfThreads);
  settings.Merging = merging;
  return settings;
}

void vtkRangeResampleFilter::Run::start(vtkInformationVector* input, vtkInformation* outInfo)
{
  this->Ranks.together(
    [&]
    {
      if (this->Filter->UseInputBounds && this->Filter->NumberOfInputPieces > 1)
      {
        throw std::runtime_error("with NumberOfInputPieces above 1 the bounds of the input are not "
                                 "known in time: turn UseInputBounds off, set SamplingBounds.");
      }
      withMemoryAdvice([&] { this->makeImage(meshesIn(input), outInfo); });
    });
}

void vtkRangeResampleFilter::Run::makeImage(
  const std::vector<vtkPointSet*>& meshes, vtkInformation* outInfo)
{
  vtkRangeResampleFilter* const filter = this->Filter;
  const std::array<double, 6> bounds =
    filter->UseInputBounds ? tipp::boundsOf(meshes, this->Ranks) : toArray(filter->SamplingBounds);
  this->Wanted = tipp::rangeLattice(
    bounds, filter->Dimensions(bounds, meshes, this->Ranks), toArray(filter->Delta));
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
  }
  tipp::Lattice local = this->Wanted;
  if (this->severalRanks())
  {
    local.Extent = whole;
    local = filter->NumberOfInputPieces == 1 ? tipp::cropped(local, meshes, axes) : local;
  }
  const bool merging = this->severalRanks() || filter->NumberOfInputPieces > 1 || meshes.size() > 1;
  tipp::SamplingSettings settings = this->settings(merging);
  settings.Axes = axes;
  tipp::refuseTooLarge(local, this->Wanted, this->severalRanks(), meshes, settings);
  this->Image = std::make_unique<tipp::SampledImage>(local, settings);
}

void vtkRangeResampleFilter::Run::addPieces(vtkInformationVector* input)
{
  const int count = this->Filter->NumberOfInputPieces;
  vtkAlgorithmOutput* const source = this->Filter->GetInputConnection(0, 0);
  for (; this->Piece < count; ++this->Piece)
  {
    bool read = true;
    if (this->Piece > 0)
    {
      askForPiece(input->GetInformationObject(0), this->Ranks.rank() * count + this->Piece,
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
        withMemoryAdvice([&] { this->add(meshesIn(input)); });
      }
      catch (const std::exception&)
      {
        this->Problem = std::current_exception();
      }
    }
    // Sources may need all ranks to ask.
    if ((this->Problem || this->Stopped) && !this->severalRanks())
    {
      return;
    }
  }
}

void vtkRangeResampleFilter::Run::add(const std::vector<vtkPointSet*>& meshes)
{
  for (std::size_t i = 0; i < meshes.size() && !this->Stopped; ++i)
  {
    const auto report = [&](double done)
    {
      const double ofPiece = (double(i) + done) / double(meshes.size());
      return this->Progress((this->Piece + ofPiece) / this->Filter->NumberOfInputPieces);
    };
    this->Stopped = !this->Image->add(meshes[i], report);
  }
}

void vtkRangeResampleFilter::Run::finish(vtkImageData* output)
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

void vtkRangeResampleFilter::Run::makeOutput(vtkImageData* output)
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
  report.ExchangeSeconds = watch.restart();
  this->warn(*this->Image);
  report.Threads = this->settings(true).Threads;
  report.Hits = tipp::fillImage(*image, report.Threads, output);
  report.Samples = image->samples();
  report.OutputSeconds = watch.restart();
  tipp::fillTable(report, this->Filter->Statistics);
  this->warnOfMissing(*image, this->Filter->PointDataArraySelection, false);
  this->warnOfMissing(*image, this->Filter->CellDataArraySelection, true);
}

void vtkRangeResampleFilter::Run::warn(const tipp::SampledImage& image) const
{
  for (const std::string& warning : image.warnings())
  {
    vtkWarningWithObjectMacro(this->Filter, << warning);
  }
}

void vtkRangeResampleFilter::Run::warnOfMissing(
  tipp::SampledImage& image, vtkDataArraySelection* selection, bool ofCells)
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
std::array<int, 3> vtkRangeResampleFilter::Dimensions(const std::array<double, 6>& bounds,
  const std::vector<vtkPointSet*>& meshes, tipp::Postbox& ranks) const
{
  const std::array<int, 3> given = toArray(this->SamplingDimensions);
  if (std::count(given.begin(), given.end(), 0) == 0)
  {
    return given;
  }
  return tipp::chosenDimensions(bounds, given, tipp::areSurfaces(meshes, ranks));
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
    std::array<int, 3> dimensions = toArray(this->SamplingDimensions);
    if (chosen || (byDelta && this->UseInputBounds))
    {
      if (this->NumberOfInputPieces > 1)
      {
        throw std::runtime_error(
          "with NumberOfInputPieces above 1 the input is not known in time: turn UseInputBounds "
          "off, set SamplingBounds, and give SamplingDimensions a number along every axis.");
      }
      tipp::Postbox ranks(this->Controller);
      vtkDataObject* const input = tipp::updatedInput(this, ranks.rank(), ranks.size(), outInfo);
      ranks.together(
        [&]
        {
          if (!input)
          {
            throw std::runtime_error("the input has not been made, so its extent is not known.");
          }
          const std::vector<vtkPointSet*> meshes = tipp::meshesOf(input);
          bounds = this->UseInputBounds ? tipp::boundsOf(meshes, ranks) : bounds;
          dimensions = this->Dimensions(bounds, meshes, ranks);
        });
    }
    tipp::Lattice lattice = tipp::rangeLattice(bounds, dimensions, delta);
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
  const bool several = this->Controller && this->Controller->GetNumberOfProcesses() > 1;
  const int count = this->NumberOfInputPieces;
  askForPiece(inputs[0]->GetInformationObject(0),
    several ? this->Controller->GetLocalProcessId() * count : 0,
    several ? this->Controller->GetNumberOfProcesses() * count : count);
  return 1;
}

int vtkRangeResampleFilter::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* const outInfo = outputs->GetInformationObject(0);
  vtkImageData* const output = vtkImageData::GetData(outInfo);
  output->Initialize();
  try
  {
    tipp::Postbox ranks(this->Controller);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRangeResampleFilter.h"

#include "OpenCL/Devices.h"
#include "Output/FilterPipeline.h"
#include "Ranks/Communicator.h"
#include "Sampling/SamplingRange.h"

#include "vtkCommand.h"
#include "vtkDataArraySelection.h"
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
#include <stdexcept>

vtkStandardNewMacro(vtkRangeResampleFilter);
vtkCxxSetObjectMacro(vtkRangeResampleFilter, Controller, vtkMultiProcessController);

using Pipeline = vtkStreamingDemandDrivenPipeline;

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
    this->SetDevice(int(choice.Kind));
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

/// SamplingDimensions, with zeros replaced by the chosen numbers.
std::array<int, 3> vtkRangeResampleFilter::Dimensions(const std::array<double, 6>& bounds,
  const std::vector<vtkPointSet*>& meshes, tipp::Communicator& ranks) const
{
  const std::array<int, 3> given = tipp::toArray(this->SamplingDimensions);
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
    const std::array<double, 3> delta = tipp::toArray(this->Delta);
    const bool byDelta = delta[0] > 0 || delta[1] > 0 || delta[2] > 0;
    // Bounds are not needed if all SamplingDimensions are given; any valid ones will do.
    std::array<double, 6> bounds = this->UseInputBounds ? std::array<double, 6>{ 0, 1, 0, 1, 0, 1 }
                                                        : tipp::toArray(this->SamplingBounds);
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
  tipp::askForPiece(inputs[0]->GetInformationObject(0),
    several ? this->Controller->GetLocalProcessId() * count : 0,
    several ? this->Controller->GetNumberOfProcesses() * count : count);
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
  one("SampleElevation", this->SampleElevation);
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

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPResampleSeries.h"

#include "Parallel/ParallelFor.h"
#include "Pipeline/FilterPipeline.h"
#include "Series/SampleSeries.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>

vtkStandardNewMacro(vtkTIPPResampleSeries);

namespace
{

template <typename Array, typename Values>
void addField(vtkTable* table, const char* name, const Values& values)
{
  const vtkNew<Array> array;
  array->SetName(name);
  for (const auto& value : values)
  {
    array->InsertNextValue(value);
  }
  table->GetFieldData()->AddArray(array);
}

void addText(vtkTable* table, const char* name, const std::string& text)
{
  addField<vtkStringArray>(table, name, std::vector<std::string>{ text });
}

/// Adds the samples of a field: a component for each of `steps` steps.
void addColumn(vtkTable* table, const std::string& name, std::vector<float>& samples, int steps)
{
  const vtkNew<vtkFloatArray> column;
  column->SetName(name.c_str());
  column->SetNumberOfComponents(steps);
  const auto rows = vtkIdType(samples.size() / std::size_t(steps));
  column->SetNumberOfTuples(rows);
  float* const to = column->GetPointer(0);
  tipp::parallelFor(rows, 0,
    [&](std::int64_t row)
    {
      for (std::int64_t step = 0; step < steps; ++step)
      {
        to[row * steps + step] = samples[std::size_t(step * rows + row)];
      }
    });
  std::vector<float>().swap(samples);
  table->AddColumn(column);
}

void addGrid(vtkTable* table, const tipp::Lattice& grid)
{
  addField<vtkDoubleArray>(table, "Origin", std::vector<double>{ grid.Min[0], grid.Min[1] });
  addField<vtkDoubleArray>(table, "Spacing", std::vector<double>{ grid.Delta[0], grid.Delta[1] });
  addField<vtkIntArray>(
    table, "Dimensions", std::vector<int>{ int(grid.size(0)), int(grid.size(1)) });
}

void fill(vtkTable* table, tipp::SampledSeries& series)
{
  const tipp::SeriesDescription& description = series.Description;
  addGrid(table, description.Grid);
  addField<vtkIntArray>(table, "Steps", std::vector<int>(series.Steps.begin(), series.Steps.end()));
  addField<vtkDoubleArray>(table, "Times", description.Times);
  addText(table, "TimeUnits", description.TimeUnits);
  addText(table, "Calendar", description.Calendar);
  addText(table, "ReferenceSystem", series.Wkt.empty() ? description.Crs : series.Wkt);
  std::vector<std::string> longNames;
  std::vector<std::string> standardNames;
  std::vector<std::string> units;
  std::vector<int> varies;
  for (std::size_t i = 0; i < description.Fields.size(); ++i)
  {
    const tipp::SeriesField& field = description.Fields[i];
    longNames.push_back(field.LongName);
    standardNames.push_back(field.StandardName);
    units.push_back(field.Units);
    varies.push_back(field.Varies ? 1 : 0);
    addColumn(
      table, field.Name, series.Samples[i], field.Varies ? int(description.Times.size()) : 1);
  }
  addField<vtkStringArray>(table, "LongNames", longNames);
  addField<vtkStringArray>(table, "StandardNames", standardNames);
  addField<vtkStringArray>(table, "Units", units);
  addField<vtkIntArray>(table, "Varies", varies);
}

} // namespace

vtkTIPPResampleSeries::vtkTIPPResampleSeries()
{
  this->SetNumberOfInputPorts(0);
}

int vtkTIPPResampleSeries::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkTable* const output = vtkTable::GetData(outputs);
  output->Initialize();
  return tipp::runReported(this, nullptr, "", outputs, [&] { this->Execute(output); });
}

void vtkTIPPResampleSeries::Execute(vtkTable* output)
{
  if (this->FileName.empty())
  {
    throw std::invalid_argument(
      "FileName is not set; name the output of a model, or a flat or partitioned mesh.");
  }
  tipp::SeriesRequest request;
  request.Arrays = this->Arrays;
  request.Step = this->Steps;
  request.Reduce = this->Reductions;
  request.WithSteps = this->WithSteps;
  request.Waterline = this->Waterline;
  request.Threads = this->NumberOfThreads;
  if (this->UseNoDataValue)
  {
    request.NoData = this->NoDataValue;
  }
  tipp::SeriesRange range;
  if (this->UseBounds)
  {
    range.Bounds = tipp::boxOfVtkBounds<2>(this->Bounds);
  }
  range.Dimensions = { this->SamplingDimensions[0], this->SamplingDimensions[1] };
  range.Delta = { this->Delta[0], this->Delta[1] };
  tipp::Monitor monitor(this);
  std::optional<tipp::SampledSeries> series =
    tipp::sampleSeries(this->FileName, { this->ValuesFileNames, this->Wrap }, request, range,
      this->ReferenceSystem, [&monitor](double fraction) { return monitor(fraction); });
  if (series)
  {
    tipp::warn(this, series->Warnings);
    fill(output, *series);
  }
}

void vtkTIPPResampleSeries::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(FileName);
  vtkTIPPPrintMacro(ValuesFileNames);
  vtkTIPPPrintMacro(Wrap);
  vtkTIPPPrintMacro(UseBounds);
  vtkTIPPPrintMacro(Bounds);
  vtkTIPPPrintMacro(SamplingDimensions);
  vtkTIPPPrintMacro(Delta);
  vtkTIPPPrintMacro(Steps);
  vtkTIPPPrintMacro(Arrays);
  vtkTIPPPrintMacro(Reductions);
  vtkTIPPPrintMacro(WithSteps);
  vtkTIPPPrintMacro(Waterline);
  vtkTIPPPrintMacro(ReferenceSystem);
  vtkTIPPPrintMacro(UseNoDataValue);
  vtkTIPPPrintMacro(NoDataValue);
  vtkTIPPPrintMacro(NumberOfThreads);
}

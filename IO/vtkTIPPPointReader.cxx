// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTIPPPointReader.h"

#include "Files/IOError.h"
#include "Meshes/MeshFiles.h"
#include "Points/ReadPoints.h"
#include "Points/TableColumns.h"

#include "vtkCellArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <sstream>

vtkStandardNewMacro(vtkTIPPPointReader);

namespace
{

std::vector<std::string> partsOf(const std::string& text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');)
  {
    parts.push_back(part);
  }
  return parts;
}

int classOf(const std::string& text)
{
  const std::optional<int> number = tipp::LasSelection::parseClass(text);
  return number
    ? *number
    : throw tipp::IOError("'" + text + "' is not a class; give numbers from 0 to 255, as 2,9.");
}

void addVertices(vtkPolyData* data)
{
  vtkNew<vtkCellArray> vertices;
  vertices->AllocateExact(data->GetNumberOfPoints(), data->GetNumberOfPoints());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    vertices->InsertNextCell(1, &i);
  }
  data->SetVerts(vertices);
}

} // namespace

vtkTIPPPointReader::vtkTIPPPointReader()
{
  this->SetNumberOfInputPorts(0);
}

int vtkTIPPPointReader::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  outputVector->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

std::string vtkTIPPPointReader::FindCoordinates(vtkStringArray* names, int columns[3])
{
  std::fill_n(columns, 3, -1);
  try
  {
    std::vector<std::string> texts;
    for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
    {
      texts.push_back(names->GetValue(i));
    }
    const tipp::ColumnChoice choice = tipp::requireCoordinates(texts);
    columns[0] = int(choice.X);
    columns[1] = int(choice.Y);
    columns[2] = choice.Z ? int(*choice.Z) : -1;
    return {};
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
}

tipp::PointOptions vtkTIPPPointReader::Options() const
{
  tipp::PointOptions options;
  options.X = this->XColumn;
  options.Y = this->YColumn;
  options.Z = this->ZColumn;
  options.Layer = this->Layer;
  options.Crs = this->CoordinateReferenceSystem;
  options.Threads = 0;
  for (const std::string& number : partsOf(this->Classes))
  {
    options.Las.Classes.push_back(classOf(number));
  }
  options.Las.Kind = tipp::LasSelection::Returns(this->Returns);
  options.Las.KeepWithheld = this->KeepWithheld;
  options.Las.KeepSynthetic = this->KeepSynthetic;
  options.Las.KeepOverlap = this->KeepOverlap;
  options.Las.KeepTruncated = this->KeepTruncated;
  options.Las.KeepUncounted = this->KeepUncounted;
  if (!(this->Bounds[0] > this->Bounds[1]))
  {
    options.Region = tipp::boxOfVtkBounds<2>(this->Bounds);
    if (options.Region->isEmpty())
    {
      throw tipp::IOError(
        "Bounds are no range; set xmin <= xmax and ymin <= ymax, or xmin > xmax for all points.");
    }
  }
  options.Spacing = this->Spacing;
  if (!this->Columns.empty())
  {
    options.Columns = partsOf(this->Columns);
    options.Columns->insert(options.Columns->end(), { "z", "Z" });
  }
  return options;
}

void vtkTIPPPointReader::Read(vtkInformation* info, vtkPolyData* output)
{
  if (this->FileNames.empty())
  {
    throw tipp::IOError("There is no file name; set one.");
  }
  const int piece = std::max(0, info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()));
  const int pieces =
    std::max(1, info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES()));
  const tipp::PointTable table =
    tipp::readPointsShare(this->FileNames, this->Options(), piece, pieces);
  this->NumberOfPointsLeftOut = table.LeftOut;
  this->HasHeights = std::any_of(table.Columns.begin(), table.Columns.end(),
    [](const tipp::PointTable::Column& column)
    { return column.Name == "z" || column.Name == "Z"; });
  for (const tipp::TableReport& report : table.Reports)
  {
    for (const std::string& warning : report.Warnings)
    {
      vtkWarningMacro(<< report.Path << ": " << warning);
    }
  }
  // A deep copy, because the arrays share the table's memory.
  output->DeepCopy(tipp::makePolyData(table, {}));
  if (this->GenerateVertices)
  {
    addVertices(output);
  }
  if (!table.CrsProblem.empty())
  {
    vtkWarningMacro(<< table.CrsProblem << ".");
  }
  if (!table.Crs.empty())
  {
    vtkNew<vtkStringArray> array;
    array->SetName("CoordinateReferenceSystem");
    array->InsertNextValue(table.Crs);
    output->GetFieldData()->AddArray(array);
  }
}

int vtkTIPPPointReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* const output = vtkPolyData::GetData(outputVector, 0);
  try
  {
    this->Read(outputVector->GetInformationObject(0), output);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    vtkErrorMacro("There is not enough memory for the points; read fewer files or columns.");
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
  output->Initialize();
  return 0;
}

void vtkTIPPPointReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkTIPPPrintMacro(FileNames);
  vtkTIPPPrintMacro(XColumn);
  vtkTIPPPrintMacro(YColumn);
  vtkTIPPPrintMacro(ZColumn);
  vtkTIPPPrintMacro(Layer);
  vtkTIPPPrintMacro(CoordinateReferenceSystem);
  vtkTIPPPrintMacro(Classes);
  vtkTIPPPrintMacro(Columns);
  vtkTIPPPrintMacro(Bounds);
  vtkTIPPPrintMacro(Spacing);
  vtkTIPPPrintMacro(Returns);
  vtkTIPPPrintMacro(KeepWithheld);
  vtkTIPPPrintMacro(KeepSynthetic);
  vtkTIPPPrintMacro(KeepOverlap);
  vtkTIPPPrintMacro(KeepTruncated);
  vtkTIPPPrintMacro(KeepUncounted);
  vtkTIPPPrintMacro(GenerateVertices);
  vtkTIPPPrintMacro(NumberOfPointsLeftOut);
  vtkTIPPPrintMacro(HasHeights);
}

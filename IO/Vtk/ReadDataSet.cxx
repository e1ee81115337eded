// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/ReadDataSet.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Vtk/VtkMessages.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetReader.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkOutputWindow.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkSTLReader.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLPImageDataReader.h"
#include "vtkXMLPPolyDataReader.h"
#include "vtkXMLPRectilinearGridReader.h"
#include "vtkXMLPStructuredGridReader.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLRectilinearGridReader.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"

#include <atomic>
#include <filesystem>
#include <map>
#include <stdexcept>

#if __has_include("vtkCellTypeUtilities.h") // VTK 9.6
#include "vtkCellTypeUtilities.h"
#else
#include "vtkCellTypes.h"
#endif

namespace tipp
{
namespace
{

/// Captures what VTK would print: readers use internal objects whose errors they do not forward.
class ErrorWindow
{
public:
  explicit ErrorWindow(ErrorKeeper* errors)
    : Before(vtkOutputWindow::GetInstance())
    , Verbosity(vtkLogger::GetCurrentVerbosityCutoff())
  {
    // VTK's log prints all errors as well, independently of the window.
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
    const auto window = vtkSmartPointer<Window>::New();
    window->Errors = errors;
    vtkOutputWindow::SetInstance(window);
  }
  ~ErrorWindow()
  {
    vtkOutputWindow::SetInstance(this->Before);
    vtkLogger::SetStderrVerbosity(this->Verbosity);
  }
  ErrorWindow(const ErrorWindow&) = delete;
  ErrorWindow& operator=(const ErrorWindow&) = delete;

private:
  class Window : public vtkOutputWindow
  {
  public:
    static Window* New()
    {
      auto* const window = new Window;
      window->InitializeObjectBase();
      return window;
    }
    void DisplayText(const char*) override {}
    void DisplayErrorText(const char* text) override { this->keep(vtkCommand::ErrorEvent, text); }
    void DisplayWarningText(const char* text) override
    {
      this->keep(vtkCommand::WarningEvent, text);
    }

    vtkSmartPointer<ErrorKeeper> Errors;

  private:
    void keep(unsigned long event, std::string text)
    {
      this->Errors->Execute(nullptr, event, text.data());
    }
  };

  vtkSmartPointer<vtkOutputWindow> Before;
  vtkLogger::Verbosity Verbosity;
};

using ReadFunction = vtkSmartPointer<vtkDataSet> (*)(const std::string&);

template <typename Reader>
vtkSmartPointer<vtkDataSet> readWith(const std::string& path)
{
  vtkNew<Reader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return vtkDataSet::SafeDownCast(reader->GetOutputDataObject(0));
}

const std::map<std::string, ReadFunction>& readFunctions()
{
  static const std::map<std::string, ReadFunction> functions = {
    { ".obj", readWith<vtkOBJReader> },
    { ".ply", readWith<vtkPLYReader> },
    { ".pvti", readWith<vtkXMLPImageDataReader> },
    { ".pvtp", readWith<vtkXMLPPolyDataReader> },
    { ".pvtr", readWith<vtkXMLPRectilinearGridReader> },
    { ".pvts", readWith<vtkXMLPStructuredGridReader> },
    { ".pvtu", readWith<vtkXMLPUnstructuredGridReader> },
    { ".stl", readWith<vtkSTLReader> },
    { ".vti", readWith<vtkXMLImageDataReader> },
    { ".vtk", readWith<vtkDataSetReader> },
    { ".vtp", readWith<vtkXMLPolyDataReader> },
    { ".vtr", readWith<vtkXMLRectilinearGridReader> },
    { ".vts", readWith<vtkXMLStructuredGridReader> },
    { ".vtu", readWith<vtkXMLUnstructuredGridReader> },
  };
  return functions;
}

std::atomic<const char*> currentFile{ nullptr };

/// Registers the file being read.
class CurrentFile
{
public:
  explicit CurrentFile(const std::string& path) { currentFile = path.c_str(); }
  ~CurrentFile() { currentFile = nullptr; }
  CurrentFile(const CurrentFile&) = delete;
  CurrentFile& operator=(const CurrentFile&) = delete;
};

} // namespace

const char* fileBeingRead()
{
  return currentFile;
}

bool isVtkFile(const std::string& path)
{
  return readFunctions().count(extensionOf(path)) != 0;
}

vtkSmartPointer<vtkDataSet> readDataSet(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw IOError(path, "is not a file that can be read; check the name.");
  }
  vtkNew<ErrorKeeper> errors;
  const auto read = readFunctions().find(extensionOf(path));
  if (read == readFunctions().end())
  {
    refuseKind(path, "is of a kind that VTK's readers here do not know.");
  }
  checkVtkFile(path);
  const CurrentFile current(path);
  const ErrorWindow window(errors);
  vtkSmartPointer<vtkDataSet> data;
  try
  {
    data = read->second(path);
  }
  catch (const std::length_error&) // thrown if a reader resizes a vector to an absurd size
  {
    errors->HasError = true;
    errors->Messages = { "a count in it is too large" };
  }
  if (errors->HasError || !data)
  {
    std::string reason = errors->message();
    reason.erase(reason.find_last_not_of(". ") + 1);
    reason = reason.empty() ? "no data set in it" : reason;
    throw IOError(path,
      "cannot be read as a VTK file (" + reason +
        "); check that it is whole and that its extension is right.");
  }
  checkDataSet(data, path);
  return data;
}

std::string cellTypeName(int type)
{
#if __has_include("vtkCellTypeUtilities.h")
  return vtkCellTypeUtilities::GetClassNameFromTypeId(type);
#else
  return vtkCellTypes::GetClassNameFromTypeId(type);
#endif
}

namespace
{

void addArray(vtkDataArray* array, std::size_t points, PointTable& table)
{
  const int components = array->GetNumberOfComponents();
  const std::string name = array->GetName() ? array->GetName() : "array";
  for (int component = 0; component < components; ++component)
  {
    PointTable::Column column;
    column.Name = components == 1 ? name : name + "_" + std::to_string(component);
    column.Values.resize(points);
    for (std::size_t i = 0; i < points; ++i)
    {
      column.Values[i] = array->GetComponent(vtkIdType(i), component);
    }
    table.Columns.push_back(std::move(column));
  }
}

} // namespace

PointTable pointsOf(vtkDataSet* data)
{
  const auto count = std::size_t(data->GetNumberOfPoints());
  PointTable table;
  table.XY.resize(2 * count);
  table.Columns.push_back({ "z", std::vector<double>(count) });
  for (std::size_t i = 0; i < count; ++i)
  {
    double p[3];
    data->GetPoint(vtkIdType(i), p);
    table.XY[2 * i] = p[0];
    table.XY[2 * i + 1] = p[1];
    table.Columns[0].Values[i] = p[2];
  }
  vtkPointData* const attributes = data->GetPointData();
  for (int i = 0; i < attributes->GetNumberOfArrays(); ++i)
  {
    // A string array is not a vtkDataArray.
    if (vtkDataArray* const array = attributes->GetArray(i))
    {
      addArray(array, count, table);
    }
  }
  return table;
}

PointTable readVtkPoints(const std::string& path)
{
  return pointsOf(readDataSet(path));
}

} // namespace tipp

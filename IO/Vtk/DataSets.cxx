// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/DataSets.h"

#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/TextFile.h"
#include "Files/VtkXml.h"
#include "Vtk/ReadVtkHdf.h"

#include "vtkAbstractArray.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetReader.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkOBJReader.h"
#include "vtkOutputWindow.h"
#include "vtkPLYReader.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkSTLReader.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLImageDataReader.h"
#include "vtkXMLImageDataWriter.h"
#include "vtkXMLPImageDataReader.h"
#include "vtkXMLPPolyDataReader.h"
#include "vtkXMLPRectilinearGridReader.h"
#include "vtkXMLPStructuredGridReader.h"
#include "vtkXMLPUnstructuredGridReader.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"
#include "vtkXMLRectilinearGridReader.h"
#include "vtkXMLStructuredGridReader.h"
#include "vtkXMLUnstructuredGridReader.h"
#include "vtkXMLUnstructuredGridWriter.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <filesystem>
#include <map>
#include <regex>
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

/// The readers by extension. The table of formats (Files/Formats.cxx) has the same extensions.
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
    { ".vtkhdf", readVtkHdf },
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

vtkSmartPointer<vtkPointSet> readPointSet(const std::string& path)
{
  const vtkSmartPointer<vtkDataSet> data = readDataSet(path);
  vtkPointSet* const points = vtkPointSet::SafeDownCast(data);
  if (!points)
  {
    throw IOError(path,
      std::string("holds a ") + data->GetClassName() +
        ", which stores no points; convert it with 'tipp flatten'.");
  }
  removeGhostCells(points);
  return points;
}

void removeGhostCells(vtkDataSet* data)
{
  if (!data->HasAnyGhostCells())
  {
    return;
  }
  if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(data))
  {
    grid->RemoveGhostCells();
  }
  else if (auto* const surface = vtkPolyData::SafeDownCast(data))
  {
    surface->RemoveGhostCells();
  }
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

/// Extracts the message from VTK's "ERROR: In file, line n\nclass (address): message\n\n", on one
/// line.
std::string plainMessage(const std::string& text)
{
  static const std::regex header("^(ERROR|Warning|Generic Warning): In .*, line [0-9]+\n");
  static const std::regex object("^[A-Za-z_]\\w* \\((0x)?[0-9a-fA-F]+\\): ");
  static const std::regex address(" ?\\((0x)?[0-9a-fA-F]{6,}\\)");
  std::string message = std::regex_replace(text, header, "");
  message = std::regex_replace(message, object, "");
  message.erase(std::min(message.find('\n'), message.size()));
  message = onOneLine(std::regex_replace(message, address, ""));
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())) != 0)
  {
    message.pop_back();
  }
  return message;
}

} // namespace

void ErrorKeeper::Execute(vtkObject*, unsigned long event, void* text)
{
  this->HasError = this->HasError || event == vtkCommand::ErrorEvent;
  const std::string message = plainMessage(text ? static_cast<const char*>(text) : "");
  // The pipeline's own message adds nothing to the error before it.
  const bool isEcho = message.find("returned failure for request") != std::string::npos;
  if (!message.empty() && !isEcho)
  {
    this->Messages.push_back(message);
  }
}

std::set<std::string> arrayNames(vtkFieldData* data)
{
  std::set<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const char* const name = data->GetAbstractArray(i)->GetName();
    if (name && *name)
    {
      names.insert(name);
    }
  }
  return names;
}

namespace
{

/// A VTK XML writer that writes to our stream: with its own stream it would not notice if closing
/// the file fails because the disk is full.
template <typename Writer>
class StreamWriter : public Writer
{
public:
  static vtkSmartPointer<vtkXMLWriter> make(std::ostream& to)
  {
    auto* const writer = new StreamWriter(to);
    writer->InitializeObjectBase();
    return vtkSmartPointer<vtkXMLWriter>::Take(writer);
  }

protected:
  int StartFile() override
  {
    this->To.precision(11); // the precision of the writer's own files
    this->Stream = &this->To;
    return this->Writer::StartFile();
  }

private:
  explicit StreamWriter(std::ostream& to)
    : To(to)
  {
    this->WriteToOutputStringOn(); // so that it opens no file
  }

  std::ostream& To;
};

vtkSmartPointer<vtkXMLWriter> writerOf(vtkDataObject* data, std::ostream& to)
{
  if (vtkPolyData::SafeDownCast(data))
  {
    return StreamWriter<vtkXMLPolyDataWriter>::make(to);
  }
  if (vtkImageData::SafeDownCast(data))
  {
    return StreamWriter<vtkXMLImageDataWriter>::make(to);
  }
  return StreamWriter<vtkXMLUnstructuredGridWriter>::make(to);
}

/// Whether VTK's writer escapes special characters in names; some versions do not.
bool doesVtkEscape()
{
  static const bool does = []
  {
    vtkNew<vtkFloatArray> array;
    array->SetName("&");
    vtkNew<vtkPolyData> data;
    data->GetFieldData()->AddArray(array);
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetInputData(data);
    writer->WriteToOutputStringOn();
    writer->Write();
    return writer->GetOutputString().find("\"&\"") == std::string::npos;
  }();
  return does;
}

/// The text in UTF-8 without the control characters that XML does not have.
std::string xmlText(const std::string& text)
{
  std::string result = utf8Of(text);
  std::replace_if(
    result.begin(), result.end(),
    [](char c)
    { return static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r'; },
    '?');
  return result;
}

/// While it exists, the names of a data set's arrays are such that VTK's writer makes well-formed
/// XML of them.
class XmlNames
{
public:
  explicit XmlNames(vtkDataObject* data)
  {
    for (int type = 0; type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
    {
      vtkFieldData* const arrays = data->GetAttributesAsFieldData(type);
      for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
      {
        this->change(arrays->GetAbstractArray(i));
      }
    }
  }

  ~XmlNames()
  {
    for (const auto& [array, name] : this->Changed)
    {
      array->SetName(name.c_str());
    }
  }

  XmlNames(const XmlNames&) = delete;
  XmlNames& operator=(const XmlNames&) = delete;

private:
  void change(vtkAbstractArray* array)
  {
    const std::string name = array && array->GetName() ? array->GetName() : "";
    const std::string written = doesVtkEscape() ? xmlText(name) : escapedXml(name);
    if (written != name)
    {
      this->Changed.emplace_back(array, name);
      array->SetName(written.c_str());
    }
  }

  std::vector<std::pair<vtkSmartPointer<vtkAbstractArray>, std::string>> Changed;
};

} // namespace

bool writeXmlFile(const std::string& path, const std::optional<PathState>& before,
  vtkDataObject* data, const std::function<bool()>& isStopped)
{
  PendingFile pending(path, before);
  OutputStream stream(pending.file());
  const vtkSmartPointer<vtkXMLWriter> writer = writerOf(data, stream);
  vtkNew<ErrorKeeper> errors;
  const XmlNames names(data);
  writer->AddObserver(vtkCommand::ErrorEvent, errors);
  writer->SetInputData(data);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressorTypeToNone();
  writer->SetHeaderTypeToUInt64();
  const bool isWritten = writer->Write() != 0 && !errors->HasError;
  stream.finish();
  if (!isWritten)
  {
    throw IOError(path, "cannot be written by VTK's writer.");
  }
  if (isStopped && isStopped())
  {
    return false;
  }
  pending.commit();
  return true;
}

} // namespace tipp

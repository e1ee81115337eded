// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWriteXmlFile_h
#define tippWriteXmlFile_h

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/PendingOutput.h"
#include "Vtk/VtkMessages.h"

#include "vtkDataObject.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <optional>
#include <string>

namespace tipp
{

/// A VTK XML writer that writes to our stream: with its own stream it would not notice if closing
/// the file fails because the disk is full.
template <typename Writer>
class StreamWriter : public Writer
{
public:
  static vtkSmartPointer<StreamWriter> make(std::ostream& to)
  {
    auto* const writer = new StreamWriter(to);
    writer->InitializeObjectBase();
    return vtkSmartPointer<StreamWriter>::Take(writer);
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

/// Writes a file of a data set, raw and appended. `before` as for PendingFile. Returns false, and
/// publishes no file, if `isStopped` returns true at the end. Throws IOError.
template <typename Writer>
bool writeXmlFile(const std::string& path, const std::optional<PathState>& before,
  vtkDataObject* data, const std::function<bool()>& isStopped = {})
{
  PendingFile pending(path, before);
  OutputStream stream(pending.file());
  const auto writer = StreamWriter<Writer>::make(stream);
  vtkNew<ErrorKeeper> errors;
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

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDataSets_h
#define tippDataSets_h

#include "Files/PendingOutput.h"
#include "vtkTIPPIOModule.h"

#include "vtkCommand.h"
#include "vtkSmartPointer.h"

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

class vtkDataObject;
class vtkDataSet;
class vtkFieldData;
class vtkPointSet;

namespace tipp
{

/// Reads a data set with VTK's readers, and checks it by checkVtkFile() and checkDataSet(). Throws
/// IOError, with VTK's own message if a reader fails.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkDataSet> readDataSet(const std::string& path);

/// As readDataSet(), but without ghost cells, and throws IOError also for a data set that stores no
/// points, such as an image.
VTKTIPPIO_EXPORT vtkSmartPointer<vtkPointSet> readPointSet(const std::string& path);

/// Removes cells that are copies of another piece's, which would count twice.
VTKTIPPIO_EXPORT void removeGhostCells(vtkDataSet* data);

/// The file that readDataSet() is reading; null at other times. VTK's readers trust what they read,
/// so a damaged file can crash them; a program's signal handler can then name the file.
VTKTIPPIO_EXPORT const char* fileBeingRead();

/// Writes a vtkPolyData, vtkUnstructuredGrid or vtkImageData as a VTK XML file, raw and appended.
/// `before` as for PendingFile. Returns false, and publishes no file, if `isStopped` returns true
/// at the end. Throws IOError.
VTKTIPPIO_EXPORT bool writeXmlFile(const std::string& path, const std::optional<PathState>& before,
  vtkDataObject* data, const std::function<bool()>& isStopped = {});

/// Reads the headers in a VTK file, XML or legacy, and throws IOError if they give counts that the
/// file's size cannot hold: VTK's readers would allocate that much memory, or loop that often. Of a
/// parallel file its pieces' files are checked, too. The cells of a legacy file before version 5
/// are traversed, because VTK does not check their counts. Files of other kinds are accepted.
VTKTIPPIO_EXPORT void checkVtkFile(const std::string& path);

/// Checks of VTK data sets. Every data set, from a file or from a pipeline, must pass one of them
/// before its ids are used. They throw IOError with one sentence that begins with `name`: a file,
/// or "the input".
/// @{ Checks the points, and that no point array has fewer tuples than there are points.
VTKTIPPIO_EXPORT void checkPoints(vtkDataSet* data, const std::string& name);

/// Checks the cells: offsets ascend and end within the vertex ids, types are known and fit the
/// number of vertices, and all ids are of points that exist. A data set that has not been modified
/// since its last check is not checked again. `threads` = 0: usualThreads().
VTKTIPPIO_EXPORT void checkCells(vtkDataSet* data, const std::string& name, int threads = 0);

/// Checks points and cells, and that no cell array has fewer tuples than there are cells.
VTKTIPPIO_EXPORT void checkDataSet(vtkDataSet* data, const std::string& name, int threads = 0);
///@}

/// Whether all coordinates are finite. A positive result is cached as by checkCells().
VTKTIPPIO_EXPORT bool allPointsFinite(vtkDataSet* data, int threads = 0);

/// Observes ErrorEvent and WarningEvent: collects the messages instead of printing them, without
/// the prefix of source file, line, class and address.
class VTKTIPPIO_EXPORT ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }

  void Execute(vtkObject*, unsigned long event, void* text) override;

  /// The first message, which is the most specific; empty if there was none.
  std::string message() const { return this->Messages.empty() ? "" : this->Messages.front(); }

  bool HasError = false;
  std::vector<std::string> Messages;
};

/// The names of the arrays; unnamed ones are skipped.
VTKTIPPIO_EXPORT std::set<std::string> arrayNames(vtkFieldData* data);

} // namespace tipp

#endif

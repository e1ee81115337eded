// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFilterPipeline_h
#define tippFilterPipeline_h

#include "Triangulation/Triangulate.h"
#include "Vtk/Compatibility.h"
#include "vtkTIPPFiltersModule.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataPipeline.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <initializer_list>
#include <string>
#include <thread>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;
class vtkMultiProcessController;
class vtkPointSet;
class vtkTable;

namespace tipp
{

struct RunStatistics;

/// Reports progress to an algorithm and returns whether to continue; callable from any thread.
/// Observers are called only in the thread that constructed this object.
class Monitor
{
public:
  explicit Monitor(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
    , Owner(std::this_thread::get_id())
  {
  }

  /// Reports the finished fraction (0 to 1). Returns false if the work must stop.
  bool operator()(double fraction)
  {
    constexpr double share = 0.95; // the rest is for making the output
    if (std::this_thread::get_id() == this->Owner)
    {
      this->Done = std::max(this->Done, share * fraction);
      this->Algorithm->UpdateProgress(this->Done);
      this->Stopped = abortRequested(this->Algorithm);
    }
    return !this->Stopped;
  }

private:
  vtkAlgorithm* Algorithm;
  std::thread::id Owner;
  double Done = 0;
  std::atomic<bool> Stopped{ false };
};

/// Throws std::runtime_error if a property, given by name and value, is NaN or infinite. The
/// setters' bounds do not exclude NaN.
void requireFinite(std::initializer_list<std::pair<const char*, double>> properties);

/// Issues warnings of a filter.
void warn(vtkAlgorithm* filter, const std::vector<std::string>& warnings);

/// Returns whether a filter with this controller works on several ranks. Null: it does not.
bool hasSeveralRanks(vtkMultiProcessController* controller);

/// Calls work(), and returns the result of RequestData(): 0 after an error, else 1. If work()
/// throws, empties the outputs, if any, and, unless the user has stopped the ranks, reports an
/// error of the filter, which begins with `prefix`. If `controller` has several ranks, only the
/// first one reports a RankFailure, with the rank's number. Throws nothing.
int runReported(vtkAlgorithm* filter, vtkMultiProcessController* controller,
  const std::string& prefix, vtkInformationVector* outputs, const std::function<void()>& work);

/// Does the same for a filter that triangulates the points of `input`: calls onRanks() if the
/// controller has several ranks, else alone(). The message begins with `doing` and the number of
/// points; if memory runs out, it gives advice. `threads` is the number of OpenMP threads within
/// the calls; 0: defaultThreads().
int triangulateReported(vtkAlgorithm* filter, vtkMultiProcessController* controller, int threads,
  const std::string& doing, vtkPointSet* input, vtkInformationVector* outputs,
  const std::function<void()>& alone, const std::function<void()>& onRanks);

/// Updates this rank's piece of a filter's input before the pipeline requests it, at the time step
/// that `outInfo` requests, if any. Returns null if the input fails; the filter owns the returned
/// object.
vtkDataObject* updatedInput(vtkAlgorithm* filter, int rank, int ranks, vtkInformation* outInfo);

/// Describes an input port in FillInputPortInformation(): data of the class `type`. Returns 1.
int acceptInput(vtkInformation* port, const char* type, bool isOptional = false);

/// Requests a piece of a filter's input; for structured data, the whole extent.
void askForUpdatePiece(vtkInformation* inInfo, int piece, int pieces);

/// Requests all of each input that is connected, in RequestUpdateExtent(). Returns 1.
int askForWholeInputs(vtkInformationVector** inputs, int ports);

/// Returns whether the controller has several ranks. If so, requests this rank's piece of each
/// input, without ghost cells: every rank contributes its share, whichever piece is requested of
/// the filter.
bool askForUpdatePieces(
  vtkMultiProcessController* controller, vtkInformationVector** inputs, int ports);

/// Returns whether ghost cells are requested of a filter's first output.
bool wantsGhosts(vtkInformationVector* outputs);

/// Fills an empty table: lists with IsTable become its columns, all else its field data. The
/// documentation of vtkTIPPDelaunay2D and vtkTIPPOutOfCoreDelaunay2D lists the arrays.
void fillStatisticsTable(const RunStatistics& statistics, vtkTable* table);

/// Adds this rank's duplicates and rejected points to the field data of `output`, as given: by
/// global ids.
void addDuplicatesAndRejected(const std::vector<Duplicate>& duplicates,
  const std::vector<PointId>& rejected, vtkDataObject* output);

/// The executive of a filter whose ranks execute together. If the upstream pipeline fails on one
/// rank, that rank would not execute, and the others would wait for it forever. So the ranks first
/// agree whether all can execute; otherwise the filter fails on all of them.
///
/// This costs one reduction per execution. All ranks must update the filter, which they must do
/// anyway.
class VTKTIPPFILTERS_EXPORT CollectivePipeline : public vtkCompositeDataPipeline
{
public:
  static CollectivePipeline* New();
  vtkTypeMacro(CollectivePipeline, vtkCompositeDataPipeline)

  /// Returns the filter's controller, or null; called before each execution.
  std::function<vtkMultiProcessController*()> Controller;

protected:
  CollectivePipeline() = default;
  ~CollectivePipeline() override = default;

  using vtkCompositeDataPipeline::ForwardUpstream;
  int ForwardUpstream(vtkInformation* request) override;

private:
  CollectivePipeline(const CollectivePipeline&) = delete;
  void operator=(const CollectivePipeline&) = delete;
};

/// Gives a filter a CollectivePipeline, unless the application has a default executive of its own,
/// as ParaView does. To be called in the filter's constructor.
void useCollectivePipeline(
  vtkAlgorithm* filter, std::function<vtkMultiProcessController*()> controller);

} // namespace tipp

#endif

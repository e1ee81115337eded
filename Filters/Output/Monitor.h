// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMonitor_h
#define tippMonitor_h

#include "Vtk/Compatibility.h"

#include "vtkAlgorithm.h"

#include <algorithm>
#include <atomic>
#include <thread>

namespace tipp
{

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

  /// Returns false if the work is to stop.
  bool operator()(double fraction)
  {
    constexpr double share = 0.95; // the rest is for creating the output
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

} // namespace tipp

#endif

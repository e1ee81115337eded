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

/// Passes progress on to an algorithm and the wish to stop back, from any thread; observers hear
/// of it in the thread that made this object only.
class Monitor
{
public:
  explicit Monitor(vtkAlgorithm* algorithm)
    : Algorithm(algorithm)
    , Owner(std::this_thread::get_id())
  {
  }

  /// False if the work is to stop.
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

} // namespace tipp

#endif

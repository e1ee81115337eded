// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReporter_h
#define tippReporter_h

#include <nanobind/nanobind.h>

#include <exception>
#include <functional>
#include <thread>

namespace tipp::python
{

/// Passes progress to a Python callable, or None, and asks Python whether to go on: on Ctrl-C, and
/// if the callable raises or returns False, the work ends. Only the thread that made it, which has
/// given Python's lock away, speaks with Python.
class Reporter
{
public:
  explicit Reporter(nanobind::object callable)
    : Callable(std::move(callable))
    , Owner(std::this_thread::get_id())
  {
  }

  /// False if the work is to stop.
  bool operator()(double fraction);

  /// As the cores take it; must not outlive this.
  std::function<bool(double)> function()
  {
    return [this](double fraction) { return (*this)(fraction); };
  }

  /// Raises what stopped the work. Call it with Python's lock.
  void raiseIfStopped() const;

private:
  nanobind::object Callable;
  std::thread::id Owner;
  bool Stopped = false;
  std::exception_ptr Raised;
};

/// Calls work() without Python's lock.
template <typename Work>
auto withoutLock(const Work& work)
{
  const nanobind::gil_scoped_release released;
  return work();
}

} // namespace tipp::python

#endif

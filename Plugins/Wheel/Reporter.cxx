// SPDX-License-Identifier: BSD-3-Clause
#include "Reporter.h"

#include <stdexcept>

namespace tipp::python
{

bool Reporter::operator()(double fraction)
{
  if (this->Stopped || std::this_thread::get_id() != this->Owner)
  {
    return !this->Stopped;
  }
  const nanobind::gil_scoped_acquire lock;
  try
  {
    if (PyErr_CheckSignals() != 0)
    {
      throw nanobind::python_error();
    }
    if (!this->Callable.is_none())
    {
      const nanobind::object answer = this->Callable(fraction);
      this->Stopped = answer.ptr() == Py_False;
    }
  }
  catch (...)
  {
    this->Raised = std::current_exception();
    this->Stopped = true;
  }
  return !this->Stopped;
}

void Reporter::raiseIfStopped() const
{
  if (this->Raised)
  {
    std::rethrow_exception(this->Raised);
  }
  if (this->Stopped)
  {
    throw std::runtime_error("the progress callback stopped the run.");
  }
}

} // namespace tipp::python

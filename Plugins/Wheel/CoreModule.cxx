// SPDX-License-Identifier: BSD-3-Clause
// tipp._core: the cores over NumPy arrays, for the engine in Python, which checks the arguments.
#include "Binding.h"

#include "Statistics/RunStatistics.h"

#include <nanobind/stl/string.h>

#include <new>
#include <stdexcept>
#include <type_traits>
#include <variant>

namespace tipp::python
{

std::vector<NamedArray> namedArrays(
  const nb::dict& arrays, const InputArray& due, const std::string& of)
{
  std::vector<NamedArray> result;
  for (const auto& [name, array] : arrays)
  {
    result.emplace_back(nb::cast<std::string>(name), nb::cast<InputArray>(array));
    const InputArray& values = result.back().second;
    const std::size_t rows = values.ndim() > 0 ? values.shape(0) : 0;
    if (rows < due.shape(0))
    {
      throw std::runtime_error("the array '" + result.back().first + "' has " +
        std::to_string(rows) + " values for " + std::to_string(due.shape(0)) + " " + of + ".");
    }
  }
  return result;
}

nb::dict statisticsDict(const RunStatistics& statistics)
{
  nb::dict result;
  for (const Figures& total : statistics.Totals)
  {
    std::visit(
      [&](const auto& values)
      {
        using Value = typename std::decay_t<decltype(values)>::value_type;
        result[total.Key.c_str()] = Value(values.front());
      },
      total.Values);
  }
  for (const FigureList& list : statistics.Lists)
  {
    if (list.Key == "phases")
    {
      const auto& names = std::get<std::vector<std::string>>(list.Columns[0].Values);
      const auto& values = std::get<std::vector<double>>(list.Columns[1].Values);
      nb::dict seconds;
      for (std::size_t i = 0; i < names.size(); ++i)
      {
        seconds[names[i].c_str()] = values[i];
      }
      result["seconds"] = seconds;
    }
  }
  return result;
}

bool Reporter::operator()(double fraction)
{
  if (this->Stopped || std::this_thread::get_id() != this->Owner)
  {
    return !this->Stopped;
  }
  // Without a function only Ctrl-C counts, and to look for it takes the GIL from other threads.
  constexpr double seldom = 0.02; // seconds
  if (!this->Function && this->SinceAsked.seconds() < seldom)
  {
    return true;
  }
  return this->ask(fraction);
}

bool Reporter::ask(double fraction)
{
  this->SinceAsked.restart();
  const nb::gil_scoped_acquire lock;
  try
  {
    if (PyErr_CheckSignals() != 0)
    {
      throw nb::python_error();
    }
    if (this->Function)
    {
      const nb::object answer = (*this->Function)(fraction);
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

void Reporter::finish()
{
  if (!this->Stopped)
  {
    this->ask(1);
  }
  this->raiseIfStopped();
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

NB_MODULE(_core, module)
{
  namespace nb = nanobind;
  // Types that Python keeps until it exits are not leaks.
  nb::set_leak_warnings(false);
  nb::register_exception_translator(
    [](const std::exception_ptr& raised, void*)
    {
      try
      {
        std::rethrow_exception(raised);
      }
      catch (const std::bad_alloc&)
      {
        PyErr_SetString(PyExc_RuntimeError, "there is not enough memory.");
      }
      catch (const std::logic_error& error) // includes std::invalid_argument
      {
        PyErr_SetString(PyExc_RuntimeError, error.what());
      }
    });
  tipp::python::addTriangulateFunctions(module);
  tipp::python::addMeshFunctions(module);
  tipp::python::addSeriesFunctions(module);
  tipp::python::addNetcdfFunctions();
  tipp::python::addOverlapFunctions(module);
  tipp::python::addGridFunctions(module);
  tipp::python::addFileFunctions(module);
  tipp::python::addQueryClass(module);
  tipp::python::addToolFunctions(module);
}

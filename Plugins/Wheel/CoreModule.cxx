// SPDX-License-Identifier: BSD-3-Clause
// tipp._core: the cores over NumPy arrays, for the engine in Python. Arguments are checked there.
#include "Functions.h"

#include "Parallel/ParallelFor.h"

#include <new>
#include <stdexcept>

NB_MODULE(_core, module)
{
  namespace nb = nanobind;
  // Types that Python keeps until it ends are no leaks.
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
      catch (const std::logic_error& error) // as invalid_argument
      {
        PyErr_SetString(PyExc_RuntimeError, error.what());
      }
    });
  tipp::python::addTriangulateFunctions(module);
  tipp::python::addConstraintFunctions(module);
  tipp::python::addFileFunctions(module);
  tipp::python::addLocatorClass(module);
  tipp::python::addPointFunctions(module);
  tipp::python::addResampleFunction(module);
}

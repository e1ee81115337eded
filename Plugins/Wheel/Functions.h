// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPythonFunctions_h
#define tippPythonFunctions_h

#include <nanobind/nanobind.h>

namespace tipp::python
{

void addTriangulateFunctions(nanobind::module_& module);
void addConstraintFunctions(nanobind::module_& module);
void addFileFunctions(nanobind::module_& module);
void addLocatorClass(nanobind::module_& module);
void addPointFunctions(nanobind::module_& module);
void addResampleFunction(nanobind::module_& module);

} // namespace tipp::python

#endif

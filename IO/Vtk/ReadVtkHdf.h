// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadVtkHdf_h
#define tippReadVtkHdf_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// Reads an unstructured grid or poly data from a .vtkhdf file, with all its parts. Throws IOError,
/// also for a file of several time steps.
vtkSmartPointer<vtkDataSet> readVtkHdf(const std::string& path);

} // namespace tipp

#endif

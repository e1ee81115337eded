// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadVtkHdf_h
#define tippReadVtkHdf_h

#include "vtkSmartPointer.h"

#include <string>

class vtkDataSet;

namespace tipp
{

/// Reads an unstructured grid or poly data from a .vtkhdf file, with all its parts. An array NAME
/// that varies in time is one array for each step, "NAME step 0" and so on, as in the pieces of a
/// partitioned mesh. Throws IOError, also if points or cells vary.
vtkSmartPointer<vtkDataSet> readVtkHdf(const std::string& path);

} // namespace tipp

#endif

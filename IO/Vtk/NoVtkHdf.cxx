// SPDX-License-Identifier: BSD-3-Clause
#include "Files/IOError.h"
#include "Vtk/ReadVtkHdf.h"

#include "vtkDataSet.h"

namespace tipp
{

vtkSmartPointer<vtkDataSet> readVtkHdf(const std::string& path)
{
  throw IOError(path,
    "is a VTKHDF file, which this build of TIPP does not read; install the NetCDF library "
    "(Debian's libnetcdf-dev) and build TIPP again.");
}

} // namespace tipp

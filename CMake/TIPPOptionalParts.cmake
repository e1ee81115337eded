# Sets TIPP_HAS_MPI and TIPP_HAS_OPENCL: whether these optional dependencies are used.
include(TIPPOptionalPart)

set(found OFF)
if (TARGET VTK::ParallelMPI AND TARGET VTK::mpi)
  set(found ON)
endif ()
tipp_optional_part(MPI "${found}"
  "this VTK (${VTK_DIR}) has no MPI; runs on several ranks need a VTK that was built with it.")

find_package(OpenCL QUIET)
find_path(TIPP_OPENCL_HPP CL/opencl.hpp HINTS ${OpenCL_INCLUDE_DIRS} DOC "The C++ headers of OpenCL")
set(found OFF)
if (OpenCL_FOUND AND TIPP_OPENCL_HPP)
  set(found ON)
endif ()
tipp_optional_part(OPENCL "${found}"
  "OpenCL's library or CL/opencl.hpp is not found; install ocl-icd-opencl-dev and opencl-clhpp-headers.")
unset(found)

# Finds GMP, which has no CMake package. Defines the target Gmp::gmp and, if MPFR is installed, Gmp::mpfr.
# It is not named FindGMP, because CGAL has a module with this name.
find_path(Gmp_INCLUDE_DIR gmp.h)
find_library(Gmp_LIBRARY gmp)
find_library(Gmp_MPFR_LIBRARY mpfr)
mark_as_advanced(Gmp_INCLUDE_DIR Gmp_LIBRARY Gmp_MPFR_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Gmp REQUIRED_VARS Gmp_LIBRARY Gmp_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install GMP (Debian's libgmp-dev)")

if (Gmp_FOUND AND NOT TARGET Gmp::gmp)
  add_library(Gmp::gmp UNKNOWN IMPORTED)
  set_target_properties(Gmp::gmp PROPERTIES
    IMPORTED_LOCATION "${Gmp_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${Gmp_INCLUDE_DIR}")
endif ()
if (Gmp_FOUND AND Gmp_MPFR_LIBRARY AND NOT TARGET Gmp::mpfr)
  add_library(Gmp::mpfr UNKNOWN IMPORTED)
  set_target_properties(Gmp::mpfr PROPERTIES
    IMPORTED_LOCATION "${Gmp_MPFR_LIBRARY}" INTERFACE_LINK_LIBRARIES Gmp::gmp)
endif ()

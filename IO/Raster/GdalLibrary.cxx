// SPDX-License-Identifier: BSD-3-Clause
#include "Raster/GdalLibrary.h"

#include "Files/IOError.h"

#include <string>
#include <type_traits>

#include <dlfcn.h>

namespace tipp
{
namespace
{

GdalLibrary openGdal()
{
  void* const library = dlopen(TIPP_GDAL_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  if (!library)
  {
    throw IOError("GeoTIFF and other files of GIS need the library GDAL (" TIPP_GDAL_LIBRARY
                  "), which cannot be opened; install it, or use another format.");
  }
  GdalLibrary functions;
  const auto find = [&](auto& function, const char* name)
  {
    void* const address = dlsym(library, name);
    if (!address)
    {
      throw IOError(std::string("The library " TIPP_GDAL_LIBRARY " has no function ") + name +
        "; install the version of GDAL that this program was built with.");
    }
    function = reinterpret_cast<std::decay_t<decltype(function)>>(address);
  };
#define TIPP_FIND_FUNCTION(name) find(functions.name, #name);
  TIPP_GDAL_FUNCTIONS(TIPP_FIND_FUNCTION)
#undef TIPP_FIND_FUNCTION
  // GDAL must not print: its messages are included in our exceptions.
  functions.CPLSetErrorHandler(functions.CPLQuietErrorHandler);
  functions.GDALAllRegister();
  return functions;
}

} // namespace

const GdalLibrary& gdal()
{
  static const GdalLibrary library = openGdal();
  return library;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippFormats_h
#define tippFormats_h

#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// What files of a format are used for; a format has the sum of its uses.
struct Use
{
  enum : unsigned
  {
    Points = 1 << 0,      ///< read as points
    Divisible = 1 << 1,   ///< read as points from any of them on, so that ranks share a file
    Constraints = 1 << 2, ///< read as segments and polygons that triangulations keep
    Triangles = 1 << 3,   ///< read as triangles
    Zones = 1 << 4,       ///< read as polygons of a GIS
    Rasters = 1 << 5,     ///< read as the grid of a raster
    WritesTriangles = 1 << 6,
    WritesTetrahedra = 1 << 7,
    WritesPieces = 1 << 8, ///< written as a partitioned mesh, which is a folder
    WritesRasters = 1 << 9,
    WritesLines = 1 << 10, ///< written as contour lines
    WritesPoints = 1 << 11,
    WritesSeries = 1 << 12 ///< written as fields on a grid through time
  };
};

/// What reads and writes the files of a format.
enum class Opener
{
  None, ///< not a format of this program
  Adcirc,
  CompressedText, ///< of the text formats
  Gdal,
  GeoTiff,
  Gmsh,
  Las,
  Netcdf,
  Npy,
  ParaViewList, ///< of files and their times
  Pieces,       ///< a partitioned mesh
  Selafin,
  Sms,
  Text,
  Triangle, ///< the files of Shewchuk's program
  Vtk
};

/// A row of the table of formats. To add a format, add a row in Formats.cxx; a new Opener also
/// needs a case in openFilePoints(), readModelMesh() or readMesh(), writeMesh(), createRaster() or
/// readConstraintFile(), according to its uses.
struct Format
{
  const char* Extensions; ///< in lower case and with their dots, separated by blanks
  const char* Others;     ///< more extensions, which messages do not list
  Opener OpenedBy;
  unsigned Uses;
  const char* Drivers; ///< the names of GDAL's drivers, separated by commas; empty: GDAL has none
  const char* Help; ///< what the help says about points of this format and of those above it that
                    ///< have no text
};

/// Returns the format of a file for one of these uses, by the extension of its name; null if there
/// is none. "-", the standard input, is points as text.
VTKTIPPIO_EXPORT const Format* formatOf(const std::string& path, unsigned uses);

/// Returns what opens a file for one of these uses.
VTKTIPPIO_EXPORT Opener openerOf(const std::string& path, unsigned uses);

/// Whether a file is opened so, for whatever use.
VTKTIPPIO_EXPORT bool isOpenedBy(const std::string& path, Opener opener);

/// Returns all extensions that have one of these uses, in the order of the table.
VTKTIPPIO_EXPORT std::vector<std::string> extensionsFor(unsigned uses);

/// Returns the extensions that have one of these uses as a list for messages, such as
/// ".tif, .npy or .vti". `forVtk`, if it is not empty, is the end of the list, instead of all
/// formats of VTK, such as " or one of VTK's".
VTKTIPPIO_EXPORT std::string listFormats(unsigned uses, const std::string& forVtk = "");

/// Returns what the help says about files of points: a list of all formats.
VTKTIPPIO_EXPORT std::string describePointFormats();

/// For a file of a known kind that TIPP does not read, such as Gmsh's: names the kind and a command
/// that converts it; else empty.
VTKTIPPIO_EXPORT std::string conversionAdvice(const std::string& path);

/// Throws IOError: with the advice of conversionAdvice(), or else with `problem`.
[[noreturn]] VTKTIPPIO_EXPORT void refuseKind(const std::string& path, const std::string& problem);

} // namespace tipp

#endif

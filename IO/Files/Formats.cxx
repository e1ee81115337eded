// SPDX-License-Identifier: BSD-3-Clause
#include "Files/Formats.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <sstream>

namespace tipp
{
namespace
{

constexpr unsigned vtkRead = Use::Points | Use::Constraints | Use::Triangles;

// clang-format off
/// The formats. An extension may be in several rows, if it is opened differently for each use. The
/// order is that of lists in messages.
constexpr std::array<Format, 35> formats = { {
  // Extensions, others, opener, uses, drivers of GDAL, help
  { ".poly", "", Opener::Triangle, Use::Constraints, "", "" },
  { ".tif", ".tiff", Opener::GeoTiff, Use::Rasters | Use::WritesRasters | Use::WritesSeries,
    "GTiff", "" },
  { ".npy", "", Opener::Npy, Use::Points | Use::Divisible | Use::Triangles | Use::WritesPoints |
      Use::WritesTriangles | Use::WritesTetrahedra | Use::WritesRasters | Use::WritesSeries, "",
    "n x 2 or n x 3, float64 or float32" },
  { ".vtp", "", Opener::Vtk, vtkRead | Use::WritesTriangles, "", "" },
  { ".vtu", "", Opener::Vtk, vtkRead | Use::WritesTriangles | Use::WritesTetrahedra, "", "" },
  { ".vti", "", Opener::Vtk, vtkRead | Use::WritesRasters, "", "" },
  { ".csv .txt", "", Opener::Text, Use::Points | Use::Constraints, "", "" },
  { ".xyz", ".tsv .pts", Opener::Text, Use::Points, "", "" },
  { ".gz .xz .zst", "", Opener::CompressedText, Use::Points, "",
    "a point per line, columns separated by comma, semicolon, tab or blanks; a first line of names "
    "or of the count is recognized" },
  { ".las .laz", "", Opener::Las, Use::Points | Use::Divisible | Use::WritesPoints, "",
    "1.0 to 1.5" },
  { ".gpkg", "", Opener::Gdal, Use::Points | Use::Constraints | Use::Zones | Use::WritesLines,
    "GPKG", "" },
  { ".shp", "", Opener::Gdal, Use::Points | Use::Constraints | Use::Zones, "ESRI Shapefile", "" },
  { ".geojson", "", Opener::Gdal, Use::Points | Use::Constraints | Use::Zones, "GeoJSON", "" },
  { "", ".json", Opener::Gdal, Use::Points | Use::Constraints | Use::Zones,
    "GeoJSON,TopoJSON,ESRIJSON", "" },
  { ".fgb", "", Opener::Gdal, Use::Points | Use::Constraints | Use::Zones, "FlatGeobuf", "" },
  { ".kml", "", Opener::Gdal, Use::Points | Use::Zones, "LIBKML,KML", "" },
  { ".dxf", "", Opener::Gdal, Use::Points | Use::Zones, "DXF",
    "the points; --z names the attribute that is z; if built with GDAL" },
  { ".csv", "", Opener::Gdal, Use::Zones, "CSV", "" },
  { ".14", "", Opener::Adcirc, Use::Points | Use::Constraints | Use::Triangles |
      Use::WritesTriangles, "", "" },
  { ".grd", "", Opener::Adcirc, Use::Points | Use::Constraints | Use::Triangles, "", "ADCIRC" },
  { "", ".grd", Opener::Adcirc, Use::WritesTriangles, "", "" },
  { ".gr3", "", Opener::Adcirc, Use::Points | Use::Constraints | Use::Triangles |
      Use::WritesTriangles, "", "SCHISM" },
  { ".2dm", "", Opener::Sms, Use::Points | Use::Triangles | Use::WritesTriangles, "", "SMS" },
  { ".nc", ".nc4 .cdf", Opener::Netcdf, Use::Points | Use::Triangles | Use::WritesTriangles |
      Use::WritesSeries, "", "" },
  { ".slf", ".ser .sel", Opener::Selafin, Use::Points | Use::Triangles, "",
    "the nodes of models; NetCDF if it is built in" },
  { ".msh", "", Opener::Gmsh, Use::Points | Use::Triangles | Use::WritesTriangles, "",
    "Gmsh in ASCII" },
  { ".node", "", Opener::Triangle, Use::Points | Use::Triangles | Use::WritesTriangles, "",
    "Triangle; the first attribute is z" },
  { ".ele", "", Opener::Triangle, Use::Triangles, "", "" },
  { "", ".ele", Opener::Triangle, Use::WritesTriangles, "", "" },
  { ".vts .vtr .pvtp .pvtu .pvti .pvts .pvtr .vtk .vtkhdf .ply .stl .obj", "", Opener::Vtk, vtkRead, "",
    "" },
  { ".asc", "", Opener::Gdal, Use::Rasters, "AAIGrid", "" },
  { ".flt .bil", "", Opener::Gdal, Use::Rasters, "EHdr", "" },
  { ".pvd", "", Opener::ParaViewList, Use::WritesSeries, "", "" },
  { ".vtp", "", Opener::Vtk, Use::WritesLines, "", "" },
  { ".tipp", "", Opener::Pieces, Use::WritesPieces, "", "" },
} };
// clang-format on

std::vector<std::string> wordsOf(const std::string& text)
{
  std::istringstream stream(text);
  return { std::istream_iterator<std::string>(stream), {} };
}

/// Returns the words with commas between them, and `last` between the last two.
std::string joined(const std::vector<std::string>& words, const std::string& last)
{
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
  {
    text += (i == 0 ? "" : i + 1 == words.size() ? last : ", ") + words[i];
  }
  return text;
}

/// All extensions of a format.
std::string allOf(const Format& format)
{
  return format.Extensions + std::string(" ") + format.Others;
}

bool has(const std::string& extensions, const std::string& extension)
{
  return !extension.empty() && (extensions + " ").find(extension + " ") != std::string::npos;
}

/// A format of other programs, or one that only some commands read: what to do with a file of it.
struct Kind
{
  const char* Extensions; ///< separated by blanks
  const char* Name;
  const char* Command; ///< what to do; with FILE as the file's name
};

constexpr const char* flatten = "convert it, as with 'tipp flatten FILE -o mesh'.";
constexpr const char* meshio = "convert it, as with 'meshio convert FILE out.vtu'.";

constexpr std::array<Kind, 11> kinds = { {
  { ".14 .grd", "an ADCIRC grid", flatten },
  { ".gr3", "a SCHISM grid", flatten },
  { ".2dm", "a mesh of SMS", flatten },
  { ".msh", "a mesh of Gmsh", flatten },
  { ".node .ele", "a file of Triangle", flatten },
  { ".ex2 .exo .e", "an Exodus file", meshio },
  { ".xml", "a mesh of DOLFIN or other XML", meshio },
  { ".med", "a mesh of Salome", meshio },
  { ".nc .nc4 .cdf", "a NetCDF file", flatten },
  { ".slf .ser .sel", "a SELAFIN file", flatten },
  { ".e57", "an E57 file", "convert it, as with 'pdal translate FILE out.las'." },
} };

} // namespace

const Format* formatOf(const std::string& path, unsigned uses)
{
  const bool isStandardInput = path == "-" && uses == Use::Points;
  const std::string extension = isStandardInput ? ".txt" : extensionOf(path);
  const auto* const found = std::find_if(formats.begin(), formats.end(),
    [&](const Format& format)
    { return (format.Uses & uses) != 0 && has(allOf(format), extension); });
  return found == formats.end() ? nullptr : found;
}

Opener openerOf(const std::string& path, unsigned uses)
{
  const Format* const format = formatOf(path, uses);
  return format ? format->OpenedBy : Opener::None;
}

bool isOpenedBy(const std::string& path, Opener opener)
{
  const std::string extension = extensionOf(path);
  return std::any_of(formats.begin(), formats.end(),
    [&](const Format& format)
    { return format.OpenedBy == opener && has(allOf(format), extension); });
}

std::vector<std::string> extensionsFor(unsigned uses)
{
  std::vector<std::string> extensions;
  for (const Format& format : formats)
  {
    for (const std::string& extension : wordsOf((format.Uses & uses) != 0 ? allOf(format) : ""))
    {
      extensions.push_back(extension);
    }
  }
  return extensions;
}

std::string listFormats(unsigned uses, const std::string& forVtk)
{
  std::vector<std::string> list;
  for (const Format& format : formats)
  {
    const bool isListed =
      (format.Uses & uses) != 0 && (forVtk.empty() || format.OpenedBy != Opener::Vtk);
    const std::vector<std::string> extensions = wordsOf(isListed ? format.Extensions : "");
    if (isListed && format.OpenedBy == Opener::CompressedText)
    {
      list.back() += " (or these as " + joined(extensions, " or ") + ")";
      continue;
    }
    list.insert(list.end(), extensions.begin(), extensions.end());
  }
  return forVtk.empty() ? joined(list, " or ") : joined(list, ", ") + forVtk;
}

std::string describePointFormats()
{
  std::string text;
  for (const Format& format : formats)
  {
    if ((format.Uses & Use::Points) != 0 && format.OpenedBy != Opener::Vtk)
    {
      const std::string help = format.Help;
      text += joined(wordsOf(allOf(format)), ", ") + (help.empty() ? ", " : " (" + help + "); ");
    }
  }
  return text + "any VTK file";
}

std::string conversionAdvice(const std::string& path)
{
  namespace fs = std::filesystem;
  const std::string name = fs::path(path).filename().string();
  const bool isCompressed = extensionOf(path) == ".gz";
  const std::string plain = isCompressed ? fs::path(name).stem().string() : name;
  const std::string extension = extensionOf(plain) + " ";
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
    [&extension](const Kind& k)
    { return (k.Extensions + std::string(" ")).find(extension) != std::string::npos; });
  if (extension == " " || kind == kinds.end())
  {
    return "";
  }
  std::string command = kind->Command;
  for (std::size_t at = command.find("FILE"); at != std::string::npos;
       at = command.find("FILE", at + plain.size()))
  {
    command.replace(at, 4, plain);
  }
  const std::string unpack = isCompressed ? "unpack it, as with 'gunzip " + name + "', and " : "";
  return std::string("is ") + kind->Name + ", which is not read here; " + unpack + command;
}

void refuseKind(const std::string& path, const std::string& problem)
{
  const std::string advice = conversionAdvice(path);
  throw IOError(path, advice.empty() ? problem : advice);
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippGdalLibrary_h
#define tippGdalLibrary_h

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_http.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

namespace tipp
{

/// The functions of GDAL that TIPP uses.
#define TIPP_GDAL_FUNCTIONS(X)                                                                     \
  X(CPLErrorReset)                                                                                 \
  X(CPLGetLastErrorMsg)                                                                            \
  X(CPLGetLastErrorType)                                                                           \
  X(CPLHTTPSetFetchCallback)                                                                       \
  X(CPLQuietErrorHandler)                                                                          \
  X(CPLSetErrorHandler)                                                                            \
  X(CPLSetThreadLocalConfigOption)                                                                 \
  X(GDALAllRegister)                                                                               \
  X(GDALClose)                                                                                     \
  X(GDALCreate)                                                                                    \
  X(GDALCreateCopy)                                                                                \
  X(GDALDatasetCommitTransaction)                                                                  \
  X(GDALDatasetCreateLayer)                                                                        \
  X(GDALDatasetGetLayer)                                                                           \
  X(GDALDatasetGetLayerCount)                                                                      \
  X(GDALDatasetStartTransaction)                                                                   \
  X(GDALGetDriverByName)                                                                           \
  X(GDALGetGeoTransform)                                                                           \
  X(GDALGetProjectionRef)                                                                          \
  X(GDALGetRasterBand)                                                                             \
  X(GDALGetRasterCount)                                                                            \
  X(GDALGetRasterDataType)                                                                         \
  X(GDALGetRasterNoDataValue)                                                                      \
  X(GDALGetRasterOffset)                                                                           \
  X(GDALGetRasterScale)                                                                            \
  X(GDALGetRasterXSize)                                                                            \
  X(GDALGetRasterYSize)                                                                            \
  X(GDALGetSpatialRef)                                                                             \
  X(GDALOpenEx)                                                                                    \
  X(GDALRasterIO)                                                                                  \
  X(GDALSetCacheMax64)                                                                             \
  X(GDALSetGeoTransform)                                                                           \
  X(GDALSetMetadataItem)                                                                           \
  X(GDALSetSpatialRef)                                                                             \
  X(OGR_FD_GetFieldCount)                                                                          \
  X(OGR_FD_GetFieldDefn)                                                                           \
  X(OGR_F_Create)                                                                                  \
  X(OGR_F_Destroy)                                                                                 \
  X(OGR_F_GetFieldAsDouble)                                                                        \
  X(OGR_F_GetFieldAsString)                                                                        \
  X(OGR_F_GetFieldIndex)                                                                           \
  X(OGR_F_GetGeometryRef)                                                                          \
  X(OGR_F_IsFieldSetAndNotNull)                                                                    \
  X(OGR_F_SetFieldDouble)                                                                          \
  X(OGR_F_SetGeometryDirectly)                                                                     \
  X(OGR_Fld_Create)                                                                                \
  X(OGR_Fld_Destroy)                                                                               \
  X(OGR_Fld_GetNameRef)                                                                            \
  X(OGR_Fld_GetType)                                                                               \
  X(OGR_GT_Flatten)                                                                                \
  X(OGR_G_AddPoint)                                                                                \
  X(OGR_G_CreateGeometry)                                                                          \
  X(OGR_G_DestroyGeometry)                                                                         \
  X(OGR_G_GetGeometryCount)                                                                        \
  X(OGR_G_GetGeometryRef)                                                                          \
  X(OGR_G_GetGeometryType)                                                                         \
  X(OGR_G_GetLinearGeometry)                                                                       \
  X(OGR_G_GetPointCount)                                                                           \
  X(OGR_G_GetX)                                                                                    \
  X(OGR_G_GetY)                                                                                    \
  X(OGR_G_GetZ)                                                                                    \
  X(OGR_G_HasCurveGeometry)                                                                        \
  X(OGR_G_Is3D)                                                                                    \
  X(OGR_G_IsEmpty)                                                                                 \
  X(OGR_L_CreateFeature)                                                                           \
  X(OGR_L_CreateField)                                                                             \
  X(OGR_L_GetLayerDefn)                                                                            \
  X(OGR_L_GetName)                                                                                 \
  X(OGR_L_GetNextFeature)                                                                          \
  X(OGR_L_GetSpatialRef)                                                                           \
  X(OGR_L_ResetReading)                                                                            \
  X(OSRClone)                                                                                      \
  X(OSRDemoteTo2D)                                                                                 \
  X(OSRDestroySpatialReference)                                                                    \
  X(OSRExportToWktEx)                                                                              \
  X(OSRFindMatches)                                                                                \
  X(OSRFreeSRSArray)                                                                               \
  X(OSRGetAngularUnits)                                                                            \
  X(OSRGetAttrValue)                                                                               \
  X(OSRGetAuthorityCode)                                                                           \
  X(OSRGetAuthorityName)                                                                           \
  X(OSRGetAxis)                                                                                    \
  X(OSRGetName)                                                                                    \
  X(OSRGetTargetLinearUnits)                                                                       \
  X(OSRImportFromEPSG)                                                                             \
  X(OSRImportFromWkt)                                                                              \
  X(OSRIsGeographic)                                                                               \
  X(OSRIsLocal)                                                                                    \
  X(OSRIsSameEx)                                                                                   \
  X(OSRIsSameVertCS)                                                                               \
  X(OSRIsVertical)                                                                                 \
  X(OSRNewSpatialReference)                                                                        \
  X(OSRSetCompoundCS)                                                                              \
  X(OSRSetFromUserInput)                                                                           \
  X(OSRStripVertical)                                                                              \
  X(VSIFCloseL)                                                                                    \
  X(VSIFileFromMemBuffer)                                                                          \
  X(VSIFree)                                                                                       \
  X(VSIGetMemFileBuffer)                                                                           \
  X(VSIUnlink)

/// GDAL, loaded on first use: it depends on over a hundred libraries, which would slow down every
/// start of the tool.
struct GdalLibrary
{
  // NOLINTNEXTLINE(bugprone-macro-parentheses): a declared name cannot have them
#define TIPP_DECLARE_FUNCTION(name) decltype(&::name) name = nullptr;
  TIPP_GDAL_FUNCTIONS(TIPP_DECLARE_FUNCTION)
#undef TIPP_DECLARE_FUNCTION
};

/// Loads GDAL once per process. Throws IOError if it is not installed.
const GdalLibrary& gdal();

/// Releases a handle of GDAL by its function `Release`.
template <auto Release>
struct GdalRelease
{
  template <typename T>
  void operator()(T* handle) const
  {
    (gdal().*Release)(handle);
  }
};
template <typename Handle, auto Release>
using GdalOwner = std::unique_ptr<std::remove_pointer_t<Handle>, GdalRelease<Release>>;
using GdalDataSet = GdalOwner<GDALDatasetH, &GdalLibrary::GDALClose>;

using GdalReference = GdalOwner<OGRSpatialReferenceH, &GdalLibrary::OSRDestroySpatialReference>;

/// Opens a file on disk with the drivers that its extension stands for, and no others: a VRT, which
/// names other files or addresses, is not opened under another name. `flags`: GDAL_OF_RASTER or
/// GDAL_OF_VECTOR. Returns null if GDAL cannot read the file; CPLGetLastErrorMsg() has the reason.
/// Throws IOError if there is no such file, or its extension stands for no driver.
GdalDataSet openWithGdal(const std::string& path, unsigned flags);

/// Opens a file on disk, whatever its extension, with some drivers: names, ended by null. Returns
/// null if GDAL cannot read the file. Throws IOError if the path is not that of a file on disk.
GdalDataSet openWithDrivers(const std::string& path, unsigned flags, const char* const* drivers);

/// How far segments that replace curves may be from them: see setCurveTolerance().
extern std::atomic<double> curveTolerance;

/// Calls visit(feature, geometry) for each feature of all layers of a vector file, in their order.
/// Curves are converted to straight lines; the geometry may be null. Throws IOError, and whatever
/// visit() throws.
void forFeatures(
  const std::string& path, const std::function<void(OGRFeatureH, OGRGeometryH)>& visit);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPPointReader
 * @brief   reads points from LAS, text, .npy and other files
 *
 * vtkTIPPPointReader reads the files that `tipp delaunay` reads: .las (versions 1.0 to 1.4, all
 * point formats), .laz, .csv, .txt, .xyz, .npy, .14, .grd and the files that
 * VTK reads. The output is a vtkPolyData with the points of all files, in the order of the files. A
 * column named z is the third coordinate; the other columns become point data (float64). For LAS
 * files these are intensity, classification, gps_time, red, green, blue and nir, as far as the file
 * has them.
 *
 * If a LAS file has a coordinate reference system, it is the string array
 * "CoordinateReferenceSystem" in the output's field data: WKT or "EPSG:code".
 *
 * If reading can start at any point (.las, .npy), each requested piece gets a share of consecutive
 * points. Otherwise the first piece gets all points and the others none.
 *
 * @sa
 * vtkTIPPDelaunay2D vtkTIPPOutOfCoreDelaunay2D
 */

#ifndef vtkTIPPPointReader_h
#define vtkTIPPPointReader_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkTIPPIOModule.h" // For export macro
#include "vtkTIPPSetGet.h"   // For property macros

#include <string> // For FileNames
#include <vector> // For FileNames

namespace tipp
{
struct PointOptions;
}

class vtkStringArray;

class VTKTIPPIO_EXPORT vtkTIPPPointReader : public vtkPolyDataAlgorithm
{
public:
  static vtkTIPPPointReader* New();
  vtkTypeMacro(vtkTIPPPointReader, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The files, which are read as one set of points; they must have the same columns. SetFileName()
   * replaces all files by one.
   */
  vtkTIPPNameListMacro(FileName);
  ///@}

  ///@{
  /**
   * The columns of text and .npy files that are x and y: a name in the file, or a column index from
   * 0. Empty or null (the default): columns with the usual names, or
   * without names the first two.
   */
  vtkTIPPStringMacro(XColumn);
  vtkTIPPStringMacro(YColumn);
  ///@}

  ///@{
  /**
   * The attribute of GIS files that is z. Empty or null (the default): z of the points, or else an
   * attribute named z, elevation, elev or height.
   */
  vtkTIPPStringMacro(ZColumn);
  ///@}

  ///@{
  /**
   * The layer of GIS files whose points are read. Empty or null (the default): all layers.
   */
  vtkTIPPStringMacro(Layer);
  ///@}

  ///@{
  /**
   * The coordinate reference system of the points, such as "EPSG:25832". Empty or null (the
   * default): that of the files, which must be the same in all of them.
   */
  vtkTIPPStringMacro(CoordinateReferenceSystem);
  ///@}

  ///@{
  /**
   * The classes of LAS points to read, separated by commas, such as "2,9". Empty or null (the
   * default): all.
   */
  vtkTIPPStringMacro(Classes);
  ///@}

  /**
   * Which returns of a laser pulse are read.
   */
  enum ReturnType
  {
    RETURNS_ALL = 0,
    RETURNS_FIRST = 1,
    RETURNS_LAST = 2
  };

  ///@{
  /**
   * Which returns of LAS files are read: a ReturnType, RETURNS_ALL by default.
   */
  vtkTIPPClampedMacro(Returns, int, RETURNS_ALL, RETURNS_LAST);
  ///@}

  ///@{
  /**
   * Whether LAS points flagged as withheld, synthetic or overlap (class 12 in formats 0 to 5) are
   * read, too. Off by default.
   */
  vtkTIPPSwitchMacro(KeepWithheld, bool);
  vtkTIPPSwitchMacro(KeepSynthetic, bool);
  vtkTIPPSwitchMacro(KeepOverlap, bool);
  ///@}

  ///@{
  /**
   * Whether LAS files that end too early are read as far as they go, and whether points beyond the
   * number in the header are read. Off by default: the first is an error, the second a warning.
   */
  vtkTIPPSwitchMacro(KeepTruncated, bool);
  vtkTIPPSwitchMacro(KeepUncounted, bool);
  ///@}

  ///@{
  /**
   * The range of x and y of the points to read: xmin, xmax, ymin, ymax. xmin > xmax (the default)
   * reads all points; ymin > ymax alone is an error. Of LAS, LAZ and COPC files, parts outside of
   * the range are not read.
   */
  vtkSetVector4Macro(Bounds, double);
  vtkGetVector4Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Of COPC files, only the levels are read that are needed for points about this far apart, in the
   * units of the points; other files are then an error. 0 (the default): all levels.
   */
  vtkTIPPClampedMacro(Spacing, double, 0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Names of the columns besides x and y to read, separated by commas. Empty or null (the default):
   * all.
   */
  vtkTIPPStringMacro(Columns);
  ///@}

  ///@{
  /**
   * Whether the output has a vertex cell for each point, which is needed for rendering. On by
   * default.
   */
  vtkTIPPSwitchMacro(GenerateVertices, bool);
  ///@}

  ///@{
  /**
   * The number of points that the last update left out because of Classes, Returns or flags.
   */
  vtkGetMacro(NumberOfPointsLeftOut, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Whether the files of the last update have a column z. Otherwise z is 0 at all points.
   */
  vtkGetMacro(HasHeights, bool);
  ///@}

  /**
   * Finds x, y and z among the names of the columns of a table, as for a file: by the usual names,
   * and never an id. Sets their indices, -1 for z if there are no heights. Returns an empty text,
   * or why the names do not tell, such as "has the columns id, a, b, and their names do not tell x
   * and y".
   */
  static std::string FindCoordinates(vtkStringArray* names, int columns[3]);

protected:
  vtkTIPPPointReader();
  ~vtkTIPPPointReader() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<std::string> FileNames;
  std::string XColumn;
  std::string YColumn;
  std::string ZColumn;
  std::string Layer;
  std::string CoordinateReferenceSystem;
  std::string Classes;
  std::string Columns;
  double Bounds[4] = { 1, -1, 1, -1 };
  double Spacing = 0;
  int Returns = RETURNS_ALL;
  bool KeepWithheld = false;
  bool KeepSynthetic = false;
  bool KeepOverlap = false;
  bool KeepTruncated = false;
  bool KeepUncounted = false;
  bool GenerateVertices = true;
  vtkTypeInt64 NumberOfPointsLeftOut = 0;
  bool HasHeights = false;

private:
  vtkTIPPPointReader(const vtkTIPPPointReader&) = delete;
  void operator=(const vtkTIPPPointReader&) = delete;

  tipp::PointOptions Options() const;
  void Read(vtkInformation* info, vtkPolyData* output);
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPPointsToImage
 * @brief   makes a regular grid of elevations (a DEM) of scattered points
 *
 * vtkTIPPPointsToImage triangulates points by x and y, exactly, and samples the triangulated
 * surface at the centres of pixels. The triangles are not kept. The values are those of `tipp dem`
 * and of vtkTIPPDelaunay2D and vtkRangeResampleFilter one after the other, the same bit for bit for
 * any NumberOfThreads, MemoryLimit and order of the points.
 *
 * The first input is the points, a vtkPointSet. Their z is the elevation, unless there is a point
 * array of this name. The second input, optional, has breaklines: lines and polygons of a
 * vtkPolyData become edges of triangles. Their points have the z of the lines, or the elevation of
 * the surface without them if all of these are 0. The third input, optional, is a boundary: closed
 * lines or polygons, whose corners have the elevation of the points' own surface. There are no
 * values outside of it.
 *
 * The output is a vtkImageData of one layer. A sample of the image is the centre of a pixel. It has
 * a point array of doubles for each band, NaN where there is no triangle. Bands are
 * - elevation;
 * - point arrays of one component of the input, by their names, linear in each triangle;
 * - slope and aspect, in degrees, and hillshade, 1 to 255, of the triangles;
 * - density: points a square unit, half a point in each triangle;
 * - void: 1 where there is no triangle, else 0.
 *
 * The field data has GeoTransform, six numbers as GDAL has them: the west border, the width of a
 * pixel, 0, the north border, 0, and minus the height of a pixel.
 *
 * Points with a NaN or infinite x or y are left out, with one warning. Errors: no finite point, a
 * band that is no array, more pixels than the memory holds, a boundary that is not closed.
 *
 * @warning
 * It works on one rank: each rank asks for all points and makes the whole image.
 *
 * @sa
 * vtkTIPPDelaunay2D vtkRangeResampleFilter vtkTIPPPointReader
 */

#ifndef vtkTIPPPointsToImage_h
#define vtkTIPPPointsToImage_h

#include "vtkImageAlgorithm.h"
#include "vtkTIPPFiltersModule.h" // For export macro

#include <array>  // For PointBounds
#include <memory> // For Stream
#include <string> // For Bands
#include <vector> // For Bands

class vtkAlgorithmOutput;
class vtkPointSet;
class vtkPolyData;

namespace tipp
{
struct DemRequest;
class PointStream;
struct PointTable;
struct RasterGrid;
}

class VTKTIPPFILTERS_EXPORT vtkTIPPPointsToImage : public vtkImageAlgorithm
{
public:
  static vtkTIPPPointsToImage* New();
  vtkTypeMacro(vtkTIPPPointsToImage, vtkImageAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Sets the optional inputs: vtkPolyData with lines or polygons.
   */
  void SetBreaklinesConnection(vtkAlgorithmOutput* lines) { this->SetInputConnection(1, lines); }
  void SetBreaklinesData(vtkDataObject* lines) { this->SetInputData(1, lines); }
  void SetBoundaryConnection(vtkAlgorithmOutput* lines) { this->SetInputConnection(2, lines); }
  void SetBoundaryData(vtkDataObject* lines) { this->SetInputData(2, lines); }
  ///@}

  ///@{
  /**
   * Files of lines, as `tipp dem` reads them, which take the place of the optional inputs. Empty or
   * null (the default): there are none.
   */
  vtkSetFilePathMacro(BreaklinesFileName);
  vtkGetFilePathMacro(BreaklinesFileName);
  vtkSetFilePathMacro(BoundaryFileName);
  vtkGetFilePathMacro(BoundaryFileName);
  ///@}

  ///@{
  /**
   * Width and height of a pixel, in the units of the points. 0 (the default): about one point a
   * pixel.
   */
  vtkSetClampMacro(Resolution, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Resolution, double);
  ///@}

  ///@{
  /**
   * Whether the pixels cover the points that thinning keeps (the default) and SamplingBounds is
   * ignored. Then the input is updated as soon as the extent of the output is asked for.
   */
  vtkSetMacro(UseInputBounds, bool);
  vtkGetMacro(UseInputBounds, bool);
  vtkBooleanMacro(UseInputBounds, bool);
  ///@}

  ///@{
  /**
   * The range to cover as (xmin, xmax, ymin, ymax). (0, 1, 0, 1) by default.
   */
  vtkSetVector4Macro(SamplingBounds, double);
  vtkGetVector4Macro(SamplingBounds, double);
  ///@}

  ///@{
  /**
   * Whether borders of pixels are at multiples of Resolution (the default), so that images of
   * neighbouring tiles fit together. Else the first pixels begin at the bounds.
   */
  vtkSetMacro(AlignToResolution, bool);
  vtkGetMacro(AlignToResolution, bool);
  vtkBooleanMacro(AlignToResolution, bool);
  ///@}

  ///@{
  /**
   * The bands, see above. "elevation" by default; AddBand() adds to it.
   */
  void AddBand(const char* name);
  void ClearBands();
  int GetNumberOfBands() const;
  const char* GetBand(int index) const;
  ///@}

  ///@{
  /**
   * Triangles with an edge longer than this, in the plane and the units of the points, have no
   * values. 0 by default: all have.
   */
  vtkSetClampMacro(MaximumEdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumEdgeLength, double);
  ///@}

  /**
   * Which values coincident points get.
   */
  enum DuplicateType
  {
    DUPLICATES_FIRST = 0,   ///< those of the first point
    DUPLICATES_LOWEST = 1,  ///< those of the lowest
    DUPLICATES_HIGHEST = 2, ///< those of the highest
    DUPLICATES_MEAN = 3     ///< the mean of each array
  };

  ///@{
  /**
   * Which values coincident points get; DUPLICATES_FIRST by default.
   */
  vtkSetClampMacro(Duplicates, int, DUPLICATES_FIRST, DUPLICATES_MEAN);
  vtkGetMacro(Duplicates, int);
  ///@}

  /**
   * Which point of a square thinning keeps.
   */
  enum ThinningType
  {
    THIN_LOWEST = 0,
    THIN_HIGHEST = 1,
    THIN_NEAREST = 2 ///< to the centre of the square
  };

  ///@{
  /**
   * One point is kept in each square of this side. 0 (the default): all are.
   */
  vtkSetClampMacro(ThinningSize, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(ThinningSize, double);
  ///@}

  ///@{
  /**
   * Which point of a square is kept; THIN_NEAREST by default.
   */
  vtkSetClampMacro(ThinningRule, int, THIN_LOWEST, THIN_NEAREST);
  vtkGetMacro(ThinningRule, int);
  ///@}

  ///@{
  /**
   * Bytes that the triangulation may take besides the input and the image; what does not fit goes
   * to temporary files. 0 (the default): no limit.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0 (the default) is OpenMP's choice.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

protected:
  vtkTIPPPointsToImage();
  ~vtkTIPPPointsToImage() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  char* BreaklinesFileName = nullptr;
  char* BoundaryFileName = nullptr;
  double Resolution = 0;
  bool UseInputBounds = true;
  double SamplingBounds[4] = { 0, 1, 0, 1 };
  bool AlignToResolution = true;
  std::vector<std::string> Bands = { "elevation" };
  double MaximumEdgeLength = 0;
  int Duplicates = DUPLICATES_FIRST;
  double ThinningSize = 0;
  int ThinningRule = THIN_NEAREST;
  vtkTypeInt64 MemoryLimit = 0;
  int NumberOfThreads = 0;

private:
  vtkTIPPPointsToImage(const vtkTIPPPointsToImage&) = delete;
  void operator=(const vtkTIPPPointsToImage&) = delete;

  tipp::RasterGrid Grid(vtkPointSet* points) const;
  tipp::PointTable Table(vtkPointSet* points) const;
  std::unique_ptr<tipp::PointStream> Stream(vtkPointSet* points) const;
  std::array<double, 4> PointBounds(vtkPointSet* points) const; // of those that thinning keeps
  void Constrain(vtkPolyData* lines, vtkPolyData* boundary, tipp::DemRequest& request) const;
  void Make(vtkInformationVector** inputs, vtkImageData* output);
};

#endif

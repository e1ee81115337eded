// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPPointsToImage
 * @brief makes a regular grid of elevations (a DEM) from scattered points
 *
 * vtkTIPPPointsToImage triangulates points by x and y, exactly, and samples the triangulated
 * surface at the centres of pixels. The triangles are not kept. The values are identical to those
 * of `tipp dem`, and of vtkTIPPDelaunay2D followed by vtkRangeResampleFilter, bit for bit, for any
 * NumberOfThreads, MemoryLimit and order of the points.
 *
 * The first input is the points, a vtkPointSet. Their elevation is the point array "elevation", or
 * else z. The second input, optional, has breaklines: the lines and polygons of a vtkPolyData,
 * which become edges of triangles. Their points keep their z; if all z are 0, they get the
 * elevation of the surface without breaklines. The third input, optional, is a boundary: closed
 * lines or polygons, outside of which there are no values. Their corners get the elevation of the
 * surface.
 *
 * The output is a vtkImageData with one layer, whose points are the centres of the pixels. It has a
 * point array of doubles for each band, NaN where there is no triangle. Bands are
 * - elevation;
 * - single-component point arrays of the input, by name, interpolated linearly in each triangle;
 * - slope and aspect, in degrees, and hillshade, 1 to 255, constant in each triangle;
 * - density: points per square unit, counting half a point per triangle;
 * - void: 1 where there is no triangle, else 0.
 *
 * The field data has GeoTransform, six numbers as in GDAL: the west border, the width of a pixel,
 * 0, the north border, 0, and minus the height of a pixel.
 *
 * Points with a NaN or infinite x or y are left out, with one warning. Errors: no finite point, a
 * band that does not exist, more pixels than fit into memory, a boundary that is not closed.
 *
 * @warning It does not work in parallel over ranks: each rank requests all points and makes the
 * whole image.
 *
 * @sa
 * vtkTIPPDelaunay2D vtkRangeResampleFilter vtkTIPPPointReader
 */

#ifndef vtkTIPPPointsToImage_h
#define vtkTIPPPointsToImage_h

#include "vtkImageAlgorithm.h"
#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTIPPSetGet.h"        // For property macros

#include <memory> // For Stream
#include <string> // For Bands
#include <vector> // For Bands

class vtkAlgorithmOutput;
class vtkPointSet;
class vtkPolyData;

namespace tipp
{
template <int D>
struct Box;
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
   * The bands, see above. "elevation" alone by default; AddBand() adds one, and SetBand() replaces
   * all by one.
   */
  vtkTIPPNameListMacro(Band);
  ///@}

  ///@{
  /**
   * The width and height of a pixel, in the units of the points. 0 (the default): chosen so that
   * there is about one point per pixel.
   */
  vtkTIPPClampedMacro(Resolution, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Whether the pixels cover the bounds of the points that thinning keeps (the default), and
   * SamplingBounds is ignored. RequestInformation() then updates the input.
   */
  vtkTIPPSwitchMacro(UseInputBounds, bool);
  ///@}

  ///@{
  /**
   * The range to cover as (xmin, xmax, ymin, ymax), in the units of the points. (0, 1, 0, 1) by
   * default.
   */
  vtkSetVector4Macro(SamplingBounds, double);
  vtkGetVector4Macro(SamplingBounds, double);
  ///@}

  ///@{
  /**
   * Whether SamplingBounds that do not meet the points' bounding box, or are more than ten times as
   * long along an axis, are an error: they are probably in another order. Off by default: then
   * pixels far from the points have no value.
   */
  vtkTIPPSwitchMacro(StrictBounds, bool);
  ///@}

  ///@{
  /**
   * Whether pixel borders are at multiples of Resolution (the default), so that images of
   * neighbouring tiles fit together. If off, the first pixels start at the bounds.
   */
  vtkTIPPSwitchMacro(AlignToResolution, bool);
  ///@}

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
   * Files of lines in the formats of `tipp dem`, which replace the optional inputs. Empty or null
   * (the default): no files.
   */
  vtkTIPPFilePathMacro(BreaklinesFileName);
  vtkTIPPFilePathMacro(BoundaryFileName);
  ///@}

  ///@{
  /**
   * Whether the heights of breaklines are not used, as in files that have 0 for heights that are
   * not known. Their points then get the elevation of the surface without breaklines. Off by
   * default.
   */
  vtkTIPPSwitchMacro(SoftBreaklines, bool);
  ///@}

  ///@{
  /**
   * Triangles with an edge longer than this, measured in x and y in the units of the points, are
   * removed, so that pixels there have no value. 0 (the default): no limit.
   */
  vtkTIPPClampedMacro(MaximumEdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  /**
   * Which values coincident points get.
   */
  enum DuplicateType
  {
    DUPLICATES_FIRST = 0,   ///< the values of the first point
    DUPLICATES_LOWEST = 1,  ///< the values of the lowest point
    DUPLICATES_HIGHEST = 2, ///< the values of the highest point
    DUPLICATES_MEAN = 3     ///< the mean of each array
  };

  ///@{
  /**
   * A DuplicateType; DUPLICATES_FIRST by default.
   */
  vtkTIPPClampedMacro(Duplicates, int, DUPLICATES_FIRST, DUPLICATES_MEAN);
  ///@}

  /**
   * Which point thinning keeps in each square.
   */
  enum ThinningType
  {
    THIN_LOWEST = 0,
    THIN_HIGHEST = 1,
    THIN_NEAREST = 2 ///< to the centre of the square
  };

  ///@{
  /**
   * Thinning keeps one point in each square of this side, in the units of the points. 0 (the
   * default): no thinning.
   */
  vtkTIPPClampedMacro(ThinningSize, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * A ThinningType; THIN_NEAREST by default.
   */
  vtkTIPPClampedMacro(ThinningRule, int, THIN_LOWEST, THIN_NEAREST);
  ///@}

  ///@{
  /**
   * The memory limit of the triangulation, in bytes, not counting the input and the image; data
   * that does not fit is spilled to temporary files. 0 (the default): no limit.
   */
  vtkTIPPClampedMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0 (the default): OMP_NUM_THREADS, or as many as the processors
   * that this process may use, by its affinity, its control group and the ranks on this computer.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  ///@}

protected:
  vtkTIPPPointsToImage();
  ~vtkTIPPPointsToImage() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<std::string> Bands = { "elevation" };
  double Resolution = 0;
  bool UseInputBounds = true;
  double SamplingBounds[4] = { 0, 1, 0, 1 };
  bool StrictBounds = false;
  bool AlignToResolution = true;
  std::string BreaklinesFileName;
  std::string BoundaryFileName;
  bool SoftBreaklines = false;
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
  tipp::Box<2> PointBounds(vtkPointSet* points) const; // after thinning
  void Constrain(vtkPolyData* lines, vtkPolyData* boundary, tipp::DemRequest& request) const;
  void Make(vtkInformationVector** inputs, vtkImageData* output);
};

#endif

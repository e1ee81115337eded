// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPRefine2D
 * @brief   meshes of bounded angles and sizes between lines and polygons, in parallel
 *
 * vtkTIPPRefine2D computes the exact constrained Delaunay triangulation of a vtkPolyData's points,
 * lines and polygons in the x-y plane, and adds points until no triangle has an angle below
 * MinimumAngle or is too large: a mesh for finite elements. Every line and every edge of a polygon
 * is a chain of edges of the mesh.
 *
 * The domain is that of vtkTIPPDelaunay2D with a source: a triangle is kept if more
 * counter-clockwise than clockwise polygons surround it, so clockwise polygons are holes; if all
 * are clockwise, everything but the holes is kept. If there are only lines, the domain is what they
 * enclose; if there are neither, it is the convex hull of the points. With Convex it always is the
 * hull. Holes (AddHole()) are removed.
 *
 * Triangles are limited by MaximumArea, by the areas of regions (AddRegion()), and by an array of
 * edge lengths (SizeArrayName): where it has the value h, no triangle is larger than the
 * equilateral triangle of side h. The lengths are linear in the triangles of the input's
 * triangulation or, with a second input, in its triangles; outside of these there is no limit.
 *
 * The output is a vtkPolyData of counter-clockwise triangles. The input's points come first, with
 * the same ids, followed by points where lines cross and by those that refinement adds. If there
 * are new points, all are doubles. z and the point data of new points are interpolated along their
 * segment or, inside the domain, in the triangulation before refinement; global ids are left out.
 * Coincident points are merged into the one of lowest id, and points that are not finite are
 * ignored, with a warning; both stay in the output. The cell arrays are
 * - OutsideBounds (vtkUnsignedCharArray): 0 for triangles within the bounds. Others are above the
 *   limit of their area or have an angle below MinimumAngle, because 1: segments of the input meet
 *   at an angle below 60 degrees, 2: ShortestEdge or rounding allows no more points, 3: KeepBorder
 *   or KeepSegments forbids them, 4: MostPoints was reached.
 * - Region (vtkIntArray), if regions are given: the number of the triangle's region, or -1.
 * - ConstraintId (vtkIdTypeArray), with GenerateSegments.
 *
 * The result is the same for any number of threads. An aborted or failed run leaves the output
 * empty. A failure is reported as an error: for example a region's point outside the domain.
 *
 * The method is Delaunay refinement after Ruppert, *A Delaunay Refinement Algorithm for Quality
 * 2-Dimensional Mesh Generation* (1995), and Shewchuk, *Delaunay Refinement Algorithms for
 * Triangular Mesh Generation* (2002), with the off-centers of Üngör (2004).
 *
 * @warning It does not work in parallel over ranks: each rank requests the whole input and makes
 * the whole mesh.
 *
 * @sa
 * vtkTIPPDelaunay2D
 */

#ifndef vtkTIPPRefine2D_h
#define vtkTIPPRefine2D_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTIPPSetGet.h"        // For property macros

#include <array>   // For Holes
#include <cstdint> // For AddCells
#include <string>  // For SizeArrayName
#include <vector>  // For Holes

class vtkAlgorithmOutput;
class vtkPointSet;

namespace tipp
{
struct MeshRequest;
struct PointsMesh;
}

class VTKTIPPFILTERS_EXPORT vtkTIPPRefine2D : public vtkPolyDataAlgorithm
{
public:
  static vtkTIPPRefine2D* New();
  vtkTypeMacro(vtkTIPPRefine2D, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Why a triangle is outside of the bounds: the values of OutsideBounds.
   */
  enum OutsideType
  {
    NOT_OUTSIDE = 0,
    INPUT_ANGLE = 1,
    SHORTEST_EDGE = 2,
    KEPT_SEGMENTS = 3,
    MOST_POINTS = 4
  };

  ///@{
  /**
   * The mesh whose triangles and array SizeArrayName have the edge lengths. Its cells are cut into
   * triangles, and its z is ignored. None by default: the input's points have the array.
   */
  void SetSizeData(vtkPointSet*);
  void SetSizeConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  ///@}

  ///@{
  /**
   * The smallest angle of a triangle, in degrees, 0 to 34; 30 by default. Up to 20.7 refinement is
   * proved to end, up to 33 it usually does. 0: no bound. Other values are an error of the update,
   * as those of MaximumArea, ShortestEdge and MostPoints that are below 0.
   */
  vtkSetMacro(MinimumAngle, double);
  vtkGetMacro(MinimumAngle, double);
  ///@}

  ///@{
  /**
   * The largest area of a triangle, in the square of the points' unit. 0 (the default): no limit.
   */
  vtkSetMacro(MaximumArea, double);
  vtkGetMacro(MaximumArea, double);
  ///@}

  ///@{
  /**
   * The point array, of one component, with the wanted lengths of edges, in the points' unit: of
   * the second input if there is one, else of the input. All values must be above 0. None by
   * default.
   */
  vtkTIPPStringMacro(SizeArrayName);
  ///@}

  ///@{
  /**
   * A point in each hole: all triangles that are not separated from it by lines or polygons are
   * removed. None by default.
   */
  void AddHole(double x, double y);
  void ClearHoles();
  ///@}

  ///@{
  /**
   * Regions: all triangles that are not separated from the point (x, y) by lines or polygons, and
   * the largest area of their triangles; 0: no limit. The cell array Region has their numbers, from
   * 0. A triangle in several regions belongs to the last of them. None by default.
   */
  void AddRegion(double x, double y, double area);
  void ClearRegions();
  ///@}

  ///@{
  /**
   * Edges are not made shorter than this, in the points' unit; triangles that need shorter ones
   * stay as they are. 0 (the default): 2^-36 of the domain's longest side, or 2^-44 of the largest
   * coordinate if that is more.
   */
  vtkSetMacro(ShortestEdge, double);
  vtkGetMacro(ShortestEdge, double);
  ///@}

  ///@{
  /**
   * Whether no points are added on the border of the domain. Off by default.
   */
  vtkTIPPSwitchMacro(KeepBorder, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether no points are added on any line, on any edge of a polygon and on the border. Off by
   * default.
   */
  vtkTIPPSwitchMacro(KeepSegments, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the domain is the convex hull of the points, in which lines and polygons are edges but
   * enclose nothing. Off by default.
   */
  vtkTIPPSwitchMacro(Convex, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether lines that cross are split at a new point. If off, crossing lines are an error. On by
   * default.
   */
  vtkTIPPSwitchMacro(SplitCrossings, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the segments are output, too, as line cells before the triangles. The cell array
   * ConstraintId has for lines the id of the input's cell, or -1 on the border of no cell; for
   * triangles it is -1. For lines, OutsideBounds is 0 and Region is -1. Off by default.
   */
  vtkTIPPSwitchMacro(GenerateSegments, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The largest number of points that refinement adds. It then works in one thread. 0 (the
   * default): no limit.
   */
  vtkSetMacro(MostPoints, vtkIdType);
  vtkGetMacro(MostPoints, vtkIdType);
  ///@}

  ///@{
  /**
   * The largest number of rounds in which points that refinement added inside the domain are moved
   * towards the mean of their neighbours, where the smallest angles grow and all bounds hold. 0
   * (the default): none.
   */
  vtkSetMacro(SmoothingRounds, int);
  vtkGetMacro(SmoothingRounds, int);
  ///@}

  ///@{
  /**
   * A memory limit in bytes for the process while it makes the mesh: the mesh is in temporary files
   * then, and the result is the same. The input and the output are always in memory. 0 (the
   * default): no limit.
   */
  vtkTIPPClampedMacro(MemoryLimit, vtkTypeInt64, 0, VTK_TYPE_INT64_MAX);
  ///@}

  ///@{
  /**
   * With MemoryLimit: the folder of the temporary files, on a disk. None by default: the system's
   * folder for these, which may be in memory.
   */
  vtkTIPPFilePathMacro(ScratchFolder);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0 (the default): OMP_NUM_THREADS, or as many as the processors
   * that this process may use, by its affinity, its control group and the ranks on this computer.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

protected:
  vtkTIPPRefine2D();
  ~vtkTIPPRefine2D() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTIPPRefine2D(const vtkTIPPRefine2D&) = delete;
  void operator=(const vtkTIPPRefine2D&) = delete;

  void Execute(vtkPolyData* input, vtkPointSet* sizes, vtkPolyData* output);
  tipp::MeshRequest Request() const;
  void AddCells(
    tipp::PointsMesh& mesh, const std::vector<std::int64_t>& cells, vtkPolyData* output) const;

  double MinimumAngle = 30;
  double MaximumArea = 0;
  std::string SizeArrayName;
  std::vector<std::array<double, 2>> Holes;
  std::vector<std::array<double, 3>> Regions; ///< x, y and the largest area
  double ShortestEdge = 0;
  vtkTypeBool KeepBorder = 0;
  vtkTypeBool KeepSegments = 0;
  vtkTypeBool Convex = 0;
  vtkTypeBool SplitCrossings = 1;
  vtkTypeBool GenerateSegments = 0;
  vtkIdType MostPoints = 0;
  int SmoothingRounds = 0;
  vtkTypeInt64 MemoryLimit = 0;
  std::string ScratchFolder;
  int NumberOfThreads = 0;
};

#endif

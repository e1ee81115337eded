// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartitionedMeshQuery
 * @brief   evaluates a mesh at points, and finds neighbours of its points and cells
 *
 * As a filter it has the ports of vtkProbeFilter: the first input is a data set, at whose points
 * the mesh is evaluated; the second, the source, is the mesh, a vtkPointSet of triangles,
 * tetrahedra or cells that can be divided into these. Instead of a source, FileName can name a
 * partitioned mesh on disk of any size: its pieces are read when a point needs them and are kept in
 * memory within MemoryLimit. The output is the first input with the mesh's arrays at its points,
 * with "CellId", the global id of the cell that holds each point (-1: outside), and the mask
 * "vtkValidPointMask". Floating-point point arrays are interpolated linearly, integer point arrays
 * are taken from the corner of largest weight, cell arrays from the cell. Triangles are located by
 * x and y; their z is sampled as the array "elevation", unless the mesh has an array of this name.
 *
 * Unlike vtkProbeFilter it has no tolerance. A point on an edge, face or corner belongs to exactly
 * one cell, by the rule of vtkRangeResampleFilter. So the values depend neither on pieces, ranks
 * and threads nor on the order of points.
 *
 * The other methods query the same mesh without the pipeline. They return 1, or 0 after an error.
 * Ids are global: those of a stored mesh, or the source's global ids, or else indices into the
 * source. Several threads may call these methods at once.
 *
 * With a Controller of several ranks, all ranks must update the filter together, and must call the
 * collective methods together: Locate(), Interpolate(), InterpolateOnOwners(), ZoneStatistics(),
 * Descend() and the methods from Neighbors() to Closest(). Each rank handles some pieces of the
 * stored mesh, or has a part of the source; every rank's query is answered from the cells of all
 * ranks. A rank may pass no points or ids, and may have no cells.
 *
 * @sa
 * vtkProbeFilter vtkRangeResampleFilter vtkPartitionedUnstructuredReader
 */

#ifndef vtkPartitionedMeshQuery_h
#define vtkPartitionedMeshQuery_h

#include "vtkDataSetAlgorithm.h"
#include "vtkMultiProcessController.h" // For the Controller
#include "vtkSmartPointer.h"           // For the Controller
#include "vtkTIPPFiltersModule.h"      // For export macro
#include "vtkTIPPSetGet.h"             // For property macros

#include <functional> // For Direct
#include <memory>     // For Mesh
#include <mutex>      // For Opening
#include <string>     // For Arrays
#include <utility>    // For GetRank
#include <vector>     // For Arrays

class vtkDataArray;
class vtkDataSetAttributes;
class vtkIdTypeArray;
class vtkDoubleArray;
class vtkPolyData;
class vtkStringArray;

namespace tipp
{
class Communicator;
struct AnswerOptions;
struct MeshAnswer;
template <int D>
struct Point;
class ResidentMesh;
}

class VTKTIPPFILTERS_EXPORT vtkPartitionedMeshQuery : public vtkDataSetAlgorithm
{
public:
  static vtkPartitionedMeshQuery* New();
  vtkTypeMacro(vtkPartitionedMeshQuery, vtkDataSetAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The mesh, if it is in memory: a vtkPointSet, or a composite data set of which one part has
   * cells.
   */
  void SetSourceConnection(vtkAlgorithmOutput* source) { this->SetInputConnection(1, source); }
  void SetSourceData(vtkDataObject* source) { this->SetInputData(1, source); }
  vtkDataObject* GetSource();
  ///@}

  ///@{
  /**
   * The mesh, if it is stored: the folder of a partitioned mesh, or the index in it. It takes
   * precedence over a source. Default: none.
   */
  vtkTIPPFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The memory limit, in bytes, for pieces of a stored mesh and their search structures. A query
   * that needs more for a single piece is an error. Default: 2^30.
   */
  vtkTIPPClampedMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  ///@}

  ///@{
  /**
   * The time step at which a stored mesh's time-varying arrays are evaluated, as an index from 0.
   * Default: 0.
   */
  vtkTIPPClampedMacro(Step, int, 0, VTK_INT_MAX);
  ///@}

  ///@{
  /**
   * The names of the arrays to evaluate. Default: an empty list, which evaluates all arrays.
   */
  vtkTIPPNameListMacro(Array);
  ///@}

  ///@{
  /**
   * The value of floating-point arrays at points outside of the mesh; integer arrays are 0 there.
   * Default: 0, as in vtkProbeFilter.
   */
  vtkSetMacro(NullValue, double);
  vtkGetMacro(NullValue, double);
  ///@}

  ///@{
  /**
   * Whether the first input's point, cell and field arrays are passed to the output. Default: on
   * for field arrays, off for the others, as in vtkProbeFilter.
   */
  vtkTIPPSwitchMacro(PassPointArrays, bool);
  vtkTIPPSwitchMacro(PassCellArrays, bool);
  vtkTIPPSwitchMacro(PassFieldArrays, bool);
  ///@}

  ///@{
  /**
   * The name of the mask. Default: "vtkValidPointMask".
   */
  vtkTIPPStringMacro(ValidPointMaskArrayName);
  ///@}

  ///@{
  /**
   * The number of threads. 0 (the default): OMP_NUM_THREADS, or as many as the processors that
   * this process may use, by its affinity, its control group and the ranks on this computer.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

  ///@{
  /**
   * The ranks that work together. The global controller by default. With null this process works
   * alone.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * Finds the cells that contain points, given as tuples of two or three coordinates. `cells` gets
   * one global id per point, -1 outside. `weights`, which may be null, gets the barycentric weights
   * of each cell's corners. Collective.
   */
  int Locate(vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* weights = nullptr);

  /**
   * Evaluates the mesh's arrays at points and adds them to `values`; outside of the mesh,
   * floating-point values are NaN. `cells`, which may be null, gets the cells that contain the
   * points. Collective.
   */
  int Interpolate(
    vtkDataArray* points, vtkDataSetAttributes* values, vtkIdTypeArray* cells = nullptr);

  /**
   * Like Interpolate(), but the values stay on the rank that has the cell. `values` gets all ranks'
   * points that lie in this rank's cells, with the mesh's arrays, "CellId", and the rank that
   * passed each point ("AskingRank") and its index there ("AskingId"). Points outside of the mesh
   * are on no rank. Collective.
   */
  int InterpolateOnOwners(vtkDataArray* points, vtkPolyData* values);

  /**
   * Adds the names of the mesh's arrays, including "elevation", to `names`.
   */
  int GetNamesOfArrays(vtkStringArray* names);

  /**
   * Returns 2 for a mesh of triangles, 3 for tetrahedra, 0 after an error.
   */
  int GetMeshDimension();

  /**
   * Finds, for each cell and each of its corners, the cell across the opposite edge or face, or -1.
   * `neighbors` gets three or four ids per cell. This and the following methods up to Profile() are
   * collective. A source that is distributed over several ranks needs global ids of points and
   * cells. Lines are output on the first rank.
   */
  int Neighbors(vtkIdTypeArray* cells, vtkIdTypeArray* neighbors);

  ///@{
  /**
   * Finds a list of ids, ascending, for each point or cell: ids[starts[i]] to ids[starts[i + 1] -
   * 1]. Star: the cells at each point. RingOfPoints: the points within 1 to k edges of each point.
   * RingOfCells: the cells within 1 to k steps of each cell, where a step leads to any cell that
   * shares a point.
   */
  int Star(vtkIdTypeArray* points, vtkIdTypeArray* starts, vtkIdTypeArray* ids);
  int RingOfPoints(vtkIdTypeArray* points, int k, vtkIdTypeArray* starts, vtkIdTypeArray* ids);
  int RingOfCells(vtkIdTypeArray* cells, int k, vtkIdTypeArray* starts, vtkIdTypeArray* ids);
  ///@}

  /**
   * Extracts the border of a mesh of triangles as closed lines, with the mesh on their left. The
   * points have "GlobalPointIds".
   */
  int Boundary(vtkPolyData* loops);

  /**
   * Finds the connected component of each cell (connected by edges of triangles or faces of
   * tetrahedra) and the number of cells of each component. Components are numbered from 0 in the
   * order of their lowest cell ids. `cells`, which may be null, gets the ids of the cells. On
   * several ranks each rank gets the components of its own cells, and all get the sizes.
   */
  int Components(vtkIdTypeArray* ofCells, vtkIdTypeArray* sizes, vtkIdTypeArray* cells = nullptr);

  /**
   * Computes the contour lines of a component of a point array on a mesh of triangles. Lines
   * continue across pieces, with higher values on the left; the output array of the same name has
   * each line's level.
   */
  int Contours(const char* array, int component, vtkDoubleArray* levels, vtkPolyData* lines);

  /**
   * Samples the arrays along a polyline: at its corners and every `spacing`, in the units of the
   * points; or, with spacing 0, at its corners and where it crosses an edge of a triangle or a face
   * of a tetrahedron. The output points have "Distance", measured along x and y, and "CellId". With
   * spacing 0, CellId is the cell between a point and the next one, -1 before a gap.
   */
  int Profile(vtkDataArray* polyline, double spacing, vtkPolyData* line);

  /**
   * Finds the location on the mesh nearest to each point, its cell (-1 if the mesh has no cells)
   * and the distance (0 inside). Of several nearest cells the one with the lowest id is returned.
   * For triangles, distances are measured in x and y. `locations` and `distances` may be null.
   */
  int Closest(vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* locations = nullptr,
    vtkDoubleArray* distances = nullptr);

  ///@{
  /**
   * Finds the cells that share a point with a closed box or with closed polygons, or with `whole`
   * only the cells inside; or the mesh's points inside. The box has the order of GetBounds(); its z
   * range applies to tetrahedra only. Polygons are given as polygons and closed lines; those with a
   * nonzero cell array "IsHole" are holes. Over tetrahedra polygons are columns of unlimited
   * height. On several ranks these methods need a stored mesh; they are not collective.
   */
  int CellsInBox(const double box[6], bool whole, vtkIdTypeArray* cells);
  int CellsInPolygons(vtkPolyData* polygons, bool whole, vtkIdTypeArray* cells);
  int PointsInBox(const double box[6], vtkIdTypeArray* points);
  int PointsInPolygons(vtkPolyData* polygons, vtkIdTypeArray* points);
  ///@}

  /**
   * Computes statistics of a component of an array over the part of the triangles inside each zone,
   * clipped exactly at the zone's border. Adds the arrays "Cells", "Area", "Minimum", "Maximum",
   * "Mean", "Integral" and "VolumeAbove" (the volume above `level`) to `statistics`, one tuple per
   * zone. A zone is a polygon, or all polygons with the same value of the cell array "ZoneId"; see
   * CellsInPolygons() for holes. Collective: the first rank's zones are used, and every rank gets
   * the statistics over all cells.
   */
  int ZoneStatistics(vtkPolyData* zones, const char* array, int component, double level,
    vtkDataSetAttributes* statistics);

  /**
   * Follows the steepest descent of a component of a point array, on a mesh of triangles, from each
   * point to a pit. Each line has the cell arrays "StartId", the index of its start in `points`,
   * and "PitId", the id of the mesh point that it ends at, or -1. The point array of the same name
   * has the values along the line. Collective: each rank gets the lines of its own points; several
   * ranks need a stored mesh.
   */
  int Descend(vtkDataArray* points, const char* array, int component, vtkPolyData* lines);

protected:
  vtkPartitionedMeshQuery();
  ~vtkPartitionedMeshQuery() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*) override;
  int RequestData(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPartitionedMeshQuery(const vtkPartitionedMeshQuery&) = delete;
  void operator=(const vtkPartitionedMeshQuery&) = delete;

  std::shared_ptr<const tipp::ResidentMesh> Open();
  std::vector<std::string> ArraysOf(
    tipp::Communicator* ranks, const tipp::ResidentMesh& mesh) const;
  tipp::MeshAnswer Ask(const std::vector<tipp::Point<3>>& points, bool weights, bool arrays);
  int Try(const std::function<void()>& work);
  int Direct(const std::function<void()>& work);
  using Question = std::function<void(tipp::Communicator*, const tipp::ResidentMesh&)>;
  void AskMesh(const Question& ask);
  int Around(const Question& ask);
  std::shared_ptr<const tipp::ResidentMesh> OpenWhole();
  std::pair<int, int> GetRank() const;

  std::string FileName;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 30;
  int Step = 0;
  std::vector<std::string> Arrays;
  double NullValue = 0;
  bool PassPointArrays = false;
  bool PassCellArrays = false;
  bool PassFieldArrays = true;
  std::string ValidPointMaskArrayName = "vtkValidPointMask";
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

  std::mutex Opening;
  std::shared_ptr<const tipp::ResidentMesh> Mesh;
  std::string Opened; ///< identifies the input and settings that Mesh was built from
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartitionedMeshQuery
 * @brief   the values of a mesh at points, and what lies around its points and cells
 *
 * As a filter it has the ports of vtkProbeFilter: the first input is a data set whose points are
 * asked for; the second, the source, is the mesh, a vtkPointSet of triangles, tetrahedra or cells
 * that can be cut into these. Instead of a source the mesh can be FileName, a partitioned mesh on
 * disk of any size: its pieces are read when a point needs them and stay in memory within
 * MemoryLimit. The output is the first input with the mesh's arrays at its points, with "CellId",
 * the global id of the cell that holds each point (-1: outside), and the mask "vtkValidPointMask".
 * Floating-point point arrays are interpolated linearly, whole numbers are taken from the corner of
 * largest weight, cell arrays from the cell. Triangles are found by x and y, and their z is the
 * array "elevation" unless an array has this name.
 *
 * Unlike vtkProbeFilter it has no tolerance. A point on an edge, a face or a corner belongs to one
 * cell by the rule of vtkRangeResampleFilter, decided exactly. So the values depend neither on
 * pieces, ranks and threads nor on the order of points.
 *
 * The other methods ask the same mesh directly. They return 1, or after an error 0. Ids are global:
 * of a stored mesh those of its source, else indices. Several threads may call them at once.
 *
 * With a Controller of several ranks all must update the filter, or call Locate(), Interpolate(),
 * InterpolateOnOwners(), ZoneStatistics(), Descend() and the methods from Neighbors() to Closest(),
 * together. They share out the pieces of the stored mesh, or each has a part of the source; every
 * rank's points and ids are answered by all ranks' cells. A rank may ask for nothing, or have no
 * cells.
 *
 * @sa
 * vtkProbeFilter vtkRangeResampleFilter vtkPartitionedUnstructuredReader
 */

#ifndef vtkPartitionedMeshQuery_h
#define vtkPartitionedMeshQuery_h

#include "vtkDataSetAlgorithm.h"
#include "vtkTIPPFiltersModule.h" // For export macro

#include <functional> // For Direct
#include <memory>     // For Mesh
#include <mutex>      // For Opening
#include <string>     // For ArrayNames
#include <vector>     // For ArrayNames

class vtkDataArray;
class vtkDataSetAttributes;
class vtkIdTypeArray;
class vtkDoubleArray;
class vtkMultiProcessController;
class vtkPolyData;
class vtkStringArray;

namespace tipp
{
class Communicator;
struct AnswerOptions;
struct MeshAnswer;
struct Point3;
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
   * The mesh, if it is in memory: a vtkPointSet, or a composite of which one part has cells.
   */
  void SetSourceConnection(vtkAlgorithmOutput* source) { this->SetInputConnection(1, source); }
  void SetSourceData(vtkDataObject* source) { this->SetInputData(1, source); }
  vtkDataObject* GetSource();
  ///@}

  ///@{
  /**
   * The mesh, if it is stored: the folder of a partitioned mesh or the index in it. It takes the
   * place of a source. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Bytes for the pieces of a stored mesh that are in memory, and what is made to search them. A
   * query that needs more for one piece is an error. Default: 2^30.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * The step of a stored mesh's arrays that vary in time, counted from 0. Default: 0.
   */
  vtkSetClampMacro(Step, int, 0, VTK_INT_MAX);
  vtkGetMacro(Step, int);
  ///@}

  ///@{
  /**
   * The arrays to evaluate, by name. Default: none are named, and all are evaluated.
   */
  void AddArray(const char* name);
  void ClearArrays();
  int GetNumberOfArrays() const;
  const char* GetArray(int index) const;
  ///@}

  ///@{
  /**
   * The value of floating-point arrays outside of the mesh; those of whole numbers have 0 there.
   * Default: 0, as in vtkProbeFilter.
   */
  vtkSetMacro(NullValue, double);
  vtkGetMacro(NullValue, double);
  ///@}

  ///@{
  /**
   * Whether the output also has the point, cell and field arrays of the first input. Default: on
   * for field arrays, off for the others, as in vtkProbeFilter.
   */
  vtkSetMacro(PassPointArrays, bool);
  vtkGetMacro(PassPointArrays, bool);
  vtkBooleanMacro(PassPointArrays, bool);
  vtkSetMacro(PassCellArrays, bool);
  vtkGetMacro(PassCellArrays, bool);
  vtkBooleanMacro(PassCellArrays, bool);
  vtkSetMacro(PassFieldArrays, bool);
  vtkGetMacro(PassFieldArrays, bool);
  vtkBooleanMacro(PassFieldArrays, bool);
  ///@}

  ///@{
  /**
   * The name of the mask. Default: "vtkValidPointMask".
   */
  vtkSetStringMacro(ValidPointMaskArrayName);
  vtkGetStringMacro(ValidPointMaskArrayName);
  ///@}

  ///@{
  /**
   * Number of threads. Default 0: as many as OpenMP would take.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * The ranks that work together. Default: the global controller; null: this process alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * Finds the cells that hold points: tuples of two or three coordinates. `weights`, which may be
   * null, gets the barycentric weights of each cell's corners. Collective.
   */
  int Locate(vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* weights = nullptr);

  /**
   * Adds the mesh's arrays at points to `values`; outside floating-point numbers are NaN. `cells`,
   * which may be null, gets the cells that hold the points. Collective.
   */
  int Interpolate(
    vtkDataArray* points, vtkDataSetAttributes* values, vtkIdTypeArray* cells = nullptr);

  /**
   * As Interpolate(), but the values stay on the rank that has the cell. `values` gets the points
   * of all ranks in this rank's cells, with the mesh's arrays, "CellId", and the "AskingRank" and
   * "AskingId", which tell whose point it is and its number there. Points outside of the mesh are
   * on no rank. Collective.
   */
  int InterpolateOnOwners(vtkDataArray* points, vtkPolyData* values);

  /**
   * Names of the arrays that the mesh has, "elevation" among them, are added to `names`.
   */
  int GetNamesOfArrays(vtkStringArray* names);

  /**
   * 2 for a mesh of triangles, 3 for tetrahedra, 0 after an error.
   */
  int GetMeshDimension();

  /**
   * For each cell and each of its corners the cell across the face opposite to that corner; -1:
   * there is none. This and the methods down to Profile() are collective; parts of a source on
   * several ranks need global ids of points and cells, and lines are made on the first rank.
   */
  int Neighbors(vtkIdTypeArray* cells, vtkIdTypeArray* neighbors);

  ///@{
  /**
   * Lists of ids, ascending, one after the other; list i is at the indices starts[i] ...
   * starts[i + 1] - 1 of `ids`. Star: the cells at each point. RingOfPoints: the points that 1 to k
   * edges lead to. RingOfCells: the cells in 1 to k steps, each to a cell that shares a point.
   */
  int Star(vtkIdTypeArray* points, vtkIdTypeArray* starts, vtkIdTypeArray* ids);
  int RingOfPoints(vtkIdTypeArray* points, int k, vtkIdTypeArray* starts, vtkIdTypeArray* ids);
  int RingOfCells(vtkIdTypeArray* cells, int k, vtkIdTypeArray* starts, vtkIdTypeArray* ids);
  ///@}

  /**
   * Makes closed lines of the border of a mesh of triangles, which lies on their left. The points
   * have "GlobalPointIds".
   */
  int Boundary(vtkPolyData* loops);

  /**
   * The connected component of each cell, by common faces, and the number of cells of each
   * component. Components are numbered by their lowest cell. `cells`, which may be null, gets the
   * ids of the cells. On several ranks each gets its own cells, and all get the sizes.
   */
  int Components(vtkIdTypeArray* ofCells, vtkIdTypeArray* sizes, vtkIdTypeArray* cells = nullptr);

  /**
   * Makes lines where a component of an array of points has one of the levels, on a mesh of
   * triangles. Lines go on across pieces, with the higher side on the left; the array of that name
   * has each line's level.
   */
  int Contours(const char* array, int component, vtkDoubleArray* levels, vtkPolyData* lines);

  /**
   * Samples the arrays along a polyline, every `spacing` and at the polyline's corners; with
   * spacing 0 at the corners and where the polyline crosses an edge of triangles or a face of
   * tetrahedra. The line's points have "Distance" along x and y, and "CellId"; with spacing 0 this
   * is the cell up to the next point, -1 before a gap.
   */
  int Profile(vtkDataArray* polyline, double spacing, vtkPolyData* line);

  /**
   * Finds the nearest location of the mesh to each point, its cell (-1: the mesh has none) and the
   * distance, 0 inside. Of cells that are as near the one with the lowest id counts. Triangles are
   * measured in x and y. `locations` and `distances` may be null.
   */
  int Closest(vtkDataArray* points, vtkIdTypeArray* cells, vtkDoubleArray* locations = nullptr,
    vtkDoubleArray* distances = nullptr);

  ///@{
  /**
   * The cells that have a point of a box, or of polygons, with their border, or
   * with `whole` that lie in it; or the mesh's points there. The box is that of GetBounds(); z
   * counts for tetrahedra. Of polygons x and y count; over tetrahedra they are columns. They are
   * the polygons and closed lines of a data set; a cell array "IsHole" that is not 0 makes holes.
   * On several ranks each asks a stored mesh by itself.
   */
  int CellsInBox(const double box[6], bool whole, vtkIdTypeArray* cells);
  int CellsInPolygons(vtkPolyData* polygons, bool whole, vtkIdTypeArray* cells);
  int PointsInBox(const double box[6], vtkIdTypeArray* points);
  int PointsInPolygons(vtkPolyData* polygons, vtkIdTypeArray* points);
  ///@}

  /**
   * Adds the arrays "Cells", "Area", "Minimum", "Maximum", "Mean", "Integral" and "VolumeAbove" to
   * `statistics`, of a component of an array on the part of the triangles in each zone; what cells
   * have in it is cut exactly at its border. A zone is a polygon, or all that have its number in
   * the cell array "ZoneId"; see CellsInPolygons() for holes. The volume is that above `level`.
   * Collective: the first rank's zones count, and every rank gets the statistics of all cells.
   */
  int ZoneStatistics(vtkPolyData* zones, const char* array, int component, double level,
    vtkDataSetAttributes* statistics);

  /**
   * Follows the steepest descent of a component of an array of points, on a mesh of triangles, from
   * each point to a pit. Each line has as cell arrays "StartId", the number of its first point
   * among `points`, and "PitId", the mesh's point that it ends at, or -1. The array of that name
   * has the values along it. Collective: each rank gets the lines of its points; several ranks need
   * a stored mesh.
   */
  int Descend(vtkDataArray* points, const char* array, int component, vtkPolyData* lines);

protected:
  vtkPartitionedMeshQuery();
  ~vtkPartitionedMeshQuery() override;

  vtkExecutive* CreateDefaultExecutive() override;
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
  tipp::MeshAnswer Ask(const std::vector<tipp::Point3>& points, bool weights, bool arrays);
  int Try(const std::function<void()>& work);
  int Direct(const std::function<void()>& work);
  int Around(const std::function<void(tipp::Communicator*, const tipp::ResidentMesh&)>& ask);
  std::shared_ptr<const tipp::ResidentMesh> OpenWhole();

  char* FileName = nullptr;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 30;
  int Step = 0;
  std::vector<std::string> ArrayNames;
  double NullValue = 0;
  bool PassPointArrays = false;
  bool PassCellArrays = false;
  bool PassFieldArrays = true;
  char* ValidPointMaskArrayName = nullptr;
  int NumberOfThreads = 0;
  vtkMultiProcessController* Controller = nullptr;

  std::mutex Opening;
  std::shared_ptr<const tipp::ResidentMesh> Mesh;
  std::string Opened; ///< what Mesh was made of
};

#endif

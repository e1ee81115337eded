// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPDelaunay2D
 * @brief   exact 2D Delaunay triangulation of many points, in parallel
 *
 * vtkTIPPDelaunay2D triangulates the points of any vtkPointSet in a plane: the x-y plane (z is
 * ignored but kept), the plane that Transform maps them to, or the plane that fits them best. It is
 * a drop-in replacement for vtkDelaunay2D: its properties have the same names, meanings and numeric
 * values. The differences are listed below.
 *
 * The result is exact. All predicates are evaluated without rounding error, the border is the
 * convex hull, every distinct point is a vertex, and every triangle is counter-clockwise in the
 * plane. Where four or more points lie on one circle, the choice among the possible triangulations
 * depends only on the coordinates, so the set of triangles is the same for every order of the
 * points, NumberOfPartitions, Schedule and NumberOfThreads.
 *
 * Output port 0 is a vtkPolyData with the input's own vtkPoints (the same object, so the same order
 * and precision), all of its point data, and triangles that index these points. Points that no
 * triangle uses stay in the output. The connectivity is stored with 32-bit ids if they fit; on
 * several ranks it always has 64 bits.
 *
 * Coincident points are merged into the one of lowest id. Points with a NaN or infinite coordinate
 * in the plane are rejected, with one warning. If there is a merged or rejected point, the output
 * has the point array "RepresentativePointId" (see GenerateRepresentativeIds). With fewer than
 * three distinct points, or if all points are collinear, the output has no triangles and a warning
 * is issued.
 *
 * Output port 1, also returned by GetStatistics(), is a vtkTable with statistics of the run. It has
 * a row for each stage, with the columns
 * - Stage: 0, 1, ...
 * - ActivePartitions: the partitions triangulated in this stage
 * - MeshTriangles: the unfinished triangles in memory when the stage began
 *
 * The field data has arrays of one value each: Points, Triangles (before Alpha), DuplicatePoints,
 * RejectedPoints, Partitions, InitialPoints, WorkerVertices (vertices triangulated by all workers
 * together) and Threads. PhaseName and PhaseSeconds (wall-clock seconds) have one value for each
 * phase. In Python, with the filter `f`:
 * @code{.py}
 * from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
 * table = WrapDataObject(f.GetStatistics())
 * pandas.DataFrame({name: table.RowData[name] for name in table.RowData.keys()})
 * @endcode
 *
 * With a Controller of several ranks, all ranks must update the filter together. They triangulate
 * the points of all ranks into one exact triangulation, which depends neither on the number of
 * ranks nor on which rank holds which points. Coincident points of all ranks are merged. Each
 * rank's output is a piece: its triangles (each triangle is on exactly one rank) and the points
 * that they use, with those point arrays that every rank with points has. "GlobalPointIds" holds
 * the input's global ids; if it has none, points are numbered consecutively by rank.
 * "GlobalCellIds" numbers the triangles 0, 1, ... over all ranks. If ghost cells are requested
 * downstream, one layer is added and marked in vtkGhostType: the triangles of other ranks that
 * share a point with the piece. Merged points are in no piece; with GenerateRepresentativeIds the
 * field data has the arrays "DuplicatePointIds", "DuplicateRepresentativeIds" and
 * "RejectedPointIds" (global ids) for the points found on this rank. Port 1 has the same table on
 * every rank: its rows are the stages of the first master, if there is one; its field data adds,
 * indexed by rank, "RankComputeSeconds", "RankWaitSeconds", "RankSendSeconds", "RankOwnedPoints"
 * and "RankTriangles"; "MasterSeconds", "LargestMasterMesh"; "MessageKind", "MessageCount" and
 * "MessageBytes". If one rank fails, all fail and the first rank reports the error. That includes
 * failures upstream, unless the application sets its own default executive
 * (vtkAlgorithm::SetDefaultExecutivePrototype), as ParaView does. The Alpha, Tolerance,
 * MaximumEdgeLength, BoundingTriangulation, GenerateNeighborIds and best fitting plane of the first
 * rank count for all; points within the Tolerance are merged by ascending global id, and
 * "NeighborIds" are those of "GlobalCellIds". With Alpha each cell of the alpha shape is on one
 * rank, and there are no ghost cells.
 *
 * An aborted or failed run leaves both outputs empty. A failure is reported as an error.
 *
 * With a second input, the source, the result is the constrained Delaunay triangulation, which is
 * exact and unique too: every edge of the source's lines and polygons is a chain of edges of the
 * output. Polygons also define the inside: a triangle is kept if more counter-clockwise than
 * clockwise polygons surround it, so clockwise polygons are holes. If all polygons are clockwise,
 * everything but the holes is kept. The source's cells refer to the points of the first input by
 * id, and the source's own coordinates are ignored (unless MergeSourcePoints is on). Constraints
 * may overlap, coincide and pass through points. Where two cross and there is no point, a new one
 * is added after the input's points (see SplitCrossings): its coordinates in the plane are those of
 * the crossing, rounded, and its point data are interpolated between the points beside it on the
 * edge that comes first in the source; the output's points are doubles then. Tolerance cannot be
 * combined with a source. The statistics also have the field data Constraints, ConstraintEdges,
 * CrossingPoints and CrossingRounds. On several ranks the sources of all ranks are combined; a cell
 * that several ranks have counts once. Their point ids are the input's global ids or, without
 * these, consecutive by rank. New points get ids after all others.
 *
 * Differences from vtkDelaunay2D: Tolerance is 0 by default. A transform that is set while
 * ProjectionPlaneMode is VTK_BEST_FITTING_PLANE is ignored instead of replacing the plane.
 * VTK_SET_TRANSFORM_PLANE without a transform is an error. With Alpha, merged and rejected points
 * get no vertex cells. Every constraint is enforced, where vtkDelaunay2D may warn and skip it;
 * polygons may be nested.
 *
 * Publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapter 2.
 *
 * @sa vtkDelaunay2D
 */

#ifndef vtkTIPPDelaunay2D_h
#define vtkTIPPDelaunay2D_h

#include "vtkAbstractTransform.h"      // For the Transform
#include "vtkMultiProcessController.h" // For the Controller
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"      // For smart pointer
#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTIPPSetGet.h"        // For property macros

class vtkAlgorithmOutput;
class vtkPoints;
class vtkPointSet;
class vtkTable;

namespace tipp
{
struct ConstrainedTriangulation;
struct SourceConstraints;
struct Triangulation;
}

// vtkDelaunay2D.h defines the same.
#define VTK_DELAUNAY_XY_PLANE 0
#define VTK_SET_TRANSFORM_PLANE 1
#define VTK_BEST_FITTING_PLANE 2

class VTKTIPPFILTERS_EXPORT vtkTIPPDelaunay2D : public vtkPolyDataAlgorithm
{
public:
  static vtkTIPPDelaunay2D* New();
  vtkTypeMacro(vtkTIPPDelaunay2D, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * How partitions are scheduled on the threads.
   */
  enum ScheduleType
  {
    STAGES = 0,           ///< a barrier after each set of independent partitions
    DYNAMIC = 1,          ///< a partition starts as soon as all conflicting earlier ones are done
    PRODUCER_CONSUMER = 2 ///< as STAGES; on several ranks without a barrier between waves
  };

  /**
   * How several ranks share the work.
   */
  enum MastersType
  {
    AUTO_MASTERS = 0,  ///< no master: each rank triangulates the partitions it owns
    SINGLE_MASTER = 1, ///< one master hands out all partitions (Algorithm 1)
    MULTI_MASTER = 2   ///< a master hands major partitions to sub-masters (Algorithm 3)
  };

  /**
   * How several ranks divide the domain, or each major partition, into partitions.
   */
  enum MinorDivisionType
  {
    TREE = 0,     ///< boxes with equally many points
    THRESHOLD = 1 ///< square grids of boxes with about PointsPerPartition points (equation 3.1)
  };

  /**
   * How the output marks the edges that are constraints.
   */
  enum ConstraintMarksType
  {
    NO_MARKS = 0,  ///< not at all
    LINES = 1,     ///< as line cells before the triangles, with the cell array "ConstraintId"
    EDGE_FLAGS = 2 ///< in the cell array "ConstraintEdges"
  };

  ///@{
  /**
   * The constraints: a vtkPolyData of lines and polygons, whose edges become edges of the output.
   * None by default.
   */
  void SetSourceData(vtkPolyData*);
  void SetSourceConnection(vtkAlgorithmOutput* output) { this->SetInputConnection(1, output); }
  vtkPolyData* GetSource();
  ///@}

  ///@{
  /**
   * Whether the source's cells refer to the source's own points. Those that coincide with a point
   * of the input, in the plane, are merged into it; the others are triangulated too and come after
   * the input's points, with the source's point data. Point arrays that the source lacks are then
   * omitted, with a warning. Off by default: the source's cells refer to the input's points.
   */
  vtkTIPPSwitchMacro(MergeSourcePoints, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether constraints that cross are split at a new point. If off, crossing constraints are an
   * error. On by default.
   */
  vtkTIPPSwitchMacro(SplitCrossings, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A ConstraintMarksType; NO_MARKS by default. LINES: "ConstraintId" is the id of the source's
   * cell that a line belongs to, and -1 for triangles; NeighborIds are not available. On several
   * ranks each line is on one rank that has a triangle beside it, lines outside of the polygons are
   * omitted, and the cells of all different sources are numbered consecutively by rank. EDGE_FLAGS:
   * three components, 1 if the edge opposite to that corner of the triangle is part of a
   * constraint, else 0. With Alpha constraints are not marked, and a warning is issued.
   */
  vtkTIPPClampedMacro(ConstraintMarks, int, NO_MARKS, EDGE_FLAGS);
  ///@}

  ///@{
  /**
   * The largest circumradius of the output's cells, in the units of the points. 0 (the default)
   * outputs all triangles and nothing else. With any other value the output has the triangles of at
   * most this circumradius; as lines, the edges of the other triangles that are at most twice as
   * long and belong to no output triangle; and the remaining points as vertices. Lengths are
   * measured in space, not in the plane.
   */
  vtkTIPPClampedMacro(Alpha, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Which kinds of cells are output if Alpha is not 0. Each switch affects only its own kind. All
   * are on by default.
   */
  vtkTIPPSwitchMacro(AlphaTris, vtkTypeBool);
  vtkTIPPSwitchMacro(AlphaLines, vtkTypeBool);
  vtkTIPPSwitchMacro(AlphaVerts, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Triangles with an edge longer than this, measured in the plane in the units of the points, are
   * removed; their points stay. 0 (the default): no limit. Unlike Alpha, it adds no lines or
   * vertices.
   */
  vtkTIPPClampedMacro(MaximumEdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * The plane of the triangulation. VTK_DELAUNAY_XY_PLANE (the default): x and y of the points,
   * transformed by Transform if there is one. VTK_SET_TRANSFORM_PLANE: the same, but it is an error
   * if there is no Transform. VTK_BEST_FITTING_PLANE: see ComputeBestFittingPlane.
   */
  vtkTIPPClampedMacro(ProjectionPlaneMode, int, VTK_DELAUNAY_XY_PLANE, VTK_BEST_FITTING_PLANE);
  ///@}

  ///@{
  /**
   * The transform applied to the points before their x and y are triangulated; the output's points
   * are not transformed. It need be neither linear nor invertible. None by default.
   */
  vtkSetSmartPointerMacro(Transform, vtkAbstractTransform);
  vtkGetSmartPointerMacro(Transform, vtkAbstractTransform);
  ///@}

  /**
   * Returns the transform that maps the least-squares plane of the points to the plane z = 0 and
   * their centroid to the origin. Points with a NaN or infinite coordinate are ignored. Returns
   * null if there are no others. The caller owns the result.
   */
  VTK_NEWINSTANCE
  static vtkAbstractTransform* ComputeBestFittingPlane(vtkPointSet* input);

  ///@{
  /**
   * A point within this distance of a kept point of lower id, in the plane, is merged into it. The
   * distance is a fraction of the diagonal of the points' bounding box. 0 (the default) merges only
   * points at the same position. Other values cost a serial pass over the points.
   */
  vtkTIPPClampedMacro(Tolerance, double, 0.0, 1.0);
  ///@}

  ///@{
  /**
   * The radius of the circle of the BoundingTriangulation's points, as a multiple of the diagonal
   * of the points' bounding box. 1 by default. Without BoundingTriangulation it has no effect: the
   * border is always the convex hull.
   */
  vtkTIPPClampedMacro(Offset, double, 0.75, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Whether eight points on a circle around all others are triangulated too. The output then has
   * its own double-precision points, with the eight after the input's, and none of the input's
   * point data, since the eight have no values. It applies to the x-y plane only: with a transform
   * or the best fitting plane it is ignored, with a warning. Off by default.
   */
  vtkTIPPSwitchMacro(BoundingTriangulation, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether an output with merged or rejected points gets the point array "RepresentativePointId"
   * (vtkIdTypeArray): for each point its own id; for a merged point, the id of the point it was
   * merged into; for a rejected point, -1. On by default. Without merged or rejected points the
   * array is never added.
   */
  vtkTIPPSwitchMacro(GenerateRepresentativeIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the cell array "NeighborIds" (vtkIdTypeArray, three components): for
   * each corner of a triangle, the id of the triangle across the opposite edge, or -1 at the
   * border. With Alpha the array is omitted, with a warning. Off by default.
   */
  vtkTIPPSwitchMacro(GenerateNeighborIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The columns and rows of a grid of partitions over the points. If either is 0 (the default), the
   * partitions are chosen automatically.
   */
  vtkSetVector2Macro(NumberOfPartitions, int);
  vtkGetVector2Macro(NumberOfPartitions, int);
  ///@}

  ///@{
  /**
   * How many points of each partition are in the initial mesh. 0 (the default): chosen
   * automatically.
   */
  vtkTIPPClampedMacro(InitialPointsPerPartition, int, 0, VTK_INT_MAX);
  ///@}

  ///@{
  /**
   * A ScheduleType; DYNAMIC by default.
   */
  vtkTIPPClampedMacro(Schedule, int, STAGES, PRODUCER_CONSUMER);
  void SetScheduleToStages() { this->SetSchedule(STAGES); }
  void SetScheduleToDynamic() { this->SetSchedule(DYNAMIC); }
  void SetScheduleToProducerConsumer() { this->SetSchedule(PRODUCER_CONSUMER); }
  ///@}

  ///@{
  /**
   * The ranks that triangulate together. The global controller by default. With null or a
   * controller of one rank, this process works alone.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * On several ranks: a MastersType, AUTO_MASTERS by default.
   */
  vtkTIPPClampedMacro(Masters, int, AUTO_MASTERS, MULTI_MASTER);
  ///@}

  ///@{
  /**
   * With MULTI_MASTER on several ranks: the columns and rows of a grid of major partitions, each of
   * which is divided further by NumberOfPartitions. If either is 0 (the default), major partitions
   * are boxes with equally many points.
   */
  vtkSetVector2Macro(NumberOfMajorPartitions, int);
  vtkGetVector2Macro(NumberOfMajorPartitions, int);
  ///@}

  ///@{
  /**
   * On several ranks: whether every rank gets the same number of partitions, and every major
   * partition the same number of ranks, instead of numbers in proportion to points (equation 3.2).
   * Off by default.
   */
  vtkTIPPSwitchMacro(EqualGroups, vtkTypeBool);
  ///@}

  ///@{
  /**
   * On several ranks, if NumberOfPartitions is not given: a MinorDivisionType, TREE by default, and
   * the target number of points per partition; 0 (the default): chosen automatically.
   */
  vtkTIPPClampedMacro(MinorDivision, int, TREE, THRESHOLD);
  vtkTIPPClampedMacro(PointsPerPartition, vtkIdType, 0, VTK_ID_MAX);
  ///@}

  ///@{
  /**
   * On several ranks: whether the first rank's output gets all triangles and the others' are empty.
   * Off by default.
   */
  vtkTIPPSwitchMacro(GatherOnFirstRank, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of OpenMP threads. 0 (the default): OMP_NUM_THREADS, or as many as the processors
   * that this process may use, by its affinity, its control group and the ranks on this computer.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

  ///@{
  /**
   * Of the last run: the points merged into another one, and the points rejected.
   */
  vtkGetMacro(NumberOfDuplicatePoints, vtkIdType);
  vtkGetMacro(NumberOfRejectedPoints, vtkIdType);
  ///@}

  /**
   * Output port 1.
   */
  vtkTable* GetStatistics();

  /**
   * Includes the modification time of the Transform.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkTIPPDelaunay2D();
  ~vtkTIPPDelaunay2D() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  vtkTypeBool MergeSourcePoints = false;
  vtkTypeBool SplitCrossings = true;
  int ConstraintMarks = NO_MARKS;
  double Alpha = 0;
  vtkTypeBool AlphaTris = true;
  vtkTypeBool AlphaLines = true;
  vtkTypeBool AlphaVerts = true;
  double MaximumEdgeLength = 0;
  int ProjectionPlaneMode = VTK_DELAUNAY_XY_PLANE;
  vtkSmartPointer<vtkAbstractTransform> Transform;
  double Tolerance = 0;
  double Offset = 1;
  vtkTypeBool BoundingTriangulation = false;
  vtkTypeBool GenerateRepresentativeIds = true;
  vtkTypeBool GenerateNeighborIds = false;
  int NumberOfPartitions[2] = { 0, 0 };
  int InitialPointsPerPartition = 0;
  int Schedule = DYNAMIC;
  vtkSmartPointer<vtkMultiProcessController> Controller;
  int Masters = AUTO_MASTERS;
  int NumberOfMajorPartitions[2] = { 0, 0 };
  vtkTypeBool EqualGroups = false;
  int MinorDivision = TREE;
  vtkIdType PointsPerPartition = 0;
  vtkTypeBool GatherOnFirstRank = false;
  int NumberOfThreads = 0;
  vtkIdType NumberOfDuplicatePoints = 0;
  vtkIdType NumberOfRejectedPoints = 0;

private:
  vtkTIPPDelaunay2D(const vtkTIPPDelaunay2D&) = delete;
  void operator=(const vtkTIPPDelaunay2D&) = delete;

  void Execute(vtkPointSet* given, vtkPolyData* source, vtkInformationVector* outputs);
  void ExecuteOnRanks(vtkPointSet* given, vtkPolyData* source, vtkInformationVector* outputs);
  vtkSmartPointer<vtkPointSet> ReadSource(vtkPointSet* input, vtkPolyData* source,
    vtkAbstractTransform* toPlane, tipp::SourceConstraints& constraints);
  tipp::ConstrainedTriangulation Triangulate(
    vtkPoints* points, vtkAbstractTransform* toPlane, const tipp::SourceConstraints& constraints);
  void AddArrays(const tipp::ConstrainedTriangulation& result, bool hasSource, vtkIdType points,
    vtkPolyData* output);
  void SetCells(tipp::Triangulation& triangulation, vtkPolyData* output) const;
};

#endif

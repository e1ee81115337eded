// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPDelaunay2D
 * @brief   exact 2D Delaunay triangulation of many points, in parallel
 *
 * vtkTIPPDelaunay2D triangulates the points of any vtkPointSet in a plane: the x-y plane (z is
 * ignored, but kept), the plane that Transform takes them to, or the plane that fits them best. It
 * stands in for vtkDelaunay2D: same property names, same meanings, same numeric values.
 *
 * The result is exact. All predicates are evaluated without rounding error, the border is the
 * convex hull, every distinct point is a vertex, and every triangle is counter-clockwise in the
 * plane. Where four or more points lie on one circle, the choice between the possible
 * triangulations depends on the coordinates alone, so that the set of triangles is the same for
 * every order of the points, NumberOfPartitions, Schedule and NumberOfThreads.
 *
 * Output port 0 is a vtkPolyData with the input's own vtkPoints (the same object, in the same order
 * and precision, with all point data) and triangles of their ids. Points that are in no triangle
 * stay in the output. The ids take 32 bits each where they fit, and on several ranks always 64.
 *
 * Coincident points are merged into the one of lowest id. Points with a NaN or infinite
 * coordinate in the plane are rejected, with one warning. If there is a merged or rejected
 * point, the output has the point array "RepresentativePointId" (see GenerateRepresentativeIds).
 * Fewer than three distinct points, or points all on one line, make an output without triangles
 * and a warning.
 *
 * Output port 1, also GetStatistics(), is a vtkTable about the run. It has a row for each stage,
 * with the columns
 * - Stage: 0, 1, ...
 * - ActivePartitions: the partitions triangulated in this stage
 * - MeshTriangles: the unfinished triangles in memory when the stage began
 *
 * and as field data, one value each, Points, Triangles (before Alpha), DuplicatePoints,
 * RejectedPoints, Partitions, InitialPoints, WorkerVertices (vertices triangulated by all workers
 * together) and Threads, and of one length PhaseName and PhaseSeconds (wall-clock seconds).
 * In Python, with the filter `f`:
 * @code{.py}
 * from vtkmodules.numpy_interface.dataset_adapter import WrapDataObject
 * table = WrapDataObject(f.GetStatistics())
 * pandas.DataFrame({name: table.RowData[name] for name in table.RowData.keys()})
 * @endcode
 *
 * With a Controller of several ranks all of them update the filter together; they triangulate all
 * their input points together, whichever rank holds which, into one exact triangulation, the same
 * for every number of ranks. Coincident points of all ranks are merged. Each rank's output
 * is a piece: its triangles, each of which is on one rank, and the points that they use, with the
 * point data that all ranks with points have. "GlobalPointIds" are the input's global ids, or else
 * count the points from the first rank on; "GlobalCellIds" are 0, 1, ... over all ranks. If ghost
 * cells are asked for downstream, one layer comes, marked in vtkGhostType: other ranks' triangles
 * that share a point with the piece. Merged points are in no piece; with GenerateRepresentativeIds
 * the field data has the arrays "DuplicatePointIds", "DuplicateRepresentativeIds" and
 * "RejectedPointIds" (global ids) of those found on this rank. Port 1 has on every rank the same
 * table: rows for the first master's stages, if there is a master, and as field data, by rank,
 * "RankComputeSeconds", "RankWaitSeconds", "RankSendSeconds", "RankOwnedPoints" and
 * "RankTriangles"; "MasterSeconds", "LargestMasterMesh"; "MessageKind", "MessageCount" and
 * "MessageBytes". If any rank fails, all do, and the first one reports the error; also if it is
 * upstream that fails on a rank, unless the application has executives of its own
 * (vtkAlgorithm::SetDefaultExecutivePrototype), as ParaView has. Alpha, Tolerance,
 * BoundingTriangulation and the best fitting plane need a single rank.
 *
 * An aborted or failed run leaves both outputs empty. A failure is reported as an error.
 *
 * With a second input, the source, the result is the constrained Delaunay triangulation, exact and
 * unique too: every edge of the source's lines and polygons is a chain of edges of the output.
 * Polygons also tell what is inside: of the triangles those stay that polygons go round
 * counter-clockwise more often than clockwise; clockwise ones are holes. Where all are clockwise,
 * all stays but the holes. The source's point ids are those of the first input's points (see
 * MergeSourcePoints), whose coordinates count. Constraints may overlap, coincide and pass
 * through points. Where two cross, there is a new point, after the input's (see SplitCrossings):
 * its coordinates in the plane are those of the crossing, rounded, and its point data are
 * interpolated along the edge of the lower number; the output's points are doubles then. Tolerance
 * does not go with a source. The statistics have the field data Constraints, ConstraintEdges,
 * CrossingPoints and CrossingRounds. On several ranks the sources of all ranks are one; what
 * several of them have alike counts once. Its ids are global ones of the input's points, or else
 * these are counted from the first rank on. New points get ids after all others.
 *
 * What differs: Tolerance is 0 by default. A transform set while ProjectionPlaneMode is
 * VTK_BEST_FITTING_PLANE is ignored, not used instead of the plane. VTK_SET_TRANSFORM_PLANE
 * without a transform is an error. With Alpha, merged and rejected points are no vertices. No
 * constraint is lost, where vtkDelaunay2D may warn and go on; polygons inside of each other nest.
 *
 * Publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapter 2.
 *
 * @sa vtkDelaunay2D
 */

#ifndef vtkTIPPDelaunay2D_h
#define vtkTIPPDelaunay2D_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"      // For smart pointer
#include "vtkTIPPFiltersModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkAbstractTransform;
class vtkAlgorithmOutput;
class vtkMultiProcessController;
class vtkPoints;
class vtkPointSet;
class vtkTable;

namespace tipp
{
class Communicator;
struct ConstrainedTriangulation;
struct DistributedOptions;
struct DistributedTriangulation;
struct RankSource;
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
   * How partitions are handed to threads.
   */
  enum ScheduleType
  {
    STAGES = 0,           ///< a barrier after each set of independent partitions
    DYNAMIC = 1,          ///< a partition starts as soon as it is independent of all active ones
    PRODUCER_CONSUMER = 2 ///< stages; on several ranks without a barrier after each shift of them
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
   * How several ranks cut the domain, or each major partition, into partitions.
   */
  enum MinorDivisionType
  {
    TREE = 0,     ///< boxes with equally many points
    THRESHOLD = 1 ///< square grids of boxes with about PointsPerPartition points (equation 3.1)
  };

  /**
   * How the output shows which edges are constraints.
   */
  enum ConstraintMarksType
  {
    NO_MARKS = 0,  ///< not at all
    LINES = 1,     ///< lines before the triangles, and the cell array "ConstraintId"
    EDGE_FLAGS = 2 ///< the cell array "ConstraintEdges"
  };

  ///@{
  /**
   * The source: lines and polygons whose edges are edges of the output. None by default.
   */
  void SetSourceData(vtkPolyData*);
  void SetSourceConnection(vtkAlgorithmOutput*);
  vtkPolyData* GetSource();
  ///@}

  ///@{
  /**
   * Whether the source has points of its own. Each that lies, in the plane, where one of the
   * input's points lies is this one, the others are triangulated with the input's points and come
   * after them, with the source's values of point arrays; arrays that it lacks are left out then,
   * with a warning. Off by default: the source's point ids are those of the input.
   */
  vtkSetMacro(MergeSourcePoints, vtkTypeBool);
  vtkGetMacro(MergeSourcePoints, vtkTypeBool);
  vtkBooleanMacro(MergeSourcePoints, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether constraints that cross are split at a new point. Off: it is an error if two cross. On
   * by default.
   */
  vtkSetMacro(SplitCrossings, vtkTypeBool);
  vtkGetMacro(SplitCrossings, vtkTypeBool);
  vtkBooleanMacro(SplitCrossings, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A ConstraintMarksType; NO_MARKS by default. LINES: "ConstraintId" is the cell of the source
   * that a line is a part of, and -1 of triangles; there are no NeighborIds. On several ranks each
   * line is on one rank that has a triangle of it, there are none outside of polygons, and cells
   * are counted over all different sources, by rank. EDGE_FLAGS: for each corner of a triangle 1 if
   * the edge opposite to it is a constraint's, else 0. With Alpha there are none, and a warning.
   */
  vtkSetClampMacro(ConstraintMarks, int, NO_MARKS, EDGE_FLAGS);
  vtkGetMacro(ConstraintMarks, int);
  ///@}

  ///@{
  /**
   * A radius, in the units of the points, that cells of the output must not exceed; 0 (the
   * default) outputs all triangles and nothing else. With any other value the output has
   * the triangles of at most this circumradius, the edges of the other triangles that are at most
   * twice as long and in no such triangle as lines, and the remaining points as vertices. Lengths
   * are those of the points in space, not in the plane.
   */
  vtkSetClampMacro(Alpha, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(Alpha, double);
  ///@}

  ///@{
  /**
   * Triangles with an edge longer than this, in the plane and the units of the points, are left
   * out; their points stay. 0 by default: none are. Unlike Alpha it makes no other cells.
   */
  vtkSetClampMacro(MaximumEdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumEdgeLength, double);
  ///@}

  ///@{
  /**
   * Which cells are output while Alpha is not 0. They do not change what the others are. All are
   * on by default.
   */
  vtkSetMacro(AlphaTris, vtkTypeBool);
  vtkGetMacro(AlphaTris, vtkTypeBool);
  vtkBooleanMacro(AlphaTris, vtkTypeBool);
  vtkSetMacro(AlphaLines, vtkTypeBool);
  vtkGetMacro(AlphaLines, vtkTypeBool);
  vtkBooleanMacro(AlphaLines, vtkTypeBool);
  vtkSetMacro(AlphaVerts, vtkTypeBool);
  vtkGetMacro(AlphaVerts, vtkTypeBool);
  vtkBooleanMacro(AlphaVerts, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A point no farther, in the plane, from a kept point of lower id is merged into it; as a
   * fraction of the diagonal of the points' bounding box. 0 (the default) merges points at the
   * same position only. Other values cost a serial pass over the points.
   */
  vtkSetClampMacro(Tolerance, double, 0.0, 1.0);
  vtkGetMacro(Tolerance, double);
  ///@}

  ///@{
  /**
   * The radius of the circle of the BoundingTriangulation's points, as a multiple of the diagonal
   * of the points' bounding box. 1 by default. Without BoundingTriangulation it plays no part: the
   * border is the convex hull in any case.
   */
  vtkSetClampMacro(Offset, double, 0.75, VTK_DOUBLE_MAX);
  vtkGetMacro(Offset, double);
  ///@}

  ///@{
  /**
   * Whether eight points on a circle around all others are triangulated with them. The output
   * has its own double-precision points then, the eight after the input's, and, for want of values
   * at the eight, none of the input's point data. Only the x-y plane has them; together with a
   * transform or the best fitting plane they are left out with a warning. Off by default.
   */
  vtkSetMacro(BoundingTriangulation, vtkTypeBool);
  vtkGetMacro(BoundingTriangulation, vtkTypeBool);
  vtkBooleanMacro(BoundingTriangulation, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Takes the points to where their x and y are triangulated; the output has them where they were.
   * Any transform will do, also one that is not linear or has no inverse. None by default.
   */
  virtual void SetTransform(vtkAbstractTransform*);
  vtkGetObjectMacro(Transform, vtkAbstractTransform);
  ///@}

  ///@{
  /**
   * The plane of the triangulation. VTK_DELAUNAY_XY_PLANE (the default): x and y of the points, or
   * of what Transform makes of them if there is one. VTK_SET_TRANSFORM_PLANE: the same, but it is
   * an error if there is no Transform. VTK_BEST_FITTING_PLANE: see ComputeBestFittingPlane.
   */
  vtkSetClampMacro(ProjectionPlaneMode, int, VTK_DELAUNAY_XY_PLANE, VTK_BEST_FITTING_PLANE);
  vtkGetMacro(ProjectionPlaneMode, int);
  ///@}

  /**
   * The transform that moves the plane which fits the points best (in the least-squares sense) to
   * the plane z = 0 and their centroid to the origin. Points with a NaN or infinite coordinate do
   * not count. Null if there are no others. The caller owns it.
   */
  VTK_NEWINSTANCE
  static vtkAbstractTransform* ComputeBestFittingPlane(vtkPointSet* input);

  ///@{
  /**
   * Whether an output with merged or rejected points gets the point array "RepresentativePointId"
   * (vtkIdTypeArray): for each point the id of the point that stands for it, which is its own id,
   * or for a merged point that of the point it was merged into, or -1 for a rejected point. On
   * by default; without such points there never is the array.
   */
  vtkSetMacro(GenerateRepresentativeIds, vtkTypeBool);
  vtkGetMacro(GenerateRepresentativeIds, vtkTypeBool);
  vtkBooleanMacro(GenerateRepresentativeIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the output has the cell array "NeighborIds" (vtkIdTypeArray): for each corner of a
   * triangle the id of the triangle opposite to it, or -1 at the hull. With Alpha there is none,
   * and a warning. On several ranks it is an error. Off by default.
   */
  vtkSetMacro(GenerateNeighborIds, vtkTypeBool);
  vtkGetMacro(GenerateNeighborIds, vtkTypeBool);
  vtkBooleanMacro(GenerateNeighborIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Columns and rows of a grid of partitions over the points. If either is 0 (the default), a
   * tiling is chosen for the points.
   */
  vtkSetVector2Macro(NumberOfPartitions, int);
  vtkGetVector2Macro(NumberOfPartitions, int);
  ///@}

  ///@{
  /**
   * The points of each partition that the initial mesh is made of. 0 (the default) chooses.
   */
  vtkSetClampMacro(InitialPointsPerPartition, int, 0, VTK_INT_MAX);
  vtkGetMacro(InitialPointsPerPartition, int);
  ///@}

  ///@{
  /**
   * A ScheduleType; DYNAMIC by default.
   */
  vtkSetClampMacro(Schedule, int, STAGES, PRODUCER_CONSUMER);
  vtkGetMacro(Schedule, int);
  void SetScheduleToStages() { this->SetSchedule(STAGES); }
  void SetScheduleToDynamic() { this->SetSchedule(DYNAMIC); }
  void SetScheduleToProducerConsumer() { this->SetSchedule(PRODUCER_CONSUMER); }
  ///@}

  ///@{
  /**
   * The ranks that triangulate together. The global controller by default; null, or a controller of
   * one rank: this process alone.
   */
  virtual void SetController(vtkMultiProcessController*);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * On several ranks: a MastersType, AUTO_MASTERS by default.
   */
  vtkSetClampMacro(Masters, int, AUTO_MASTERS, MULTI_MASTER);
  vtkGetMacro(Masters, int);
  ///@}

  ///@{
  /**
   * On several ranks with several masters: columns and rows of a grid of major partitions, each of
   * which NumberOfPartitions cuts further. If either is 0 (the default), they are boxes of equally
   * many points.
   */
  vtkSetVector2Macro(NumberOfMajorPartitions, int);
  vtkGetVector2Macro(NumberOfMajorPartitions, int);
  ///@}

  ///@{
  /**
   * On several ranks, where NumberOfPartitions is not given: a MinorDivisionType, TREE by default,
   * and the points that a partition is to have; 0 (the default) chooses.
   */
  vtkSetClampMacro(MinorDivision, int, TREE, THRESHOLD);
  vtkGetMacro(MinorDivision, int);
  vtkSetClampMacro(PointsPerPartition, vtkIdType, 0, VTK_ID_MAX);
  vtkGetMacro(PointsPerPartition, vtkIdType);
  ///@}

  ///@{
  /**
   * On several ranks: whether ranks are given partitions, and major partitions ranks, in equal
   * numbers rather than in proportion to points (equation 3.2). Off by default.
   */
  vtkSetMacro(EqualGroups, vtkTypeBool);
  vtkGetMacro(EqualGroups, vtkTypeBool);
  vtkBooleanMacro(EqualGroups, vtkTypeBool);
  ///@}

  ///@{
  /**
   * On several ranks: whether the first one's output has all triangles, and the others' none. Off
   * by default.
   */
  vtkSetMacro(GatherOnFirstRank, vtkTypeBool);
  vtkGetMacro(GatherOnFirstRank, vtkTypeBool);
  vtkBooleanMacro(GatherOnFirstRank, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The OpenMP threads to use. 0 (the default) leaves it to OpenMP: OMP_NUM_THREADS, or all cores.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
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
   * Also that of the Transform.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkTIPPDelaunay2D();
  ~vtkTIPPDelaunay2D() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkExecutive* CreateDefaultExecutive() override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Alpha = 0;
  double MaximumEdgeLength = 0;
  vtkTypeBool AlphaTris = 1;
  vtkTypeBool AlphaLines = 1;
  vtkTypeBool AlphaVerts = 1;
  double Tolerance = 0;
  double Offset = 1;
  vtkTypeBool BoundingTriangulation = 0;
  vtkAbstractTransform* Transform = nullptr;
  int ProjectionPlaneMode = VTK_DELAUNAY_XY_PLANE;
  vtkTypeBool GenerateRepresentativeIds = 1;
  vtkTypeBool GenerateNeighborIds = 0;
  vtkTypeBool MergeSourcePoints = 0;
  vtkTypeBool SplitCrossings = 1;
  int ConstraintMarks = NO_MARKS;
  int NumberOfPartitions[2] = { 0, 0 };
  int InitialPointsPerPartition = 0;
  int Schedule = DYNAMIC;
  int NumberOfThreads = 0;
  vtkMultiProcessController* Controller = nullptr;
  int Masters = AUTO_MASTERS;
  int NumberOfMajorPartitions[2] = { 0, 0 };
  int MinorDivision = TREE;
  vtkIdType PointsPerPartition = 0;
  vtkTypeBool EqualGroups = 0;
  vtkTypeBool GatherOnFirstRank = 0;
  vtkIdType NumberOfDuplicatePoints = 0;
  vtkIdType NumberOfRejectedPoints = 0;

private:
  vtkTIPPDelaunay2D(const vtkTIPPDelaunay2D&) = delete;
  void operator=(const vtkTIPPDelaunay2D&) = delete;

  bool Execute(vtkPointSet* input, vtkPolyData* source, vtkPolyData* output, vtkTable* statistics);
  bool HasSeveralRanks() const;
  bool ExecuteOnRanks(vtkPointSet* given, vtkPolyData* source, bool wantsGhosts,
    vtkPolyData* output, vtkTable* statistics);
  std::unique_ptr<tipp::RankSource> ShareSource(
    tipp::Communicator& ranks, vtkPointSet* input, vtkPolyData* source, bool wantsCells);
  tipp::DistributedOptions OptionsForRanks() const;
  const char* WhatNeedsOneRank();
  vtkSmartPointer<vtkPointSet> ReadSource(vtkPointSet* input, vtkPolyData* source,
    vtkAbstractTransform* toPlane, tipp::SourceConstraints& constraints);
  tipp::ConstrainedTriangulation Triangulate(
    vtkPoints* points, vtkAbstractTransform* toPlane, const tipp::SourceConstraints& constraints);
  void AddArrays(const tipp::ConstrainedTriangulation& result, bool hasSource, vtkIdType points,
    vtkPolyData* output);
  void SetCells(tipp::Triangulation& triangulation, vtkPolyData* output) const;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPDelaunay3D
 * @brief   exact 3D Delaunay tetrahedralization of many points, in parallel
 *
 * vtkTIPPDelaunay3D tetrahedralizes the points of any vtkPointSet. It is a drop-in replacement for
 * vtkDelaunay3D: its properties have the same names, meanings and numeric values. The differences
 * are listed below.
 *
 * The result is exact. All predicates are evaluated without rounding error, the border is the
 * convex hull, every distinct point is a vertex, and no tetrahedron is flat or inverted. Where five
 * or more points lie on one sphere, the choice among the possible tetrahedralizations depends only
 * on the coordinates. So the tetrahedra are the same for every order of the points,
 * NumberOfPartitions and NumberOfThreads. They are sorted lexicographically by their point ids.
 *
 * Output port 0 is a vtkUnstructuredGrid with the input's own vtkPoints (the same object, so the
 * same order and precision), all of its point data, and tetrahedra that index these points. Points
 * that no tetrahedron uses stay in the output. The input can have at most 2^31 - 1 points.
 *
 * Coincident points are merged into the one of lowest id. Points with a NaN or infinite coordinate
 * are rejected, with one warning. If there is a merged or rejected point, the output has the point
 * array "RepresentativePointId" (see GenerateRepresentativeIds).
 *
 * If all points are in one plane, the output has triangles, and a warning is issued. They are the
 * exact 2D Delaunay triangulation of the points' projection along the axis in which the plane's
 * normal is longest (of equal ones z, then y). If the plane is parallel to two axes, that is the
 * plane's own Delaunay triangulation. Alpha and GenerateNeighborIds (three components then) apply
 * to the triangles. If all points are on one line, or fewer than three are distinct, the output has
 * no cells, and a warning is issued.
 *
 * Output port 1, also returned by GetStatistics(), is a vtkTable whose field data has arrays of one
 * value each: Points, Tetrahedra (before Alpha), DuplicatePoints, RejectedPoints, Partitions,
 * InitialPoints, WorkerVertices (vertices of all partitions' triangulations together) and Threads.
 * PhaseName and PhaseSeconds (wall-clock seconds) have one value for each phase.
 *
 * With a Controller of several ranks, all ranks must update the filter together. They triangulate
 * the points of all ranks into one exact triangulation, which depends neither on the number of
 * ranks nor on which rank holds which points. Coincident points of all ranks are merged. Each
 * rank's output is a piece: its tetrahedra (each is on exactly one rank) and the points that they
 * use, with those point arrays that every rank with points has. A piece depends neither on threads
 * nor on partitions. "GlobalPointIds" holds the input's global ids; if it has none, points are
 * numbered consecutively by rank. "GlobalCellIds" numbers the tetrahedra 0, 1, ... over all ranks.
 * If ghost cells are requested downstream, one layer is added and marked in vtkGhostType: the
 * tetrahedra of other ranks that share a point with the piece. Merged points are in no piece; with
 * GenerateRepresentativeIds the field data has the arrays "DuplicatePointIds",
 * "DuplicateRepresentativeIds" and "RejectedPointIds" (global ids) for the points found on this
 * rank. Port 1 has the same table on every rank: its field data has, indexed by rank,
 * "RankComputeSeconds", "RankWaitSeconds", "RankSendSeconds", "RankOwnedPoints" and
 * "RankTetrahedra"; "MessageKind", "MessageCount" and "MessageBytes". If one rank fails, all fail
 * and the first rank reports the error. That includes failures upstream, unless the application
 * sets its own default executive (vtkAlgorithm::SetDefaultExecutivePrototype), as ParaView does.
 * The Alpha, Tolerance, BoundingTriangulation and GenerateNeighborIds of the first rank count for
 * all; points within the Tolerance are merged by ascending global id, and "NeighborIds" are those
 * of "GlobalCellIds". With Alpha each cell of the alpha shape is on one rank, and there are no
 * ghost cells.
 *
 * An aborted or failed run leaves both outputs empty. A failure is reported as an error.
 *
 * Differences from vtkDelaunay3D: Tolerance is 0 by default, and Offset has an effect only with
 * BoundingTriangulation. There is no Locator. With Alpha, merged and rejected points get no vertex
 * cells.
 *
 * Publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapter 2.
 *
 * @sa vtkDelaunay3D vtkTIPPDelaunay2D
 */

#ifndef vtkTIPPDelaunay3D_h
#define vtkTIPPDelaunay3D_h

#include "vtkMultiProcessController.h" // For the Controller
#include "vtkSmartPointer.h"           // For the Controller
#include "vtkTIPPFiltersModule.h"      // For export macro
#include "vtkTIPPSetGet.h"             // For property macros
#include "vtkUnstructuredGridAlgorithm.h"

class vtkPointSet;
class vtkTable;

namespace tipp
{
template <int D>
struct Point;
struct Tetrahedralization;
struct TriangulatedPoints;
struct Triangulation;
template <typename T>
class Buffer;
}

class VTKTIPPFILTERS_EXPORT vtkTIPPDelaunay3D : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTIPPDelaunay3D* New();
  vtkTypeMacro(vtkTIPPDelaunay3D, vtkUnstructuredGridAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The largest circumradius of the output's cells, in the units of the points. 0 (the default)
   * outputs all tetrahedra and nothing else. With any other value the output has
   * - the tetrahedra of at most this circumradius;
   * - as triangles, the facets of the other tetrahedra that are within the limit and belong to no
   *   output tetrahedron;
   * - as lines, the edges of the other tetrahedra that are at most twice as long as the limit and
   *   belong to none of these cells;
   * - the remaining points as vertices.
   */
  vtkTIPPClampedMacro(Alpha, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Which kinds of cells are output if Alpha is not 0. Each switch affects only its own kind. All
   * are on by default.
   */
  vtkTIPPSwitchMacro(AlphaTets, vtkTypeBool);
  vtkTIPPSwitchMacro(AlphaTris, vtkTypeBool);
  vtkTIPPSwitchMacro(AlphaLines, vtkTypeBool);
  vtkTIPPSwitchMacro(AlphaVerts, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A point within this distance of a kept point of lower id is merged into it. The distance is a
   * fraction of the diagonal of the points' bounding box. 0 (the default) merges only points at the
   * same position. Other values cost a serial pass over the points.
   */
  vtkTIPPClampedMacro(Tolerance, double, 0.0, 1.0);
  ///@}

  ///@{
  /**
   * The distance of the BoundingTriangulation's points from the centre of the points' bounding box,
   * as a multiple of its diagonal. 2.5 by default. Without BoundingTriangulation it has no effect.
   */
  vtkTIPPClampedMacro(Offset, double, 2.5, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Whether the six corners of an octahedron around all points are tetrahedralized too. The output
   * then has its own double-precision points, with the six after the input's, and none of the
   * input's point data, since the six have no values. Off by default.
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
   * Whether the output has the cell array "NeighborIds" (vtkIdTypeArray, four components): for each
   * corner of a tetrahedron, the id of the tetrahedron across the opposite facet, or -1 at the
   * hull. With Alpha the array is omitted, with a warning. Off by default.
   */
  vtkTIPPSwitchMacro(GenerateNeighborIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The number of partitions, at most 512. 0 (the default): chosen automatically. On several ranks
   * each has an equal share of them, rounded up.
   */
  vtkTIPPClampedMacro(NumberOfPartitions, int, 0, 512);
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
   * The ranks that triangulate together. The global controller by default. With null or a
   * controller of one rank, this process works alone.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * On several ranks: whether the first rank's output gets all tetrahedra and the others' are
   * empty. Off by default.
   */
  vtkTIPPSwitchMacro(GatherOnFirstRank, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Of the last run, on all ranks together: the points merged into another one, and the points
   * rejected.
   */
  vtkGetMacro(NumberOfDuplicatePoints, vtkIdType);
  vtkGetMacro(NumberOfRejectedPoints, vtkIdType);
  ///@}

  /**
   * Output port 1.
   */
  vtkTable* GetStatistics();

protected:
  vtkTIPPDelaunay3D();
  ~vtkTIPPDelaunay3D() override = default;

  int FillInputPortInformation(int, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  double Alpha = 0;
  vtkTypeBool AlphaTets = true;
  vtkTypeBool AlphaTris = true;
  vtkTypeBool AlphaLines = true;
  vtkTypeBool AlphaVerts = true;
  double Tolerance = 0;
  double Offset = 2.5;
  vtkTypeBool BoundingTriangulation = false;
  vtkTypeBool GenerateRepresentativeIds = true;
  vtkTypeBool GenerateNeighborIds = false;
  int NumberOfPartitions = 0;
  int NumberOfThreads = 0;
  vtkTypeBool GatherOnFirstRank = false;
  vtkSmartPointer<vtkMultiProcessController> Controller;
  vtkIdType NumberOfDuplicatePoints = 0;
  vtkIdType NumberOfRejectedPoints = 0;

private:
  vtkTIPPDelaunay3D(const vtkTIPPDelaunay3D&) = delete;
  void operator=(const vtkTIPPDelaunay3D&) = delete;

  void Execute(vtkPointSet* input, vtkInformationVector* outputs);
  void ExecuteOnRanks(vtkPointSet* input, vtkInformationVector* outputs);
  tipp::Tetrahedralization Triangulate(
    const tipp::Point<3>* points, vtkIdType count, double distance, tipp::Triangulation& triangles);
  void SetCells(tipp::Buffer<int>& ids, int corners, const tipp::TriangulatedPoints& mesh,
    vtkUnstructuredGrid* output) const;
};

#endif

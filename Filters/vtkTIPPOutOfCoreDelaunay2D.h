// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPOutOfCoreDelaunay2D
 * @brief   exact 2D Delaunay triangulation of points in files, larger than memory
 *
 * vtkTIPPOutOfCoreDelaunay2D triangulates points from files by x and y and writes the triangles as
 * a partitioned mesh, the folder FileName. Neither points nor triangles need to fit into memory.
 * Read the mesh by piece or by range with a vtkPartitionedUnstructuredReader:
 * @code{.py}
 * triangulation = vtkTIPPOutOfCoreDelaunay2D()
 * triangulation.AddInputFileName("points.npy")
 * triangulation.SetFileName("mesh.tipp")
 * triangulation.Update()
 * reader = vtkPartitionedUnstructuredReader()
 * reader.SetFileName(triangulation.GetFileName())
 * @endcode
 *
 * The triangles are those of vtkTIPPDelaunay2D and of `tipp delaunay`: exact, counter-clockwise,
 * the same for every MemoryLimit and number of threads; the files are the same for every number of
 * threads. A point's global id is its index in the input. A column named z is the third coordinate;
 * other columns and point data become point arrays. Coincident points are merged into the one of
 * lowest id; points with a NaN or infinite x or y are left out, with one warning.
 * Documentation/OutOfCore.md describes how it works, how much disk space it needs, and the file
 * formats.
 *
 * Constraints are read from files, too (ConstraintsFileName, BoundaryFileName, AddHole()): the
 * result is then the constrained Delaunay triangulation, as from vtkTIPPDelaunay2D with a source.
 * The points of these files that are not in the input, followed by the points where constraints
 * cross, come after the input's points; z is their only column with a value. The statistics then
 * include Constraints, ConstraintEdges, CrossingPoints and CrossingRounds, unless the run was
 * resumed.
 *
 * The output, also returned by GetStatistics(), is a vtkTable with statistics of the run. It has a
 * row for each phase, with the columns Phase (its name) and Seconds (wall-clock). The field data
 * has arrays of one value each: Points, Triangles, DuplicatePoints, RejectedPoints, Pieces,
 * Partitions, WorkerVertices (vertices triangulated by all workers together), BoundaryBytes (of
 * vertices sent between pieces), SpilledBytes (of points), MeshBytes (on disk), Threads, Resumed (1
 * if the run resumed an earlier one, else 0) and, with CountOnly, TriangleSum.
 *
 * The folder appears only when it is complete, and replaces an existing partitioned mesh of that
 * name. After an error or an abort, the path is unchanged and the output is empty; if points have
 * been spilled already, the work is kept in a hidden folder beside the path, so that Resume can
 * continue it. Errors: an input that cannot be read or has changed during the run, files with
 * different columns, no finite point, a folder that cannot be written, too little disk space (the
 * message gives the numbers), work of another run in the hidden folder.
 *
 * With a Controller of several ranks, all of them must update the filter together with the same
 * properties; the files are the same for every number of ranks. MemoryLimit and NumberOfThreads are
 * per rank. All ranks must have access to the folders of FileName and ScratchFolder. The first rank
 * has the statistics. If one rank fails or stops, all do, and the first rank reports it.
 *
 * @warning It does not notice when an input file changes: call Modified() to execute it again.
 *
 * Related publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapter 2 (Triangulation of Independent Partitions in
 * Parallel).
 *
 * @sa
 * vtkTIPPDelaunay2D vtkPartitionedUnstructuredReader
 */

#ifndef vtkTIPPOutOfCoreDelaunay2D_h
#define vtkTIPPOutOfCoreDelaunay2D_h

#include "vtkMultiProcessController.h" // For the Controller
#include "vtkSmartPointer.h"           // For the Controller
#include "vtkTIPPFiltersModule.h"      // For export macro
#include "vtkTIPPSetGet.h"             // For property macros
#include "vtkTableAlgorithm.h"

#include <string>  // For InputFileNames
#include <utility> // For Holes
#include <vector>  // For InputFileNames

namespace tipp
{
struct OutOfCoreOptions;
}

class VTKTIPPFILTERS_EXPORT vtkTIPPOutOfCoreDelaunay2D : public vtkTableAlgorithm
{
public:
  static vtkTIPPOutOfCoreDelaunay2D* New();
  vtkTypeMacro(vtkTIPPOutOfCoreDelaunay2D, vtkTableAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The files of points, read in this order as one input: .npy, text, .las, .laz, files of a GIS,
   * meshes of models, or any format that VTK reads. The name "uniform:COUNT" stands for COUNT
   * uniformly distributed points in the unit square instead of a file. SetInputFileName() replaces
   * all files by one.
   */
  vtkTIPPNameListMacro(InputFileName);
  ///@}

  ///@{
  /**
   * The columns of the files that are x and y: a name in the file, or a column index from 0. Empty
   * or null (the default): columns with the usual names, else the first two.
   */
  vtkTIPPStringMacro(XColumn);
  vtkTIPPStringMacro(YColumn);
  ///@}

  ///@{
  /**
   * The folder to write, such as mesh.tipp. Must be set; with CountOnly it only gives the place for
   * temporary files.
   */
  vtkTIPPFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The memory limit of each process, in bytes, for points, triangles and buffers; the program
   * itself and the threads' kernels need some more. Default: 2^31. However low the limit, pieces
   * have at least 4,096 points.
   */
  vtkTIPPClampedMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  ///@}

  ///@{
  /**
   * The columns and rows of a grid of pieces. If either is 0 (the default), pieces are boxes with
   * equally many points, as many boxes as MemoryLimit requires.
   */
  vtkSetVector2Macro(NumberOfPartitions, int);
  vtkGetVector2Macro(NumberOfPartitions, int);
  ///@}

  ///@{
  /**
   * Triangles with an edge longer than this, measured in x and y in the units of the points, are
   * removed; their points stay. 0 (the default): no limit.
   */
  vtkTIPPClampedMacro(MaximumEdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  ///@}

  ///@{
  /**
   * Whether the mesh has the point array "RepresentativePointId": each point's own global id or,
   * for a merged point, that of the point it was merged into. Off by default.
   */
  vtkTIPPSwitchMacro(GenerateRepresentativeIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the mesh has the cell array "NeighborIds" (three components): for each corner of a
   * triangle, the global id of the triangle across the opposite edge, or -1 at the border. Off by
   * default.
   */
  vtkTIPPSwitchMacro(GenerateNeighborIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A file of constraints: lines, whose edges become chains of edges of the mesh, and polygons,
   * which also define the inside (counter-clockwise) and holes (clockwise). Formats: .poly, .csv,
   * .14, GIS files, or any format that VTK reads. None by default.
   */
  vtkTIPPFilePathMacro(ConstraintsFileName);
  ///@}

  ///@{
  /**
   * A file of closed lines, which become constraints; triangles outside of them are removed. None
   * by default.
   */
  vtkTIPPFilePathMacro(BoundaryFileName);
  ///@}

  ///@{
  /**
   * Points in holes: all triangles that are not separated from them by constraints are removed.
   */
  void AddHole(double x, double y);
  void ClearHoles();
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
   * Whether the mesh has the cell array "ConstraintEdges" (three components): 1 if the edge
   * opposite to that corner of the triangle is part of a constraint, else 0. Off by default.
   */
  vtkTIPPSwitchMacro(GenerateConstraintEdges, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether triangles are only counted and summed (TriangleSum, a checksum that does not depend on
   * their order) instead of written. Off by default.
   */
  vtkTIPPSwitchMacro(CountOnly, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to resume an interrupted or failed run with the same FileName, input and options, if
   * there is one. The files are the same as those of an uninterrupted run. Off by default:
   * left-over work of such a run is then an error, and is kept.
   */
  vtkTIPPSwitchMacro(Resume, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A folder, for example on another disk, to which points are spilled. None by default: they are
   * spilled beside the mesh.
   */
  vtkTIPPFilePathMacro(ScratchFolder);
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
   * The ranks that triangulate together. The global controller by default. With null or a
   * controller of one rank, this process works alone.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * The output table.
   */
  vtkTable* GetStatistics() { return this->GetOutput(); }

protected:
  vtkTIPPOutOfCoreDelaunay2D();
  ~vtkTIPPOutOfCoreDelaunay2D() override = default;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::string FileName;
  std::vector<std::string> InputFileNames;
  std::string XColumn;
  std::string YColumn;
  std::string ConstraintsFileName;
  std::string BoundaryFileName;
  std::string ScratchFolder;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 31;
  int NumberOfPartitions[2] = { 0, 0 };
  double MaximumEdgeLength = 0;
  vtkTypeBool GenerateRepresentativeIds = false;
  vtkTypeBool GenerateNeighborIds = false;
  std::vector<std::pair<double, double>> Holes;
  vtkTypeBool SplitCrossings = true;
  vtkTypeBool GenerateConstraintEdges = false;
  vtkTypeBool CountOnly = false;
  vtkTypeBool Resume = false;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  vtkTIPPOutOfCoreDelaunay2D(const vtkTIPPOutOfCoreDelaunay2D&) = delete;
  void operator=(const vtkTIPPOutOfCoreDelaunay2D&) = delete;

  void Execute(vtkTable* output);
  tipp::OutOfCoreOptions Options() const;
};

#endif

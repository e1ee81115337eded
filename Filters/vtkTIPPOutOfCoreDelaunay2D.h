// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTIPPOutOfCoreDelaunay2D
 * @brief   exact 2D Delaunay triangulation of points in files, larger than memory
 *
 * vtkTIPPOutOfCoreDelaunay2D triangulates points of files by x and y and writes the triangles as a
 * partitioned mesh, the folder FileName. Neither points nor triangles need fit in memory. Put a
 * vtkPartitionedUnstructuredReader behind it, which reads the mesh by piece or by range:
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
 * threads. A point's global id is its index in the input. A column z is the third coordinate,
 * other columns and point data become point arrays. Coincident points are merged into the
 * one of lowest id; points with a NaN or infinite x or y are left out, with one warning.
 * Documentation/OutOfCore.md tells how it works, what it needs on the disk, and the formats of
 * files.
 *
 * Constraints come from files, too (ConstraintsFileName, BoundaryFileName, AddHole()): the result
 * is then the constrained Delaunay triangulation of vtkTIPPDelaunay2D with a source. Points of
 * these files that the input lacks, and then the points where constraints cross, come after the
 * input's; of their columns they have z alone. The statistics have Constraints, ConstraintEdges,
 * CrossingPoints and CrossingRounds then, unless the run was resumed.
 *
 * The output, also GetStatistics(), is a vtkTable about the run. It has a row for each phase, with
 * the columns Phase (its name) and Seconds (wall-clock), and as field data, one value each, Points,
 * Triangles, DuplicatePoints, RejectedPoints, Pieces, Partitions, WorkerVertices (vertices
 * triangulated by all workers together), BoundaryBytes (of vertices that were sent from one piece
 * to another), SpilledBytes (of points), MeshBytes (on disk), Threads, Resumed (1 if the run has
 * gone on from another, else 0), and with CountOnly TriangleSum.
 *
 * The folder appears when it is whole, and replaces a partitioned mesh of that name
 * already. An error, or an abort, leaves what was there and an empty output; from the time when
 * points are spilled the work is kept in a hidden folder beside it, from which Resume goes on.
 * Errors: an input that cannot be read or has changed meanwhile, other columns than the first
 * file's, no finite point, a folder that cannot be written, too little room on the disk (with the
 * numbers), work of another run in the hidden folder.
 *
 * With a Controller of several ranks all of them update the filter together, with the same
 * properties; the files are the same for every number of ranks. MemoryLimit and NumberOfThreads are
 * those of each rank. All must see the folders of FileName and ScratchFolder. The figures are on
 * the first rank. If one rank fails or stops, all do; the first rank reports it.
 *
 * @warning
 * It executes when a property has changed, not when a file has: call Modified() then.
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

#include "vtkTIPPFiltersModule.h" // For export macro
#include "vtkTableAlgorithm.h"

#include <string>  // For InputFileNames
#include <utility> // For Holes
#include <vector>  // For InputFileNames

class vtkMultiProcessController;

namespace tipp
{
struct OutOfCoreOptions;
struct OutOfCoreStatistics;
}

class VTKTIPPFILTERS_EXPORT vtkTIPPOutOfCoreDelaunay2D : public vtkTableAlgorithm
{
public:
  static vtkTIPPOutOfCoreDelaunay2D* New();
  vtkTypeMacro(vtkTIPPOutOfCoreDelaunay2D, vtkTableAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The files of points, which are one input in their order: .npy, text (.csv, .txt, .xyz), .14,
   * .grd, or any format that VTK reads. "uniform:COUNT" is no file but stands for COUNT uniform
   * points in the unit square. SetInputFileName() leaves one file alone.
   */
  void AddInputFileName(const char* name);
  void SetInputFileName(const char* name);
  void ClearInputFileNames();
  int GetNumberOfInputFileNames() const;
  const char* GetInputFileName(int index) const;
  ///@}

  ///@{
  /**
   * Which columns of the files are x and y: a name as the file has it, or a number counted from 0.
   * Empty or null (the default): by the usual names, else the first two.
   */
  vtkSetStringMacro(XColumn);
  vtkGetStringMacro(XColumn);
  vtkSetStringMacro(YColumn);
  vtkGetStringMacro(YColumn);
  ///@}

  ///@{
  /**
   * The folder to write, as mesh.tipp. With CountOnly nothing is there in the end.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Bytes that points, triangles and buffers may take in each process; the process itself and the
   * threads' kernels come on top. Default 2 GiB. However small, pieces have 4,096 points at least.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Columns and rows of a grid of pieces. If either is 0 (the default), they are boxes of equally
   * many points, as many as MemoryLimit asks for.
   */
  vtkSetVector2Macro(NumberOfPartitions, int);
  vtkGetVector2Macro(NumberOfPartitions, int);
  ///@}

  ///@{
  /**
   * Triangles with an edge longer than this, in the plane and the units of the points, are left
   * out; their points stay. 0 by default: none are.
   */
  vtkSetClampMacro(MaximumEdgeLength, double, 0.0, VTK_DOUBLE_MAX);
  vtkGetMacro(MaximumEdgeLength, double);
  ///@}

  ///@{
  /**
   * Whether the mesh has the point array "RepresentativePointId": the global id of the point that
   * stands for it, which is its own but for merged points. Off by default.
   */
  vtkSetMacro(GenerateRepresentativeIds, vtkTypeBool);
  vtkGetMacro(GenerateRepresentativeIds, vtkTypeBool);
  vtkBooleanMacro(GenerateRepresentativeIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether the mesh has the cell array "NeighborIds": for each corner of a triangle the global id
   * of the triangle opposite to it, or -1 at the hull. Off by default.
   */
  vtkSetMacro(GenerateNeighborIds, vtkTypeBool);
  vtkGetMacro(GenerateNeighborIds, vtkTypeBool);
  vtkBooleanMacro(GenerateNeighborIds, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A file of constraints: lines, whose edges are chains of edges of the mesh, and polygons, of
   * which counter-clockwise ones keep their inside and clockwise ones are holes: .poly, .csv, .14,
   * files of a GIS, or any format that VTK reads. None by default.
   */
  vtkSetFilePathMacro(ConstraintsFileName);
  vtkGetFilePathMacro(ConstraintsFileName);
  ///@}

  ///@{
  /**
   * A file of closed lines, which are constraints: triangles outside of them are removed. None by
   * default.
   */
  vtkSetFilePathMacro(BoundaryFileName);
  vtkGetFilePathMacro(BoundaryFileName);
  ///@}

  ///@{
  /**
   * Points in holes: triangles that constraints do not part from them are removed.
   */
  void AddHole(double x, double y);
  void ClearHoles();
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
   * Whether the mesh has the cell array "ConstraintEdges": for each corner of a triangle 1 if the
   * edge opposite to it is one of a constraint, else 0. Off by default.
   */
  vtkSetMacro(GenerateConstraintEdges, vtkTypeBool);
  vtkGetMacro(GenerateConstraintEdges, vtkTypeBool);
  vtkBooleanMacro(GenerateConstraintEdges, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether triangles are counted and summed up (TriangleSum: a checksum of them, whatever their
   * order) instead of written. Off by default.
   */
  vtkSetMacro(CountOnly, vtkTypeBool);
  vtkGetMacro(CountOnly, vtkTypeBool);
  vtkBooleanMacro(CountOnly, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Whether to go on where a run for the same FileName, input and options was ended, killed or
   * failed, if there is one. The files are those of a run that was not. Off by default: then such
   * work is an error and is not touched.
   */
  vtkSetMacro(Resume, vtkTypeBool);
  vtkGetMacro(Resume, vtkTypeBool);
  vtkBooleanMacro(Resume, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A folder on another disk for the points that are spilled. None by default: beside the mesh.
   */
  vtkSetFilePathMacro(ScratchFolder);
  vtkGetFilePathMacro(ScratchFolder);
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
   * The ranks that triangulate together. The global controller by default; null, or a controller of
   * one rank: this process alone.
   */
  virtual void SetController(vtkMultiProcessController*);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * The output.
   */
  vtkTable* GetStatistics() { return this->GetOutput(); }

protected:
  vtkTIPPOutOfCoreDelaunay2D();
  ~vtkTIPPOutOfCoreDelaunay2D() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  std::vector<std::string> InputFileNames;
  char* XColumn = nullptr;
  char* YColumn = nullptr;
  char* FileName = nullptr;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 31;
  int NumberOfPartitions[2] = { 0, 0 };
  double MaximumEdgeLength = 0;
  vtkTypeBool GenerateRepresentativeIds = 0;
  vtkTypeBool GenerateNeighborIds = 0;
  char* ConstraintsFileName = nullptr;
  char* BoundaryFileName = nullptr;
  std::vector<std::pair<double, double>> Holes;
  vtkTypeBool SplitCrossings = 1;
  vtkTypeBool GenerateConstraintEdges = 0;
  vtkTypeBool CountOnly = 0;
  vtkTypeBool Resume = 0;
  char* ScratchFolder = nullptr;
  int NumberOfThreads = 0;
  vtkMultiProcessController* Controller = nullptr;

private:
  vtkTIPPOutOfCoreDelaunay2D(const vtkTIPPOutOfCoreDelaunay2D&) = delete;
  void operator=(const vtkTIPPOutOfCoreDelaunay2D&) = delete;

  void Execute(vtkTable* output);
  tipp::OutOfCoreOptions Options() const;
  void Report(const tipp::OutOfCoreStatistics& statistics);
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartitionedUnstructuredReader
 * @brief   reads a partitioned or a flat mesh, or the output of a model, by piece and by range
 *
 * FileName is one of
 * - a partitioned mesh, as vtkPartitionedUnstructuredWriter and `tipp partition` make it: its
 *   folder or the index in it. Only the requested pieces are opened;
 * - a flat mesh: a folder of .npy arrays (cells.npy, points.npy, point_data/, cell_data/, time.npy)
 *   or a .vtu file with appended, raw, uncompressed data of nothing but triangles or nothing but
 *   tetrahedra. Its cells are loaded chunk by chunk (Direct Load) within MemoryLimit and
 *   partitioned according to Tiling; only the cells of the requested pieces are kept. The pieces
 *   are the same as those of a stored partitioned mesh;
 * - the output of a model, as `tipp flatten` reads it: NetCDF by UGRID, ADCIRC, SCHISM, FVCOM,
 * FESOM or MPAS (.nc), SELAFIN (.slf), and meshes of ADCIRC (.14, .grd), SCHISM (.gr3) and SMS
 * (.2dm), or .vtkhdf with time steps. It is one piece; each rank reads the mesh, and one the
 * values. Other cells than triangles are cut, and missing values are NaN.
 *
 * A partition is a closed box. A cell is owned by the first partition that it shares a point with
 * and borrowed by the others that it meets, decided exactly. Points and cells have VTK global ids,
 * "GlobalPointIds" (the point's index in the flat mesh) and "GlobalCellIds". vtkGhostType marks
 * points that another piece owns and, with BorrowerMode OWNED_AND_BORROWED or if the pipeline
 * requests ghost levels, the borrowed cells.
 *
 * Any number of pieces can be requested (UPDATE_PIECE_NUMBER of UPDATE_NUMBER_OF_PIECES): each
 * consists of consecutive partitions, with about equal weight per piece, or is empty. With a
 * Controller of several ranks all of them must execute the reader together, each for its own piece;
 * an error on one rank is an error on all.
 *
 * The output is a vtkUnstructuredGrid, or with MergePieces off a vtkPartitionedDataSet with a
 * partition for each piece. TIME_STEPS are those of the mesh. Arrays that vary in time are read at
 * the last step that is not after the requested time, or else at the first step.
 *
 * Errors are reported and leave the output empty. Counts, offsets and checksums in files are
 * checked before they are used.
 *
 * Related publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapters 4 (Direct Load, owner and borrower cells)
 * and 5.
 *
 * @sa
 * vtkXMLPUnstructuredGridReader
 */

#ifndef vtkPartitionedUnstructuredReader_h
#define vtkPartitionedUnstructuredReader_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkMultiProcessController.h" // For the Controller
#include "vtkNew.h"                    // For the arrays' selections
#include "vtkSmartPointer.h"           // For the Controller
#include "vtkTIPPIOModule.h"           // For export macro
#include "vtkTIPPSetGet.h"             // For property macros

#include <memory> // For std::unique_ptr
#include <string> // For ValuesFileNames
#include <vector> // For ValuesFileNames

class vtkDataArraySelection;

namespace tipp
{
class Communicator;
}

class VTKTIPPIO_EXPORT vtkPartitionedUnstructuredReader : public vtkDataObjectAlgorithm
{
public:
  static vtkPartitionedUnstructuredReader* New();
  vtkTypeMacro(vtkPartitionedUnstructuredReader, vtkDataObjectAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What to do with cells that several partitions meet.
   */
  enum BorrowerModeType
  {
    OWNED = 0,             ///< each cell is only in the piece that owns it
    OWNED_AND_BORROWED = 1 ///< borrowers get it too, as a ghost cell
  };

  ///@{
  /**
   * The mesh: a folder or a file, see above.
   */
  vtkTIPPFilePathMacro(FileName);
  ///@}

  /**
   * Returns 1 if the path looks like a mesh that can be read (reading it may still fail), else 0.
   */
  virtual int CanReadFile(VTK_FILEPATH const char* path);

  ///@{
  /**
   * The range to read, (xmin, xmax, ymin, ymax, zmin, zmax), in the mesh's units. Only pieces whose
   * partition meets the range are opened; the output has the cells that share a point with the
   * closed box, decided exactly (triangles by x and y only), and their points. A cell or point
   * whose owner is not opened is assigned to the lowest opened piece that it meets. xmin > xmax
   * (the default, vtkMath::UninitializeBounds) reads everything; ymin > ymax or zmin > zmax alone
   * is an error.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * Whether Bounds that do not meet the points' bounding box, or are more than ten times as long
   * along an axis, are an error: they are probably in another order. Off by default: then the
   * output may be empty.
   */
  vtkTIPPSwitchMacro(StrictBounds, bool);
  ///@}

  ///@{
  /**
   * OWNED (the default) or OWNED_AND_BORROWED. A request for ghost levels has the effect of the
   * latter.
   */
  vtkTIPPClampedMacro(BorrowerMode, int, OWNED, OWNED_AND_BORROWED);
  void SetBorrowerModeToOwned() { this->SetBorrowerMode(OWNED); }
  void SetBorrowerModeToOwnedAndBorrowed() { this->SetBorrowerMode(OWNED_AND_BORROWED); }
  ///@}

  ///@{
  /**
   * Whether the output is one vtkUnstructuredGrid (the default), without duplicate points and
   * cells, or a vtkPartitionedDataSet of pieces.
   */
  vtkTIPPSwitchMacro(MergePieces, bool);
  ///@}

  ///@{
  /**
   * How many of the most recently read pieces are kept in memory for later requests. Default: 0.
   */
  vtkTIPPClampedMacro(CacheSize, int, 0, VTK_INT_MAX);
  ///@}

  ///@{
  /**
   * The memory limit, in bytes, for loading a flat mesh, not counting the pieces themselves.
   * Default: 2^31.
   */
  vtkTIPPClampedMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  ///@}

  ///@{
  /**
   * Number of threads that read pieces, or load and partition a flat mesh. 0 (the
   * default): OMP_NUM_THREADS, or as many as the processors that this process may use, by its
   * affinity, its control group and the ranks on this computer.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, 4096);
  ///@}

  ///@{
  /**
   * How a flat mesh is partitioned: "grid:4x4" (the default) or "grid:4x4x2" for a regular grid;
   * "quadtree:T" or "octree:T" for a tree whose nodes with more than T cells are split. Cells
   * longer than the node are not counted, and the depth is limited.
   */
  vtkTIPPStringMacro(Tiling);
  ///@}

  ///@{
  /**
   * Of the output of a model: more files, with values at the nodes or cells of the mesh in
   * FileName, such as fort.63 beside fort.14. None by default.
   */
  vtkTIPPNameListMacro(ValuesFileName);
  ///@}

  ///@{
  /**
   * Of the output of a model in degrees: whether cells that cross the meridian at which longitudes
   * jump are on either side of it. Off by default: then such cells are an error.
   */
  vtkTIPPSwitchMacro(Wrap, bool);
  ///@}

  ///@{
  /**
   * The unit and origin of TIME_STEPS in the manner of CF, such as "seconds since 2008-09-01",
   * their calendar, and the coordinate reference system, such as "EPSG:4326" or WKT; null where the
   * mesh does not state it. Known after UpdateInformation().
   */
  const char* GetTimeUnits() const;
  const char* GetCalendar() const;
  const char* GetReferenceSystem() const;
  ///@}

  ///@{
  /**
   * The ranks that execute the reader together. The global controller by default. With null this
   * process works alone.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Which arrays are read; their names are known after UpdateInformation(). All by default. The
   * reader owns the selections.
   */
  vtkDataArraySelection* GetPointDataArraySelection();
  vtkDataArraySelection* GetCellDataArraySelection();
  ///@}

  ///@{
  /**
   * Statistics of the last update on this process: the number of pieces read (of a flat mesh:
   * created), not counting pieces from the cache, and of bytes read from piece files (0 for a flat
   * mesh).
   */
  vtkGetMacro(NumberOfPiecesRead, vtkTypeInt64);
  vtkGetMacro(NumberOfBytesRead, vtkTypeInt64);
  ///@}

  /**
   * Includes the modification times of the array selections.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPartitionedUnstructuredReader();
  ~vtkPartitionedUnstructuredReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPartitionedUnstructuredReader(const vtkPartitionedUnstructuredReader&) = delete;
  void operator=(const vtkPartitionedUnstructuredReader&) = delete;

  class Internals;

  bool HasBounds() const;
  void CheckBounds() const;
  void OpenSource();
  void DescribeArrays();
  void ReadPieces(vtkInformation* outInfo);
  void ReadUnchanged(vtkInformation* outInfo, tipp::Communicator& ranks);

  std::string FileName;
  std::string Tiling = "grid:4x4";
  std::vector<std::string> ValuesFileNames;
  bool Wrap = false;
  double Bounds[6];
  bool StrictBounds = false;
  int BorrowerMode = OWNED;
  bool MergePieces = true;
  int CacheSize = 0;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 31;
  int NumberOfThreads = 0;
  vtkTypeInt64 NumberOfPiecesRead = 0;
  vtkTypeInt64 NumberOfBytesRead = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;
  vtkNew<vtkDataArraySelection> PointDataArraySelection;
  vtkNew<vtkDataArraySelection> CellDataArraySelection;
  std::unique_ptr<Internals> Inner;
};

#endif

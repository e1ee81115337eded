// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartitionedUnstructuredReader
 * @brief   reads a partitioned or a flat mesh of triangles or tetrahedra, by piece and by range
 *
 * FileName is one of
 * - a partitioned mesh, as vtkPartitionedUnstructuredWriter and `tipp partition` make it: its
 * folder or the index in it. Only the pieces that are asked for are opened;
 * - a flat mesh: a folder of .npy arrays (cells.npy, points.npy, point_data/, cell_data/, time.npy)
 *   or a .vtu file with appended, raw, uncompressed data of nothing but triangles or nothing but
 *   tetrahedra. Its cells are loaded chunk by chunk (Direct Load) within MemoryLimit, partitioned
 * as Tiling says, and those of the pieces that are asked for are kept. The pieces are those that
 * the stored mesh would have.
 *
 * A partition is a closed box. A cell is owned by the first partition that it shares a point with
 * and borrowed by the others; this is decided exactly. Points carry their global ids
 * ("GlobalPointIds", the point's number in the flat mesh), cells theirs ("GlobalCellIds"), both as
 * VTK's global ids. vtkGhostType marks points that belong to another piece and, with BorrowerMode
 * OWNED_AND_BORROWED or where the pipeline asks for ghost levels, the borrowed cells.
 *
 * Any number of pieces can be requested (UPDATE_PIECE_NUMBER of UPDATE_NUMBER_OF_PIECES): each gets
 * successive partitions of about equal weight, or none. With a Controller of several ranks all of
 * them must execute the reader together, each for its own piece; what goes wrong on one is an error
 * on all.
 *
 * The output is a vtkUnstructuredGrid, or with MergePieces off a vtkPartitionedDataSet with a
 * partition for each piece. TIME_STEPS are those of the mesh; of arrays that vary in time, the last
 * step not after the requested time is read, or the first.
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
#include "vtkNew.h"          // For the arrays' selections
#include "vtkTIPPIOModule.h" // For export macro

#include <memory> // For std::unique_ptr

class vtkDataArraySelection;
class vtkMultiProcessController;

class VTKTIPPIO_EXPORT vtkPartitionedUnstructuredReader : public vtkDataObjectAlgorithm
{
public:
  static vtkPartitionedUnstructuredReader* New();
  vtkTypeMacro(vtkPartitionedUnstructuredReader, vtkDataObjectAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What becomes of cells that several partitions meet.
   */
  enum BorrowerModeType
  {
    OWNED = 0,             ///< each cell is in one piece, its owner
    OWNED_AND_BORROWED = 1 ///< borrowers have it too, as a ghost
  };

  ///@{
  /**
   * The mesh: a folder or a file, see above.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * Whether the path looks like a mesh that can be read; reading it may still fail.
   */
  virtual int CanReadFile(VTK_FILEPATH const char* path);

  ///@{
  /**
   * The range to read: x from, x to, y from, y to, z from, z to, in the mesh's units. Only pieces
   * whose partition it meets are opened; the output has the cells that share a point with the
   * closed box, decided exactly (triangles by x and y alone), and their points. A cell or point
   * whose owner is not opened belongs to the lowest opened piece that it meets. Bounds with from >
   * to along x (the default, vtkMath::UninitializeBounds) stand for everything; along y or z alone
   * that is an error.
   */
  vtkSetVector6Macro(Bounds, double);
  vtkGetVector6Macro(Bounds, double);
  ///@}

  ///@{
  /**
   * OWNED (the default) or OWNED_AND_BORROWED. A request for ghost levels has the effect of the
   * latter.
   */
  vtkSetClampMacro(BorrowerMode, int, OWNED, OWNED_AND_BORROWED);
  vtkGetMacro(BorrowerMode, int);
  void SetBorrowerModeToOwned() { this->SetBorrowerMode(OWNED); }
  void SetBorrowerModeToOwnedAndBorrowed() { this->SetBorrowerMode(OWNED_AND_BORROWED); }
  ///@}

  ///@{
  /**
   * Whether the output is one vtkUnstructuredGrid (the default), in which each point and cell is
   * once, or a vtkPartitionedDataSet of pieces.
   */
  vtkSetMacro(MergePieces, bool);
  vtkGetMacro(MergePieces, bool);
  vtkBooleanMacro(MergePieces, bool);
  ///@}

  ///@{
  /**
   * How many of the last read pieces stay in memory for the next request. Default: 0.
   */
  vtkSetClampMacro(CacheSize, int, 0, VTK_INT_MAX);
  vtkGetMacro(CacheSize, int);
  ///@}

  ///@{
  /**
   * Bytes that loading a flat mesh may take besides the pieces themselves. Default: 2^31.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * Number of threads that read pieces, or load and partition a flat mesh. Default 0: as many as
   * OpenMP would take.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, 4096);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * How a flat mesh is partitioned: "grid:4x4" (the default), "grid:4x4x2", "quadtree:T" or
   * "octree:T": nodes of the tree that more than T cells meet are split, of which only cells no
   * longer than the node count, down to a depth that ends it in any case.
   */
  vtkSetStringMacro(Tiling);
  vtkGetStringMacro(Tiling);
  ///@}

  ///@{
  /**
   * The ranks that execute the reader together. Default: the global controller; null: this process
   * alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Which arrays are read; known after UpdateInformation(). All by default.
   */
  vtkDataArraySelection* GetPointDataArraySelection();
  vtkDataArraySelection* GetCellDataArraySelection();
  ///@}

  ///@{
  /**
   * Of the last update on this process: pieces that were read, of a flat mesh those that were made,
   * and bytes read from pieces' files, 0 for a flat mesh. Pieces from the cache do not count.
   */
  vtkGetMacro(NumberOfPiecesRead, vtkTypeInt64);
  vtkGetMacro(NumberOfBytesRead, vtkTypeInt64);
  ///@}

  /**
   * Also that of the array selections.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkPartitionedUnstructuredReader();
  ~vtkPartitionedUnstructuredReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkPartitionedUnstructuredReader(const vtkPartitionedUnstructuredReader&) = delete;
  void operator=(const vtkPartitionedUnstructuredReader&) = delete;

  class Internals;

  bool HasBounds() const;
  void CheckBounds() const;
  void OpenSource();
  void DescribeArrays();
  void ReadPieces(vtkInformation* outInfo);

  char* FileName = nullptr;
  char* Tiling = nullptr;
  double Bounds[6];
  int BorrowerMode = OWNED;
  bool MergePieces = true;
  int CacheSize = 0;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 31;
  int NumberOfThreads = 0;
  vtkTypeInt64 NumberOfPiecesRead = 0;
  vtkTypeInt64 NumberOfBytesRead = 0;
  vtkMultiProcessController* Controller = nullptr;
  vtkNew<vtkDataArraySelection> PointDataArraySelection;
  vtkNew<vtkDataArraySelection> CellDataArraySelection;
  std::unique_ptr<Internals> Inner;
};

#endif

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartitionedUnstructuredWriter
 * @brief   writes a mesh of triangles or tetrahedra as a partitioned mesh
 *
 * vtkPartitionedUnstructuredWriter cuts a mesh into partitions and writes a folder with a .vtu file
 * for each, a .pvtu over them, which vtkXMLPUnstructuredGridReader reads, and an index, by which
 * vtkPartitionedUnstructuredReader reads a range or a piece. Documentation/PartitionedMesh.md tells
 * the format.
 *
 * The mesh is the input, a vtkDataSet or a vtkPartitionedDataSet, or, with InputFileName, a mesh in
 * a file of any size: a folder of .npy arrays or a .vtu file with appended, raw,
 * uncompressed data. Cells of an input other than triangles and tetrahedra are cut into these,
 * ghost cells and cells of a lower dimension are left out. Points with equal coordinates in
 * different data sets become one. Its arrays GlobalPointIds, GlobalCellIds and vtkGhostType, if it
 * has any, are not stored: the partitioned mesh has its own.
 *
 * A partition is a closed box. A cell is owned by the first partition that it shares a point with,
 * decided exactly; the others that it meets borrow it, by reference or, with DuplicateBorrowers, as
 * ghost cells in their own pieces. The files depend on the mesh, Tiling and DuplicateBorrowers
 * alone: not on memory, threads, device or the number of ranks.
 *
 * With a controller of several ranks all of them must call Write(), and all must see the same
 * files. The ranks' inputs together are the mesh then; they are brought to the first rank, which
 * must have room for them. InputFileName has no such limit.
 *
 * The folder appears when it is whole. One that is there already is replaced if it is a partitioned
 * mesh, else that is an error. An error, or an abort, leaves what was there.
 *
 * Related publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapters 4 and 5.
 *
 * @sa
 * vtkPartitionedUnstructuredReader vtkXMLPUnstructuredGridWriter
 */

#ifndef vtkPartitionedUnstructuredWriter_h
#define vtkPartitionedUnstructuredWriter_h

#include "vtkTIPPIOModule.h"  // For export macro
#include "vtkVersionMacros.h" // For VTK_VERSION_NUMBER
#include "vtkWriter.h"

class vtkMultiProcessController;

class VTKTIPPIO_EXPORT vtkPartitionedUnstructuredWriter : public vtkWriter
{
public:
  static vtkPartitionedUnstructuredWriter* New();
  vtkTypeMacro(vtkPartitionedUnstructuredWriter, vtkWriter)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to write, as mesh.tipp.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * A flat mesh, or any file of VTK's, to take instead of the input. None by default.
   */
  vtkSetFilePathMacro(InputFileName);
  vtkGetFilePathMacro(InputFileName);
  ///@}

  ///@{
  /**
   * How the bounding box is cut: "grid:4x4" or "grid:4x4x2" for a regular grid, "quadtree:N" or
   * "octree:N" for a tree whose nodes with more than N cells (no longer than the node) are split,
   * down to a depth that ends it in any case.
   * Default "grid:4x4".
   */
  vtkSetStringMacro(Tiling);
  vtkGetStringMacro(Tiling);
  ///@}

  ///@{
  /**
   * Whether borrowed cells are copied to their borrowers' pieces as ghost cells. Off by default:
   * they are stored once, and read from their owners' pieces.
   */
  vtkSetMacro(DuplicateBorrowers, bool);
  vtkGetMacro(DuplicateBorrowers, bool);
  vtkBooleanMacro(DuplicateBorrowers, bool);
  ///@}

  ///@{
  /**
   * Bytes that each rank may take, not counting the input. Default 2 GiB.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  ///@{
  /**
   * How vertices are loaded: "auto" (the default), "direct", "fine", "lru" or "mmap".
   */
  vtkSetStringMacro(Loader);
  vtkGetStringMacro(Loader);
  ///@}

  ///@{
  /**
   * What classifies cells at the partitions' borders: "openmp" (the default), "opencl",
   * "opencl:NAME" or "auto".
   */
  vtkSetStringMacro(Device);
  vtkGetStringMacro(Device);
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
   * The ranks that work together. By default the global controller; null: this process alone.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  /**
   * Writes the mesh. Returns 1, or 0 after an error, which is reported on every rank, or an abort.
   */
  int Write() override;

protected:
  vtkPartitionedUnstructuredWriter();
  ~vtkPartitionedUnstructuredWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 7, 0)
  bool WriteDataAndReturn() override;
#else
  void WriteData() override;
#endif

private:
  vtkPartitionedUnstructuredWriter(const vtkPartitionedUnstructuredWriter&) = delete;
  void operator=(const vtkPartitionedUnstructuredWriter&) = delete;

  void WriteOnRanks();
  void RequireInput();
  void WritePartitioned();
  void Partition();

  char* FileName = nullptr;
  char* InputFileName = nullptr;
  char* Tiling = nullptr;
  char* Loader = nullptr;
  char* Device = nullptr;
  bool DuplicateBorrowers = false;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 31;
  int NumberOfThreads = 0;
  vtkMultiProcessController* Controller = nullptr;
  bool Written = false;
};

#endif

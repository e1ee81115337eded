// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPartitionedUnstructuredWriter
 * @brief   writes a mesh of triangles or tetrahedra as a partitioned mesh
 *
 * vtkPartitionedUnstructuredWriter divides a mesh into partitions and writes a folder with a .vtu
 * file for each, a .pvtu file for vtkXMLPUnstructuredGridReader, and an index with which
 * vtkPartitionedUnstructuredReader reads a range or a piece. Documentation/PartitionedMesh.md
 * describes the format.
 *
 * The mesh is the input, a vtkDataSet or a vtkPartitionedDataSet, or, with InputFileName, a mesh in
 * a file of any size: a folder of .npy arrays or a .vtu file with appended, raw, uncompressed data.
 * Cells of the input other than triangles and tetrahedra are divided into these; ghost cells and
 * cells of a lower dimension are left out. Points of different data sets with equal coordinates are
 * merged. The input's arrays GlobalPointIds, GlobalCellIds and vtkGhostType are replaced by those
 * of the partitioned mesh.
 *
 * A partition is a closed box. A cell is owned by the first partition that it shares a point with,
 * decided exactly; the others that it meets borrow it, by reference or, with DuplicateBorrowers, as
 * ghost cells in their own pieces. The files depend only on the mesh, Tiling and
 * DuplicateBorrowers, not on the memory limit, threads, device or number of ranks.
 *
 * With a controller of several ranks all of them must call Write(), and all must see the same
 * files. The mesh is then the union of the ranks' inputs. They are gathered on the first rank,
 * which must have enough memory for all of them; InputFileName has no such limit.
 *
 * The folder appears only when it is complete. It replaces an existing partitioned mesh; if the
 * path holds anything else, that is an error. After an error or an abort the path is unchanged.
 *
 * Related publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapters 4 and 5.
 *
 * @sa
 * vtkPartitionedUnstructuredReader vtkXMLPUnstructuredGridWriter
 */

#ifndef vtkPartitionedUnstructuredWriter_h
#define vtkPartitionedUnstructuredWriter_h

#include "vtkMultiProcessController.h" // For the Controller
#include "vtkSmartPointer.h"           // For the Controller
#include "vtkTIPPIOModule.h"           // For export macro
#include "vtkTIPPSetGet.h"             // For property macros
#include "vtkVersionMacros.h"          // For VTK_VERSION_NUMBER
#include "vtkWriter.h"

class VTKTIPPIO_EXPORT vtkPartitionedUnstructuredWriter : public vtkWriter
{
public:
  static vtkPartitionedUnstructuredWriter* New();
  vtkTypeMacro(vtkPartitionedUnstructuredWriter, vtkWriter)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder to write, such as mesh.tipp. Must be set.
   */
  vtkTIPPFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * A flat mesh or any file that VTK reads, to write instead of the input. None by default.
   */
  vtkTIPPFilePathMacro(InputFileName);
  ///@}

  ///@{
  /**
   * How the bounding box is divided: "grid:4x4" (the default) or "grid:4x4x2" for a regular grid;
   * "quadtree:N" or "octree:N" for a tree whose nodes with more than N cells are split. Cells
   * longer than the node are not counted, and the depth is limited.
   */
  vtkTIPPStringMacro(Tiling);
  ///@}

  ///@{
  /**
   * Whether borrowed cells are copied to their borrowers' pieces as ghost cells. Off by default:
   * each cell is stored once, and borrowers read it from the owner's piece.
   */
  vtkTIPPSwitchMacro(DuplicateBorrowers, bool);
  ///@}

  ///@{
  /**
   * The memory limit of each rank, in bytes, not counting the input. Default: 2^31.
   */
  vtkTIPPClampedMacro(MemoryLimit, vtkTypeInt64, 1, VTK_TYPE_INT64_MAX);
  ///@}

  ///@{
  /**
   * How vertices are loaded: "auto" (the default), "direct", "fine" or "mmap".
   */
  vtkTIPPStringMacro(Loader);
  ///@}

  ///@{
  /**
   * The device that classifies cells at the partitions' borders: "openmp" (the default), "opencl",
   * "opencl:NAME" or "auto".
   */
  vtkTIPPStringMacro(Device);
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
   * Writes the mesh. Returns 1, or 0 after an error, which is reported on every rank, or an abort.
   */
  int Write() override;

protected:
  vtkPartitionedUnstructuredWriter();
  ~vtkPartitionedUnstructuredWriter() override = default;

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

  std::string FileName;
  std::string InputFileName;
  std::string Tiling = "grid:4x4";
  std::string Loader = "auto";
  std::string Device = "openmp";
  bool DuplicateBorrowers = false;
  vtkTypeInt64 MemoryLimit = vtkTypeInt64(1) << 31;
  int NumberOfThreads = 0;
  vtkSmartPointer<vtkMultiProcessController> Controller;
  bool Written = false;
};

#endif

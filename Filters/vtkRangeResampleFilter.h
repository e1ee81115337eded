// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRangeResampleFilter
 * @brief   resamples a range of a triangle or tetrahedron mesh to a regular grid, in parallel
 *
 * vtkRangeResampleFilter evaluates the arrays of a mesh at the samples `bounds.min + i * delta` of
 * a box-shaped range. Every sample inside the closed mesh is found and none outside it: which cell
 * contains a sample is decided exactly, and a sample on an edge or a corner between cells is
 * answered by the one that contains it after a move by (e, e^2, e^3), e being as small as can be.
 * On the far border of the mesh the mirrored moves follow, in a fixed order. The image is the same,
 * bit for bit, for every NumberOfThreads, number of ranks, number of pieces, order of the cells and
 * order of the points within them.
 *
 * The input is a vtkUnstructuredGrid, a vtkPolyData or another vtkPointSet, or a composite data set
 * of those, such as vtkPartitionedDataSet. Triangles and tetrahedra are taken as they are. Other
 * surface and volume cells are cut into them; cell arrays then come from the cell that was cut.
 * Polygons must be planar and convex, hexahedra, wedges and pyramids convex; all are linear within
 * the pieces. If there is a cell with a volume, samples are in space and surface cells are ignored
 * with a warning. If there are only surface cells, they are sampled in projection: along the axis
 * that has one sample (z before y before x if more than one has), or along z, with the values
 * repeated along it, if none has. So a noise in z, or a slope, loses no samples.
 *
 * The output is a vtkImageData with, as point data, all selected arrays of the points and the cells
 * - floating-point numbers of points interpolated linearly in double precision and rounded once;
 * - whole numbers of points from the corner of largest weight;
 * - numbers of cells from the cell;
 * - of a surface its z as "elevation", see SampleElevation;
 *
 * and "vtkValidPointMask" (char: 1 where a cell answers, 0 elsewhere) and "vtkGhostType", which
 * blanks the samples that no cell answers and the image's cells that have such a corner. Where no
 * cell answers, the arrays have the NullValue.
 *
 * Where cells overlap, the one of the lowest hash of its coordinates answers; of copies of a cell
 * the first, so they may differ in their values only at that price. Cells without an area or a
 * volume, and those with a coordinate that is NaN or infinite, answer nothing.
 *
 * With a controller of more than one rank every rank asks its input for its own piece, and the
 * samples are exchanged, so that each rank has the extent that is asked of it, or rank 0 all. With
 * NumberOfInputPieces above 1 the input is asked for that many pieces, one after another, and only
 * one at a time must fit into memory. Both need a source that honours requests for pieces. If a
 * rank fails or is stopped, all end, with its reason.
 *
 * GetStatistics() is a vtkTable about the last run of this rank, whose field data has, one value
 * each, Cells, IgnoredCells, VisitedCells (whose boxes have samples), Tests (samples in those
 * boxes), ExactTests, OverlappingClaims, Samples, SamplesHit, Threads and Device, and, of one
 * length, PhaseName and PhaseSeconds (wall-clock seconds; those to and from an OpenCL device are
 * apart). On an OpenCL device VisitedCells, Tests and ExactTests count the cells that it leaves to
 * the threads.
 *
 * Related publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapter 4.4.
 *
 * @sa
 * vtkResampleToImage vtkProbeFilter
 */

#ifndef vtkRangeResampleFilter_h
#define vtkRangeResampleFilter_h

#include "vtkImageAlgorithm.h"
#include "vtkNew.h"               // For the table
#include "vtkTIPPFiltersModule.h" // For export macro

#include <array>  // For dimensions
#include <vector> // For the meshes of an input

class vtkDataArraySelection;
class vtkMultiProcessController;
class vtkPointSet;
class vtkStringArray;
class vtkTable;

namespace tipp
{
class Communicator;
}

class VTKTIPPFILTERS_EXPORT vtkRangeResampleFilter : public vtkImageAlgorithm
{
public:
  static vtkRangeResampleFilter* New();
  vtkTypeMacro(vtkRangeResampleFilter, vtkImageAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * What computes.
   */
  enum DeviceType
  {
    DEVICE_AUTO = 0,   ///< OpenCL on a GPU if the work pays for the transfer, else OpenMP
    DEVICE_OPENMP = 1, ///< the threads of this process
    DEVICE_OPENCL = 2  ///< an OpenCL device; if there is none or it fails, OpenMP, with a warning
  };

  ///@{
  /**
   * Whether the range is the bounding box of the input (the default) and SamplingBounds is ignored.
   */
  vtkSetMacro(UseInputBounds, bool);
  vtkGetMacro(UseInputBounds, bool);
  vtkBooleanMacro(UseInputBounds, bool);
  ///@}

  ///@{
  /**
   * The range as (xmin, xmax, ymin, ymax, zmin, zmax), in the units of the points, both ends
   * included. (0, 1, 0, 1, 0, 1) by default.
   */
  vtkSetVector6Macro(SamplingBounds, double);
  vtkGetVector6Macro(SamplingBounds, double);
  ///@}

  ///@{
  /**
   * The number of samples along each axis, the first at the range's minimum and the last at its
   * maximum. (10, 10, 10) by default. An axis with a Delta ignores it. 0 along an axis, but not
   * along all, means as many as put the samples as far apart as along the first axis that has a
   * number, or one along z for a mesh of surface cells. For that the input is updated as soon as
   * the extent of the output is asked for.
   */
  vtkSetVector3Macro(SamplingDimensions, int);
  vtkGetVector3Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * The distance between samples along each axis, from the range's minimum on. 0 (the default): as
   * SamplingDimensions tells. With UseInputBounds the input is updated as soon as the extent of the
   * output is asked for.
   */
  vtkSetVector3Macro(Delta, double);
  vtkGetVector3Macro(Delta, double);
  ///@}

  ///@{
  /**
   * Which arrays are sampled. All by default; set a name to off, or call DisableAllArrays() and
   * SetUnknownArraySetting(0), then set names to on. A name to be sampled that the input has not
   * makes a warning.
   */
  vtkGetObjectMacro(PointDataArraySelection, vtkDataArraySelection);
  vtkGetObjectMacro(CellDataArraySelection, vtkDataArraySelection);
  ///@}

  ///@{
  /**
   * What arrays have where no cell answers; the nearest number there is, for whole numbers, and 0
   * for NaN. 0 by default.
   */
  vtkSetMacro(NullValue, double);
  vtkGetMacro(NullValue, double);
  ///@}

  ///@{
  /**
   * With UseNoDataValue (off by default) a cell answers nothing if a selected point array has the
   * NoDataValue at one of its corners: models mark dry nodes so. -99999 by default.
   */
  vtkSetMacro(UseNoDataValue, bool);
  vtkGetMacro(UseNoDataValue, bool);
  vtkBooleanMacro(UseNoDataValue, bool);
  vtkSetMacro(NoDataValue, double);
  vtkGetMacro(NoDataValue, double);
  ///@}

  ///@{
  /**
   * Whether the z of a surface is sampled too, as the point array "elevation", beside the other
   * arrays. On by default. It is left out where all points have the same z, where the input has an
   * array of that name, where PointDataArraySelection disables it, and where surfaces are not
   * sampled along z.
   */
  vtkSetMacro(SampleElevation, bool);
  vtkGetMacro(SampleElevation, bool);
  vtkBooleanMacro(SampleElevation, bool);
  ///@}

  ///@{
  /**
   * Whether the input's field data is passed on. On by default.
   */
  vtkSetMacro(PassFieldArrays, bool);
  vtkGetMacro(PassFieldArrays, bool);
  vtkBooleanMacro(PassFieldArrays, bool);
  ///@}

  ///@{
  /**
   * What computes: DEVICE_AUTO (the default), DEVICE_OPENMP or DEVICE_OPENCL. The results of the
   * devices agree to 1e-12 of the largest value at the corners.
   */
  vtkSetClampMacro(Device, int, DEVICE_AUTO, DEVICE_OPENCL);
  vtkGetMacro(Device, int);
  ///@}

  ///@{
  /**
   * The OpenCL device by its number or by a part of its name; see GetDeviceChoices(). -1 and
   * null (the defaults): the first GPU with double precision, or else the first device.
   */
  vtkSetMacro(DeviceIndex, int);
  vtkGetMacro(DeviceIndex, int);
  vtkSetStringMacro(DeviceName);
  vtkGetStringMacro(DeviceName);
  ///@}

  /**
   * Device, DeviceIndex and DeviceName in one, as `tipp resample --device` takes them: "auto",
   * "openmp", "opencl", "opencl:INDEX" or "opencl:NAME".
   */
  void SetDeviceChoice(const char* choice);

  /**
   * What SetDeviceChoice() can be given on this machine: "auto", "openmp" and one for each OpenCL
   * device with double precision.
   */
  vtkStringArray* GetDeviceChoices();

  ///@{
  /**
   * OpenMP threads. 0 (the default): OpenMP's choice.
   */
  vtkSetClampMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  vtkGetMacro(NumberOfThreads, int);
  ///@}

  ///@{
  /**
   * How many pieces each rank asks its input for, one after the other. 1 by default. With more,
   * UseInputBounds must be off.
   */
  vtkSetClampMacro(NumberOfInputPieces, int, 1, VTK_INT_MAX);
  vtkGetMacro(NumberOfInputPieces, int);
  ///@}

  ///@{
  /**
   * The ranks among which the mesh is distributed. The global controller by default; null means
   * this process alone.
   */
  virtual void SetController(vtkMultiProcessController*);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Whether rank 0 gets the whole image and the others an empty one. Off by default: each rank gets
   * the extent asked of it.
   */
  vtkSetMacro(GatherOnRoot, bool);
  vtkGetMacro(GatherOnRoot, bool);
  vtkBooleanMacro(GatherOnRoot, bool);
  ///@}

  /**
   * About the last run: see above.
   */
  vtkTable* GetStatistics();

protected:
  vtkRangeResampleFilter();
  ~vtkRangeResampleFilter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool UseInputBounds = true;
  double SamplingBounds[6] = { 0, 1, 0, 1, 0, 1 };
  int SamplingDimensions[3] = { 10, 10, 10 };
  double Delta[3] = { 0, 0, 0 };
  vtkDataArraySelection* PointDataArraySelection;
  vtkDataArraySelection* CellDataArraySelection;
  double NullValue = 0;
  bool UseNoDataValue = false;
  double NoDataValue = -99999;
  bool SampleElevation = true;
  bool PassFieldArrays = true;
  int Device = DEVICE_AUTO;
  int DeviceIndex = -1;
  char* DeviceName = nullptr;
  int NumberOfThreads = 0;
  int NumberOfInputPieces = 1;
  bool GatherOnRoot = false;
  vtkMultiProcessController* Controller = nullptr;

private:
  vtkRangeResampleFilter(const vtkRangeResampleFilter&) = delete;
  void operator=(const vtkRangeResampleFilter&) = delete;

  class Run;

  std::array<int, 3> Dimensions(const std::array<double, 6>& bounds,
    const std::vector<vtkPointSet*>& meshes, tipp::Communicator& ranks) const;

  vtkNew<vtkTable> Statistics;
  vtkNew<vtkStringArray> DeviceChoices;
};

#endif

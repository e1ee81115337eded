// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkRangeResampleFilter
 * @brief   resamples a range of a triangle or tetrahedron mesh to a regular grid, in parallel
 *
 * vtkRangeResampleFilter evaluates the arrays of a mesh at the samples `bounds.min + i * delta` of
 * a box-shaped range. A sample gets values if and only if it lies in the closed mesh; which cell
 * contains it is decided exactly. A sample on a face, edge or corner shared by several cells takes
 * its values from the cell that contains it after a symbolic move by (e, e^2, e^3) with
 * infinitesimal e. If no cell does, as on the far border of the mesh, the mirrored moves are tried
 * in a fixed order. The image is the same, bit for bit, for every NumberOfThreads, number of ranks,
 * number of pieces, order of the cells and order of the points within them.
 *
 * The input is a vtkUnstructuredGrid, a vtkPolyData or another vtkPointSet, or a composite data set
 * of those, such as vtkPartitionedDataSet. Triangles and tetrahedra are used as they are. Other
 * surface and volume cells are divided into them; cell arrays then come from the original cell.
 * Polygons must be planar and convex; hexahedra, wedges and pyramids must be convex. Values are
 * interpolated linearly in each simplex. If the input has a volume cell, it is sampled in space,
 * and surface cells are ignored with a warning. If it has only surface cells, they are projected
 * along the axis that has one sample (z before y before x if several have), or along z, with the
 * values repeated along it, if none has. So the z of a rough or sloping surface does not matter.
 *
 * The output is a vtkImageData with, as point data, all selected arrays of the points and the cells
 * - floating-point point arrays, interpolated linearly in double precision and rounded once;
 * - integer point arrays, taken from the corner of largest weight;
 * - cell arrays, taken from the cell;
 * - for a surface, its z as "elevation" (see SampleElevation);
 *
 * It also has "vtkValidPointMask" (char: 1 for a sample in a cell, else 0) and "vtkGhostType",
 * which blanks the samples outside of all cells and the image's cells that have such a corner.
 * Samples outside of all cells have NullValue in the other arrays.
 *
 * Where cells overlap, the cell with the lowest hash of its coordinates is sampled; among cells
 * with the same coordinates, the first one, so the result depends on the order of cells only where
 * copies of a cell have different values. Degenerate cells and cells with a NaN or infinite
 * coordinate are never sampled.
 *
 * With a controller of several ranks, every rank requests its own piece of the input, and the
 * samples are exchanged so that each rank gets the extent requested from it (or rank 0 gets
 * everything, see GatherOnRoot). With NumberOfInputPieces above 1, each rank requests that many
 * pieces one after another, so only one of them has to fit into memory. Both need a source that
 * honours piece requests. If one rank fails or is aborted, all ranks stop and report its error.
 *
 * If the input has time steps, the filter keeps which cell each sample is in, 4 bytes per sample,
 * while coordinates, cells and samples stay the same; the next time step then takes a fraction of
 * the time. With DEVICE_AUTO, threads do the work then. Nothing is kept with several ranks, input
 * pieces or meshes, UseNoDataValue, METHOD_CONSERVATIVE or DEVICE_OPENCL.
 *
 * GetStatistics() is a vtkTable about the last run on this rank. Its field data has arrays of one
 * value each: Cells, IgnoredCells, VisitedCells (whose boxes have samples), Tests (samples in those
 * boxes), ExactTests, OverlappingClaims, Samples, SamplesHit, Threads and Device. PhaseName and
 * PhaseSeconds (wall-clock seconds) have one value for each phase; transfers to and from an OpenCL
 * device are phases of their own. With an OpenCL device VisitedCells, Tests and ExactTests count
 * only the cells that the device leaves to the CPU's threads.
 *
 * Related publication: *Efficient Generating and Processing of Large-Scale Unstructured Meshes*,
 * dissertation, University of Mississippi, chapter 4.4.
 *
 * @sa
 * vtkResampleToImage vtkProbeFilter
 */

#ifndef vtkRangeResampleFilter_h
#define vtkRangeResampleFilter_h

#include "vtkDataArraySelection.h" // For the selections
#include "vtkImageAlgorithm.h"
#include "vtkMultiProcessController.h" // For the Controller
#include "vtkNew.h"                    // For the table
#include "vtkSmartPointer.h"           // For the Controller
#include "vtkTIPPFiltersModule.h"      // For export macro
#include "vtkTIPPSetGet.h"             // For property macros

#include <memory> // For what is kept

class vtkStringArray;
class vtkTable;

class VTKTIPPFILTERS_EXPORT vtkRangeResampleFilter : public vtkImageAlgorithm
{
public:
  static vtkRangeResampleFilter* New();
  vtkTypeMacro(vtkRangeResampleFilter, vtkImageAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The device that samples the mesh.
   */
  enum DeviceType // the values of tipp::Device
  {
    DEVICE_AUTO = 0,   ///< OpenCL on a GPU if the work is worth the transfer, else OpenMP
    DEVICE_OPENMP = 1, ///< the threads of this process
    DEVICE_OPENCL = 2  ///< an OpenCL device; if there is none or it fails, OpenMP with a warning
  };

  ///@{
  /**
   * Whether the range is the bounding box of the input (the default) and SamplingBounds is ignored.
   */
  vtkTIPPSwitchMacro(UseInputBounds, bool);
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
   * Whether SamplingBounds that do not meet the bounding box of the input, or are more than ten
   * times as long along an axis, are an error: they are probably in another order. Needs one input
   * piece. Off by default: then a warning says that no sample lies in a cell.
   */
  vtkTIPPSwitchMacro(StrictBounds, bool);
  ///@}

  ///@{
  /**
   * The number of samples along each axis, the first at the range's minimum and the last at its
   * maximum. (10, 10, 10) by default. Ignored along an axis with a Delta. 0 along some but not all
   * axes chooses the number that gives the same spacing as along the first axis that has a number,
   * or one sample along z for a mesh of surface cells; RequestInformation() then updates the input.
   */
  vtkSetVector3Macro(SamplingDimensions, int);
  vtkGetVector3Macro(SamplingDimensions, int);
  ///@}

  ///@{
  /**
   * The distance between samples along each axis, from the range's minimum on. 0 (the default):
   * SamplingDimensions applies. With UseInputBounds, RequestInformation() then updates the input.
   */
  vtkSetVector3Macro(Delta, double);
  vtkGetVector3Macro(Delta, double);
  ///@}

  ///@{
  /**
   * Which arrays are sampled. All by default. Either disable arrays by name, or call
   * DisableAllArrays() and SetUnknownArraySetting(0) and enable some. A warning is issued if the
   * input lacks an enabled array.
   */
  vtkGetObjectMacro(PointDataArraySelection, vtkDataArraySelection);
  vtkGetObjectMacro(CellDataArraySelection, vtkDataArraySelection);
  ///@}

  ///@{
  /**
   * The value of samples outside of all cells. In integer arrays it is rounded to the nearest value
   * of their type, and NaN becomes 0. 0 by default.
   */
  vtkSetMacro(NullValue, double);
  vtkGetMacro(NullValue, double);
  ///@}

  ///@{
  /**
   * With UseNoDataValue (off by default) a cell is not sampled if a selected point array has the
   * value NoDataValue at one of its corners, which is how storm-surge models mark dry nodes. -99999
   * by default.
   */
  vtkTIPPSwitchMacro(UseNoDataValue, bool);
  vtkSetMacro(NoDataValue, double);
  vtkGetMacro(NoDataValue, double);
  ///@}

  ///@{
  /**
   * Whether the z of a surface is sampled, too, as the point array "elevation". On by default. It
   * is omitted if all points have the same z, if the input has an array of that name, if
   * PointDataArraySelection disables it, or if the surface is not projected along z.
   */
  vtkTIPPSwitchMacro(SampleElevation, bool);
  ///@}

  /**
   * What a sample is.
   */
  enum MethodType
  {
    METHOD_LINEAR = 0,      ///< the value of the cell at its position, linear in the cell
    METHOD_CONSERVATIVE = 1 ///< the mean over the covered part of its pixel
  };

  ///@{
  /**
   * A MethodType; METHOD_LINEAR by default. METHOD_CONSERVATIVE computes exact means of the values
   * of surface cells, and of point data as linear in each triangle, over the part of each pixel
   * that cells cover. A pixel has a sample as its centre and reaches half way to the next ones. The
   * results are doubles, and the sum of mean, area and covered share over all pixels is the
   * integral over the mesh, up to rounding. Where cells overlap, each counts. It needs one layer of
   * samples, two samples or a Delta along both axes, and one rank, and runs on threads whatever the
   * Device.
   */
  vtkTIPPClampedMacro(Method, int, METHOD_LINEAR, METHOD_CONSERVATIVE);
  ///@}

  ///@{
  /**
   * Whether METHOD_CONSERVATIVE adds the array "CoveredShare", the share of each pixel that cells
   * cover, from 0 to 1. Off by default.
   */
  vtkTIPPSwitchMacro(PassCoveredShare, bool);
  ///@}

  ///@{
  /**
   * Whether the input's field data is passed on. On by default.
   */
  vtkTIPPSwitchMacro(PassFieldArrays, bool);
  ///@}

  ///@{
  /**
   * A DeviceType; DEVICE_AUTO by default. The results of the devices differ by at most 1e-12 of the
   * largest value at the cell's corners.
   */
  vtkTIPPClampedMacro(Device, int, DEVICE_AUTO, DEVICE_OPENCL);
  ///@}

  ///@{
  /**
   * The OpenCL device, by its index or a part of its name; see GetDeviceChoices(). -1 and null (the
   * defaults): the first GPU with double precision, else the first device.
   */
  vtkSetMacro(DeviceIndex, int);
  vtkGetMacro(DeviceIndex, int);
  vtkTIPPStringMacro(DeviceName);
  ///@}

  /**
   * Sets Device, DeviceIndex and DeviceName from one string, as `tipp resample --device` does:
   * "auto", "openmp", "opencl", "opencl:INDEX" or "opencl:NAME".
   */
  void SetDeviceChoice(const char* choice);

  /**
   * The valid choices for SetDeviceChoice() on this machine: "auto", "openmp" and one for each
   * OpenCL device with double precision. The filter owns the array.
   */
  vtkStringArray* GetDeviceChoices();

  ///@{
  /**
   * The number of OpenMP threads. 0 (the default): OMP_NUM_THREADS, or as many as the processors
   * that this process may use, by its affinity, its control group and the ranks on this computer.
   */
  vtkTIPPClampedMacro(NumberOfThreads, int, 0, VTK_INT_MAX);
  ///@}

  ///@{
  /**
   * How many pieces each rank requests from its input, one after another. 1 by default. With more,
   * UseInputBounds must be off.
   */
  vtkTIPPClampedMacro(NumberOfInputPieces, int, 1, VTK_INT_MAX);
  ///@}

  ///@{
  /**
   * The ranks among which the mesh is distributed. The global controller by default. With null this
   * process works alone.
   */
  vtkSetSmartPointerMacro(Controller, vtkMultiProcessController);
  vtkGetSmartPointerMacro(Controller, vtkMultiProcessController);
  ///@}

  ///@{
  /**
   * Whether rank 0 gets the whole image and the others an empty one. Off by default: each rank gets
   * the extent requested from it.
   */
  vtkTIPPSwitchMacro(GatherOnRoot, bool);
  ///@}

  /**
   * The statistics of the last run, see above. The filter owns the table.
   */
  vtkTable* GetStatistics() { return this->Statistics; }

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
  bool StrictBounds = false;
  double SamplingBounds[6] = { 0, 1, 0, 1, 0, 1 };
  int SamplingDimensions[3] = { 10, 10, 10 };
  double Delta[3] = { 0, 0, 0 };
  vtkNew<vtkDataArraySelection> PointDataArraySelection;
  vtkNew<vtkDataArraySelection> CellDataArraySelection;
  double NullValue = 0;
  bool UseNoDataValue = false;
  double NoDataValue = -99999;
  bool SampleElevation = true;
  bool PassFieldArrays = true;
  int Method = METHOD_LINEAR;
  bool PassCoveredShare = false;
  int Device = DEVICE_AUTO;
  int DeviceIndex = -1;
  std::string DeviceName;
  int NumberOfThreads = 0;
  int NumberOfInputPieces = 1;
  bool GatherOnRoot = false;
  vtkSmartPointer<vtkMultiProcessController> Controller;

private:
  vtkRangeResampleFilter(const vtkRangeResampleFilter&) = delete;
  void operator=(const vtkRangeResampleFilter&) = delete;

  class Resampling;
  class Kept;

  std::unique_ptr<Kept> KeptForSteps; ///< null: the input has no time steps
  vtkNew<vtkTable> Statistics;
  vtkNew<vtkStringArray> DeviceChoices;
};

#endif

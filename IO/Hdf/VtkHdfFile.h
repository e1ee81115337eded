// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkHdfFile_h
#define tippVtkHdfFile_h

#include "Arrays/Scalar.h"
#include "Netcdf/NetcdfFile.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{

/// Tuples of one type, as bytes.
struct HdfValues
{
  Scalar Type = Scalar::Float64;
  std::int64_t Components = 1;
  std::int64_t Tuples = 0;
  std::vector<char> Bytes;
};

/// Cells over points that are numbered from 0 through all parts. All ids are of points that exist,
/// and offsets ascend.
struct HdfCells
{
  std::vector<std::int64_t> Ids;
  std::vector<std::int64_t> Offsets; ///< of each cell's first id, and the number of ids
  std::vector<unsigned char> Types;  ///< VTK's; empty for poly data
};

/// An array at the points or cells.
struct HdfArray
{
  std::string Name;
  bool OnCells = false;
  Scalar Type = Scalar::Float64;
  std::int64_t Components = 1;
};

/// A file of the format VTKHDF with an unstructured grid or poly data, in parts and time steps
/// (https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html, "VTKHDF File Format"). It
/// is read by the NetCDF library, which reads HDF5. All functions throw IOError.
class VTKTIPPIO_EXPORT VtkHdfFile
{
public:
  explicit VtkHdfFile(const std::string& path);

  const std::string& path() const { return this->File.path(); }
  bool isPolyData() const { return this->IsPolyData; }
  /// The number of time steps; a file without any has one.
  std::size_t steps() const { return this->Steps.size(); }
  /// The times of the steps; empty if the file has none.
  const std::vector<double>& times() const { return this->Times; }
  const std::vector<HdfArray>& arrays() const { return this->Arrays; }

  std::int64_t points(std::size_t step) const;
  std::int64_t cells(std::size_t step) const;
  /// Whether two steps have the same points and cells by their place in the file.
  bool shareMesh(std::size_t step, std::size_t other) const;
  /// Whether two steps have equal points and cells, which are read if they do not share them.
  bool haveEqualMesh(std::size_t step, std::size_t other);
  /// Whether an array has values of its own at some step.
  bool varies(const HdfArray& array);

  HdfValues readPoints(std::size_t step);
  /// `group`: of a poly data's cells, such as "Polygons"; empty for an unstructured grid.
  HdfCells readCells(std::size_t step, const std::string& group = "");
  HdfValues read(const HdfArray& array, std::size_t step);

  /// The groups of a poly data's cells, in the order of its cell data.
  static const std::vector<std::string>& cellGroups();

private:
  /// Where a group of cells begins at a step.
  struct CellStart
  {
    std::int64_t Cells = 0;
    std::int64_t Ids = 0;
  };

  /// Where a step begins in the arrays of the file.
  struct Step
  {
    std::int64_t FirstPart = 0;
    std::int64_t Parts = 0;
    std::int64_t Points = 0;
    std::vector<CellStart> Starts; ///< of each group of cells
  };

  /// A group of cells: the counts of its parts.
  struct Group
  {
    std::string Prefix; ///< of the names of its arrays
    std::vector<std::int64_t> Cells;
    std::vector<std::int64_t> Ids;
  };

  void readKind(const NetcdfContent& content);
  void readCounts();
  void readSteps();
  void findArrays();
  std::vector<std::int64_t> readCountsOf(const std::string& name);
  std::vector<std::int64_t> readOffsets(const std::string& name, std::size_t steps);
  std::int64_t cellsBefore(std::size_t step, std::size_t group) const;
  std::vector<std::int64_t> offsetsOf(const HdfArray& array);
  bool hasEveryStep(const HdfArray& array, const std::vector<std::int64_t>& offsets) const;
  const NetcdfVariable& require(const std::string& name) const;
  [[noreturn]] void fail(const std::string& problem) const;
  /// Reads tuples [begin, begin + count) of an array of one or two dimensions.
  HdfValues readTuples(const NetcdfVariable& variable, std::int64_t begin, std::int64_t count);
  std::vector<std::int64_t> readIds(
    const std::string& name, std::int64_t begin, std::int64_t count);

  NetcdfFile File;
  bool IsPolyData = false;
  std::vector<std::int64_t> PointCounts; ///< of each part
  std::vector<Group> Groups;
  std::vector<Step> Steps;
  std::vector<double> Times;
  std::vector<HdfArray> Arrays;
};

} // namespace tipp

#endif

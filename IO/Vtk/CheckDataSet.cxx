// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/DataSets.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Vtk/CellArrays.h"
#include "Vtk/Compatibility.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkExplicitStructuredGrid.h"
#include "vtkIdTypeArray.h"
#include "vtkInformation.h"
#include "vtkInformationUnsignedLongKey.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkRectilinearGrid.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tipp
{
namespace
{

/// A hash of a data set's modification times, addresses and sizes. Its own modification time does
/// not change when its cells are replaced.
class Stamp
{
public:
  explicit Stamp(vtkDataSet* data)
  {
    this->add(data->GetMTime());
    auto* const set = vtkPointSet::SafeDownCast(data);
    this->add(set && set->GetPoints() ? set->GetPoints()->GetData() : nullptr);
    if (auto* const surface = vtkPolyData::SafeDownCast(data))
    {
      this->add(surface->GetVerts());
      this->add(surface->GetLines());
      this->add(surface->GetPolys());
      this->add(surface->GetStrips());
    }
    if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(data))
    {
      this->add(grid->GetCells());
#if TIPP_VTK_FACES_ARE_CELLS
      this->add(grid->GetPolyhedronFaces());
      this->add(grid->GetPolyhedronFaceLocations());
#else
      this->add(grid->GetFaces());
      this->add(grid->GetFaceLocations());
#endif
      this->add(storedCellTypes(grid));
    }
  }

  /// Whether the stamp stored under the key in the data set's information equals this one.
  bool isKept(vtkDataSet* data, vtkInformationUnsignedLongKey* key) const
  {
    vtkInformation* const info = data->GetInformation();
    return info->Has(key) && info->Get(key) == this->Value;
  }
  void keep(vtkDataSet* data, vtkInformationUnsignedLongKey* key) const
  {
    data->GetInformation()->Set(key, this->Value);
  }

private:
  void add(std::uint64_t number)
  {
    // The finaliser of MurmurHash3.
    this->Value = (this->Value ^ number) * 0xff51afd7ed558ccdu;
    this->Value ^= this->Value >> 33;
  }
  void add(vtkDataArray* array)
  {
    this->add(array ? array->GetMTime() : 0);
    this->add(array ? std::uint64_t(array->GetNumberOfValues()) : 0);
    this->add(array && array->HasStandardMemoryLayout()
        ? std::uint64_t(reinterpret_cast<std::uintptr_t>(array->GetVoidPointer(0)))
        : 0);
  }
  void add(vtkCellArray* cells)
  {
    this->add(cells ? cells->GetMTime() : 0);
    this->add(cells ? cells->GetOffsetsArray() : nullptr);
    this->add(cells ? cells->GetConnectivityArray() : nullptr);
  }

  std::uint64_t Value = 0;
};

vtkInformationUnsignedLongKey* checkedKey()
{
  static vtkInformationUnsignedLongKey* const key =
    vtkInformationUnsignedLongKey::MakeKey("CHECKED_CELLS", "tipp");
  return key;
}

vtkInformationUnsignedLongKey* finiteKey()
{
  static vtkInformationUnsignedLongKey* const key =
    vtkInformationUnsignedLongKey::MakeKey("FINITE_POINTS", "tipp");
  return key;
}

/// The checks that all kinds of data sets share.
class Checker
{
public:
  Checker(vtkDataSet* data, const std::string& name, int threads)
    : Data(data)
    , Name(name)
    , Threads(threadCount(threads))
  {
  }

  void checkPoints() const
  {
    if (auto* const set = vtkPointSet::SafeDownCast(this->Data))
    {
      this->checkCoordinates(set->GetPoints());
    }
    if (auto* const grid = vtkRectilinearGrid::SafeDownCast(this->Data))
    {
      this->checkRectilinear(grid);
    }
  }

  void checkCells() const
  {
    if (auto* const surface = vtkPolyData::SafeDownCast(this->Data))
    {
      // With fewer vertices VTK cannot tell a cell's type, and its GetCellType() crashes.
      this->checkCellArray(surface->GetVerts(), "vertex cells", 1);
      this->checkCellArray(surface->GetLines(), "lines", 2);
      this->checkCellArray(surface->GetPolys(), "polygons", 3);
      this->checkCellArray(surface->GetStrips(), "triangle strips", 3);
    }
    else if (auto* const grid = vtkUnstructuredGrid::SafeDownCast(this->Data))
    {
      this->checkUnstructured(grid);
    }
    else if (auto* const structured = vtkStructuredGrid::SafeDownCast(this->Data))
    {
      int dimensions[3];
      structured->GetDimensions(dimensions);
      this->checkGrid(dimensions);
    }
    else if (auto* const blocks = vtkExplicitStructuredGrid::SafeDownCast(this->Data))
    {
      this->checkExplicit(blocks);
    }
  }

  void checkArrays(vtkFieldData* arrays, std::int64_t due, const std::string& of) const
  {
    for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
    {
      vtkAbstractArray* const array = arrays->GetAbstractArray(i);
      if (array && array->GetNumberOfTuples() < due)
      {
        this->fail("its array '" + shownText(array->GetName() ? array->GetName() : "") + "' has " +
          std::to_string(array->GetNumberOfTuples()) + " values for " + std::to_string(due) + " " +
          of);
      }
    }
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Name, problem + repairAdvice);
  }

  void checkCoordinates(vtkPoints* points) const
  {
    if (points && points->GetData()->GetNumberOfComponents() != 3)
    {
      this->fail("its points have " + std::to_string(points->GetData()->GetNumberOfComponents()) +
        " coordinates each where three are due");
    }
  }

  void checkRectilinear(vtkRectilinearGrid* grid) const
  {
    int dimensions[3];
    grid->GetDimensions(dimensions);
    vtkDataArray* const axes[3] = { grid->GetXCoordinates(), grid->GetYCoordinates(),
      grid->GetZCoordinates() };
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t count = axes[axis] ? axes[axis]->GetNumberOfTuples() : 0;
      if (this->Data->GetNumberOfPoints() > 0 && count < dimensions[axis])
      {
        this->fail(std::string("its axis ") + "xyz"[axis] + " has " + std::to_string(count) +
          " coordinates for " + std::to_string(dimensions[axis]) + " points");
      }
    }
  }

  void checkGrid(const int* dimensions) const
  {
    const std::int64_t points = this->Data->GetNumberOfPoints();
    std::int64_t due = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      // Once the product exceeds the number of points, the data set is invalid.
      due = due > points ? due : due * std::max(dimensions[axis], 0);
    }
    if (due > points)
    {
      this->fail("it has " + std::to_string(points) + " points, too few for a grid of " +
        std::to_string(dimensions[0]) + " x " + std::to_string(dimensions[1]) + " x " +
        std::to_string(dimensions[2]));
    }
  }

  void checkExplicit(vtkExplicitStructuredGrid* blocks) const
  {
    const std::int64_t cells = blocks->GetCells() ? blocks->GetCells()->GetNumberOfCells() : 0;
    int dimensions[3];
    blocks->GetCellDims(dimensions);
    const std::int64_t due = blocks->GetNumberOfCells();
    if (cells < due)
    {
      this->fail(
        "it has " + std::to_string(cells) + " cells where " + std::to_string(due) + " are due");
    }
    this->checkCellArray(blocks->GetCells(), "cells", 8);
  }

  void checkUnstructured(vtkUnstructuredGrid* grid) const
  {
    vtkCellArray* const cells = grid->GetCells();
    const std::int64_t count = cells ? cells->GetNumberOfCells() : 0;
    if (count < 1)
    {
      return;
    }
    const auto types = cellTypes(grid);
    const std::int64_t typed = types ? types->GetNumberOfValues() : 0;
    if (typed != count)
    {
      this->fail(
        "it has " + std::to_string(typed) + " cell types for " + std::to_string(count) + " cells");
    }
    this->checkCellArray(cells, "cells", 0, types->GetPointer(0));
    const unsigned char* const begin = types->GetPointer(0);
    if (std::memchr(begin, VTK_POLYHEDRON, std::size_t(count)))
    {
      this->checkPolyhedra(grid, begin, count);
    }
  }

#if TIPP_VTK_FACES_ARE_CELLS
  /// The faces of all polyhedra are one cell array; another lists the faces of each cell.
  void checkPolyhedra(
    vtkUnstructuredGrid* grid, const unsigned char* types, std::int64_t count) const
  {
    vtkCellArray* const faces = grid->GetPolyhedronFaces();
    vtkCellArray* const lists = grid->GetPolyhedronFaceLocations();
    const std::int64_t listed = lists ? lists->GetNumberOfCells() : 0;
    this->checkCellArray(faces, "faces of polyhedra", 1);
    this->checkCellArray(
      lists, "lists of faces", 0, nullptr, "face", faces ? faces->GetNumberOfCells() : 0);
    for (std::int64_t cell = 0; cell < count; ++cell)
    {
      if (types[cell] == VTK_POLYHEDRON && (cell >= listed || lists->GetCellSize(cell) < 1))
      {
        this->fail("its polyhedron " + std::to_string(cell) + " has faces that are not all there");
      }
    }
  }
#else
  void checkPolyhedra(
    vtkUnstructuredGrid* grid, const unsigned char* types, std::int64_t count) const
  {
    for (std::int64_t cell = 0; cell < count; ++cell)
    {
      if (types[cell] == VTK_POLYHEDRON)
      {
        this->checkFaces(grid, cell);
      }
    }
  }

  /// Checks one polyhedron's face stream: the number of faces, and for each the number of vertices
  /// and their ids.
  void checkFaces(vtkUnstructuredGrid* grid, std::int64_t cell) const
  {
    vtkIdTypeArray* const locations = grid->GetFaceLocations();
    vtkIdTypeArray* const faces = grid->GetFaces();
    const std::int64_t size = faces ? faces->GetNumberOfValues() : 0;
    const std::int64_t location =
      locations && cell < locations->GetNumberOfValues() ? locations->GetValue(cell) : -1;
    const vtkIdType* const values = faces ? faces->GetPointer(0) : nullptr;
    const std::int64_t points = this->Data->GetNumberOfPoints();
    std::int64_t at = location;
    const auto take = [&]() -> std::int64_t
    {
      if (at < 0 || at >= size)
      {
        this->fail("its polyhedron " + std::to_string(cell) + " has faces that are not all there");
      }
      return values[at++];
    };
    // VTK follows a negative number out of the array.
    const auto takeNumber = [&](const char* of) -> std::int64_t
    {
      const std::int64_t number = take();
      if (number < 1)
      {
        this->fail(
          "its polyhedron " + std::to_string(cell) + " has " + std::to_string(number) + of);
      }
      return number;
    };
    const std::int64_t count = takeNumber(" faces");
    for (std::int64_t face = 0; face < count; ++face)
    {
      for (std::int64_t corners = takeNumber(" corners of a face"); corners > 0; --corners)
      {
        const std::int64_t id = take();
        if (id < 0 || id >= points)
        {
          this->fail("its polyhedron " + std::to_string(cell) + " refers to point " +
            std::to_string(id) + ", but there are " + std::to_string(points) + " points");
        }
      }
    }
  }

#endif

  void checkCellArray(vtkCellArray* cells, const std::string& what, std::int64_t least,
    const unsigned char* types = nullptr) const
  {
    this->checkCellArray(cells, what, least, types, "point", this->Data->GetNumberOfPoints());
  }

  /// Checks a cell array, whose ids must be in [0, count). A null array has no cells.
  void checkCellArray(vtkCellArray* cells, const std::string& what, std::int64_t least,
    const unsigned char* types, const std::string& item, std::int64_t count) const
  {
    if (!cells)
    {
      return;
    }
    const auto check = [&](const auto& array)
    {
      array.offsets(least, types);
      array.ids(count, item);
    };
    const PlainCells plain(cells);
    if (plain.Ids.isWide())
    {
      check(CellArrayCheck<std::int64_t>(plain, this->Name, what, this->Threads));
    }
    else
    {
      check(CellArrayCheck<std::int32_t>(plain, this->Name, what, this->Threads));
    }
  }

  vtkDataSet* Data;
  const std::string& Name;
  int Threads;
};

/// Whether all values are finite: adding to the highest exponents overflows into the sign bit.
template <typename Bits, typename Real>
bool areFinite(const Real* values, std::int64_t count, int threads)
{
  static_assert(sizeof(Bits) == sizeof(Real));
  constexpr int mantissa = std::numeric_limits<Real>::digits - 1;
  constexpr Bits sign = Bits(1) << (8 * sizeof(Bits) - 1);
  constexpr Bits exponent = (sign - 1) >> mantissa << mantissa;
  std::atomic<bool> finite{ true };
  forChunks(count, checkedAtOnce, threadCount(threads), {},
    [&](std::int64_t begin, std::int64_t end, int)
    {
      Bits all = 0;
      for (std::int64_t i = begin; i < end; ++i)
      {
        Bits bits;
        std::memcpy(&bits, values + i, sizeof bits);
        all |= (bits & exponent) + (Bits(1) << mantissa);
      }
      if ((all & sign) != 0)
      {
        finite = false;
      }
    });
  return finite;
}

bool computeFinite(vtkDataSet* data, int threads)
{
  auto* const set = vtkPointSet::SafeDownCast(data);
  vtkDataArray* const array = set && set->GetPoints() ? set->GetPoints()->GetData() : nullptr;
  if (auto* const doubles = vtkAOSDataArrayTemplate<double>::FastDownCast(array))
  {
    return areFinite<std::uint64_t>(doubles->GetPointer(0), doubles->GetNumberOfValues(), threads);
  }
  if (auto* const floats = vtkAOSDataArrayTemplate<float>::FastDownCast(array))
  {
    return areFinite<std::uint32_t>(floats->GetPointer(0), floats->GetNumberOfValues(), threads);
  }
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    double p[3];
    data->GetPoint(i, p);
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
    {
      return false;
    }
  }
  return true;
}

} // namespace

void checkPoints(vtkDataSet* data, const std::string& name)
{
  const Checker checker(data, name, 0);
  checker.checkPoints();
  checker.checkArrays(data->GetPointData(), data->GetNumberOfPoints(), "points");
}

void checkCells(vtkDataSet* data, const std::string& name, int threads)
{
  const Stamp stamp(data);
  if (!stamp.isKept(data, checkedKey()))
  {
    const Checker checker(data, name, threads);
    checker.checkPoints();
    checker.checkCells();
    stamp.keep(data, checkedKey());
  }
}

void checkDataSet(vtkDataSet* data, const std::string& name, int threads)
{
  checkCells(data, name, threads);
  checkPoints(data, name);
  Checker(data, name, threads).checkArrays(data->GetCellData(), data->GetNumberOfCells(), "cells");
}

bool allPointsFinite(vtkDataSet* data, int threads)
{
  const Stamp stamp(data);
  if (stamp.isKept(data, finiteKey()))
  {
    return true;
  }
  const bool finite = computeFinite(data, threads);
  if (finite)
  {
    stamp.keep(data, finiteKey());
  }
  return finite;
}

} // namespace tipp

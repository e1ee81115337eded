// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/CheckDataSet.h"

#include "Files/IOError.h"
#include "Parallel/ParallelFor.h"
#include "Vtk/ArrayNames.h"
#include "Vtk/CellSizes.h"

#include "vtkAOSDataArrayTemplate.h"
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

constexpr std::int64_t chunkSize = 1 << 16;
constexpr const char* repair = "; repair it or write it again.";

std::string toText(std::int64_t number)
{
  return std::to_string(number);
}

/// What a data set is made of, as one number: times of modification, places in memory and sizes.
/// Its own time of modification alone does not tell that its cells have been replaced.
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
      this->add(grid->GetCellTypesArray());
      this->add(grid->GetFaces());
      this->add(grid->GetFaceLocations());
    }
  }

  /// Whether an earlier one with the key's name, kept in the data set's information, is the same.
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

/// The cells of one vtkCellArray, with ids of type Id.
template <typename Id>
class CellArrayCheck
{
public:
  CellArrayCheck(vtkAOSDataArrayTemplate<Id>* offsets, vtkAOSDataArrayTemplate<Id>* ids,
    const std::string& name, const std::string& what, int threads)
    : Offsets(offsets->GetPointer(0))
    , Cells(std::max<std::int64_t>(offsets->GetNumberOfValues() - 1, 0))
    , Ids(ids->GetPointer(0))
    , Count(ids->GetNumberOfValues())
    , Name(name)
    , What(what)
    , Threads(threads)
  {
  }

  void offsets() const
  {
    if (this->Cells == 0)
    {
      return;
    }
    forChunks(this->Cells, chunkSize, this->Threads, {},
      [this](std::int64_t begin, std::int64_t end, int)
      {
        // Negative if an offset or a difference is; without branches, so that it is vectorised.
        Unsigned all = 0;
        for (std::int64_t i = begin; i < end; ++i)
        {
          const auto next = Unsigned(this->Offsets[i + 1]);
          all |= next | (next - Unsigned(this->Offsets[i]));
        }
        if (Id(all) < 0)
        {
          this->failAtOffset(begin, end);
        }
      });
    if (this->Offsets[0] != 0 || std::int64_t(this->Offsets[this->Cells]) > this->Count)
    {
      this->fail("begin at vertex id " + toText(this->Offsets[0]) + " and end at " +
        toText(this->Offsets[this->Cells]) + " of " + toText(this->Count));
    }
  }

  /// After offsets().
  void ids(std::int64_t points) const
  {
    const std::int64_t used = this->Cells > 0 ? std::int64_t(this->Offsets[this->Cells]) : 0;
    const auto last = Unsigned(std::min<std::int64_t>(points - 1, std::numeric_limits<Id>::max()));
    forChunks(used, chunkSize, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        Unsigned all = 0; // negative if an id is, or is above the last one
        for (std::int64_t i = begin; i < end; ++i)
        {
          const auto id = Unsigned(this->Ids[i]);
          all |= id | (last - id);
        }
        if (points == 0 || Id(all) < 0)
        {
          this->failAtId(begin, points);
        }
      });
  }

  /// After offsets(); the size of each cell is one that its type allows.
  void sizes(const unsigned char* types) const
  {
    forChunks(this->Cells, chunkSize, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        const Id size = Id(cellSizeOf(types[begin]));
        const bool uniform = size > 0 &&
          std::memcmp(types + begin, types + begin + 1, std::size_t(end - begin - 1)) == 0;
        Unsigned different = uniform ? 0 : 1;
        for (std::int64_t i = begin; i < end && uniform; ++i)
        {
          different |= Unsigned(this->Offsets[i + 1]) - Unsigned(this->Offsets[i]) - Unsigned(size);
        }
        for (std::int64_t i = begin; i < end && different != 0; ++i)
        {
          this->requireSize(i, types[i]);
        }
      });
  }

  void sizesFrom(std::int64_t least) const
  {
    forChunks(this->Cells, chunkSize, this->Threads, {},
      [&](std::int64_t begin, std::int64_t end, int)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          if (this->size(i) < least)
          {
            this->fail("have one of " + toText(this->size(i)) + " vertices, number " + toText(i) +
              ", where " + toText(least) + " are the least");
          }
        }
      });
  }

private:
  using Unsigned = std::make_unsigned_t<Id>;

  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Name, "its " + this->What + " " + problem + repair);
  }

  std::int64_t size(std::int64_t cell) const
  {
    return std::int64_t(this->Offsets[cell + 1]) - std::int64_t(this->Offsets[cell]);
  }

  void failAtOffset(std::int64_t begin, std::int64_t end) const
  {
    for (std::int64_t i = begin; i < end; ++i)
    {
      if (this->Offsets[i] < 0 || this->Offsets[i + 1] < this->Offsets[i])
      {
        this->fail("have offsets that do not ascend: " + toText(this->Offsets[i + 1]) + " after " +
          toText(this->Offsets[i]) + " at number " + toText(i));
      }
    }
  }

  void failAtId(std::int64_t begin, std::int64_t points) const
  {
    const auto isGood = [&](Id id) { return id >= 0 && std::int64_t(id) < points; };
    const Id* const bad = std::find_if_not(this->Ids + begin, this->Ids + this->Count, isGood);
    const Id* const offset =
      std::upper_bound(this->Offsets, this->Offsets + this->Cells, Id(bad - this->Ids));
    this->fail("refer to point " + toText(*bad) + " at number " +
      toText(offset - this->Offsets - 1) + ", but there are " + toText(points) + " points");
  }

  void requireSize(std::int64_t cell, int type) const
  {
    if (!isCellSize(type, this->size(cell)))
    {
      throw IOError(this->Name,
        "its cell " + toText(cell) + " is of type " + toText(type) +
          (isCellType(type) ? ", which cannot have " + toText(this->size(cell)) + " vertices"
                            : ", which VTK does not know") +
          repair);
    }
  }

  const Id* Offsets;
  std::int64_t Cells;
  const Id* Ids;
  std::int64_t Count;
  const std::string& Name;
  const std::string& What;
  int Threads;
};

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
      this->checkCellArray(surface->GetVerts(), "vertex cells", 0);
      this->checkCellArray(surface->GetLines(), "lines", 0);
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
          toText(array->GetNumberOfTuples()) + " values for " + toText(due) + " " + of);
      }
    }
  }

private:
  [[noreturn]] void fail(const std::string& problem) const
  {
    throw IOError(this->Name, problem + repair);
  }

  void checkCoordinates(vtkPoints* points) const
  {
    if (points && points->GetData()->GetNumberOfComponents() != 3)
    {
      this->fail("its points have " + toText(points->GetData()->GetNumberOfComponents()) +
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
        this->fail(std::string("its axis ") + "xyz"[axis] + " has " + toText(count) +
          " coordinates for " + toText(dimensions[axis]) + " points");
      }
    }
  }

  void checkGrid(const int* dimensions) const
  {
    const std::int64_t points = this->Data->GetNumberOfPoints();
    std::int64_t due = 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      // A product beyond the points is too large, whatever comes after.
      due = due > points ? due : due * std::max(dimensions[axis], 0);
    }
    if (due > points)
    {
      this->fail("it has " + toText(points) + " points, too few for a grid of " +
        toText(dimensions[0]) + " x " + toText(dimensions[1]) + " x " + toText(dimensions[2]));
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
      this->fail("it has " + toText(cells) + " cells where " + toText(due) + " are due");
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
    vtkUnsignedCharArray* const types = grid->GetCellTypesArray();
    const std::int64_t typed = types ? types->GetNumberOfValues() : 0;
    if (typed != count)
    {
      this->fail("it has " + toText(typed) + " cell types for " + toText(count) + " cells");
    }
    this->checkCellArray(cells, "cells", 0, types->GetPointer(0));
    const unsigned char* const begin = types->GetPointer(0);
    if (std::memchr(begin, VTK_POLYHEDRON, std::size_t(count)))
    {
      for (std::int64_t cell = 0; cell < count; ++cell)
      {
        begin[cell] == VTK_POLYHEDRON ? this->checkFaces(grid, cell) : void();
      }
    }
  }

  /// Of one polyhedron: a count of faces, and of each a count of vertices and the ids.
  void checkFaces(vtkUnstructuredGrid* grid, std::int64_t cell) const
  {
    vtkIdTypeArray* const places = grid->GetFaceLocations();
    vtkIdTypeArray* const faces = grid->GetFaces();
    const std::int64_t size = faces ? faces->GetNumberOfValues() : 0;
    const std::int64_t place =
      places && cell < places->GetNumberOfValues() ? places->GetValue(cell) : -1;
    const vtkIdType* const values = faces ? faces->GetPointer(0) : nullptr;
    const std::int64_t points = this->Data->GetNumberOfPoints();
    std::int64_t at = place;
    const auto take = [&]() -> std::int64_t
    {
      if (at < 0 || at >= size)
      {
        this->fail("its polyhedron " + toText(cell) + " has faces that are not all there");
      }
      return values[at++];
    };
    const std::int64_t count = take();
    for (std::int64_t face = 0; face < count; ++face)
    {
      for (std::int64_t corners = take(); corners > 0; --corners)
      {
        const std::int64_t id = take();
        if (id < 0 || id >= points)
        {
          this->fail("its polyhedron " + toText(cell) + " refers to point " + toText(id) +
            ", but there are " + toText(points) + " points");
        }
      }
    }
  }

  /// No array is none of the cells.
  void checkCellArray(vtkCellArray* cells, const std::string& what, std::int64_t least,
    const unsigned char* types = nullptr) const
  {
    if (!cells)
    {
      return;
    }
    const auto check = [&](const auto& array)
    {
      array.offsets();
      array.ids(this->Data->GetNumberOfPoints());
      types ? array.sizes(types) : void();
      least > 0 ? array.sizesFrom(least) : void();
    };
    if (cells->IsStorage64Bit())
    {
      check(CellArrayCheck<vtkTypeInt64>(cells->GetOffsetsArray64(),
        cells->GetConnectivityArray64(), this->Name, what, this->Threads));
    }
    else
    {
      check(CellArrayCheck<vtkTypeInt32>(cells->GetOffsetsArray32(),
        cells->GetConnectivityArray32(), this->Name, what, this->Threads));
    }
  }

  vtkDataSet* Data;
  const std::string& Name;
  int Threads;
};

/// Whether all of them are finite: a sum of the exponents' highest values overflows into the sign.
template <typename Bits, typename Real>
bool areFinite(const Real* values, std::int64_t count, int threads)
{
  static_assert(sizeof(Bits) == sizeof(Real));
  constexpr int mantissa = std::numeric_limits<Real>::digits - 1;
  constexpr Bits sign = Bits(1) << (8 * sizeof(Bits) - 1);
  constexpr Bits exponent = (sign - 1) >> mantissa << mantissa;
  std::atomic<bool> finite{ true };
  forChunks(count, chunkSize, threadCount(threads), {},
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
  finite ? stamp.keep(data, finiteKey()) : void();
  return finite;
}

} // namespace tipp

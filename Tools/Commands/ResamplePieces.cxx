// SPDX-License-Identifier: BSD-3-Clause
// What 'tipp resample' does without VTK: it samples flat and partitioned meshes piece by piece.
#include "Commands/PointArguments.h"
#include "Commands/Report.h"
#include "Commands/ResampleArguments.h"
#include "Commands/ResampleImage.h"
#include "Console/Process.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Flat/FlatMesh.h"
#include "NoVtk.h"
#include "Parallel/ParallelFor.h"
#include "Parallel/Poll.h"
#include "Partitioned/PartitionedMesh.h"
#include "Predicates/SensibleRange.h"
#include "Ranks/Communicator.h"
#include "Reading/PieceSource.h"
#include "Sampling/SampledPieces.h"
#include "Sampling/SamplingLattice.h"
#include "Series/StepSelection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Approximate bytes of memory per cell, including its share of the points and of the samples.
constexpr std::uint64_t bytesOfCell = 128;

std::unique_ptr<PieceSource> openSource(const ResampleArguments& arguments)
{
  const std::string& path = arguments.Input;
  if (!isFlatMesh(path) && !isPartitionedMesh(path))
  {
    if (!std::filesystem::is_regular_file(path))
    {
      throw IOError(path, "is not a file that can be read; check the name.");
    }
    if (isOpenedBy(path, Opener::Vtk))
    {
      refuseVtkMesh(path);
    }
  }
  SourceOptions options;
  options.Tiling = TilingChoice::require("grid:1x1"); // a flat mesh is read as one piece
  options.Threads = arguments.Threads;
  return openPieceSource(path, options);
}

ArrayNames namesOf(const PartitionedMesh& mesh)
{
  ArrayNames names;
  for (const StoredArray& array : mesh.Arrays)
  {
    (array.OfPoints ? names.OfPoints : names.OfCells).insert(array.Name);
  }
  return names;
}

/// The bounding box of the finite points of all pieces.
Box3 extentOf(const PartitionedMesh& mesh)
{
  Box3 extent = Box3::empty();
  for (const PieceSummary& piece : mesh.Pieces)
  {
    extent.extend(piece.Extent);
  }
  return extent;
}

/// The bounding box of a piece's points that are finite along the axes.
Box3 extentOf(const Piece& piece, const std::vector<int>& axes)
{
  Box3 box = Box3::empty();
  withScalar(piece.PointType,
    [&](auto zero)
    {
      const auto* const points = piece.Coordinates.as<decltype(zero)>();
      for (std::int64_t i = 0; i < piece.Points; ++i)
      {
        const Point3 p{ double(points[3 * i]), double(points[3 * i + 1]),
          double(points[3 * i + 2]) };
        if (std::all_of(
              axes.begin(), axes.end(), [&p](int axis) { return std::isfinite(p[axis]); }))
        {
          box.extend(p);
        }
      }
    });
  return box;
}

/// Adds z as a point array, unless there is an array of that name.
void addElevation(Piece& piece)
{
  const auto isElevation = [](const Piece::Attribute& attribute)
  { return attribute.Description.OfPoints && attribute.Description.Name == elevationName; };
  if (std::any_of(piece.Attributes.begin(), piece.Attributes.end(), isElevation))
  {
    return;
  }
  withScalar(piece.PointType,
    [&piece](auto zero)
    {
      using T = decltype(zero);
      Buffer<char> heights(std::size_t(piece.Points) * sizeof(T));
      for (std::int64_t i = 0; i < piece.Points; ++i)
      {
        heights.as<T>()[i] = piece.Coordinates.as<T>()[3 * i + 2];
      }
      piece.Attributes.push_back(
        { { elevationName, true, piece.PointType, 1, -1 }, std::move(heights) });
    });
}

/// A mesh that is read piece by piece and sampled.
class PieceRun
{
public:
  explicit PieceRun(const ResampleArguments& arguments)
    : Arguments(arguments)
    , Source(openSource(arguments))
    , IsStored(isPartitionedMesh(arguments.Input))
    , IsSurface(this->mesh().CellSize == 3)
  {
    // Whether a flat mesh has an elevation is known when it is read.
    const bool isOpen = this->IsSurface && !this->IsStored;
    const Box3 extent = extentOf(this->mesh());
    requireArrays(arguments, this->names(extent.Min.z < extent.Max.z), isOpen ? elevationName : "");
    this->Reading.Step =
      int(parseSteps(arguments.Step, this->mesh().Times.size(), arguments.Input).front());
    requireZ(arguments, !this->IsSurface);
    const std::vector<std::string>& names = arguments.Arrays;
    for (const StoredArray& array : this->mesh().Arrays)
    {
      this->Reading.Wanted.push_back(
        names.empty() || std::find(names.begin(), names.end(), array.Name) != names.end());
    }
  }

  /// Samples the mesh. Throws WorkAborted if `report` stopped it.
  SampledPieces& run(const Report& report)
  {
    const PollScope polled([&report] { return report(0); });
    Communicator alone(nullptr);
    this->Source->prepare(alone);
    this->choosePieces();
    const std::vector<std::vector<std::size_t>> groups = this->groups();
    const double share = 1.0 / double(std::max<std::size_t>(groups.size(), 1));
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
      Piece piece = this->read(groups[i]);
      this->add(piece, groups.size(), partOf(report, double(i) * share, double(i + 1) * share));
    }
    if (!this->Samples)
    {
      this->makeSamples(this->requireBounds(extentOf(this->mesh())), {}, true);
    }
    this->Samples->finish();
    if (this->Elevations && groups.size() > 1 && !(this->Heights.Min.z < this->Heights.Max.z))
    {
      this->Samples->remove(elevationName);
    }
    return *this->Samples;
  }

private:
  const PartitionedMesh& mesh() const { return this->Source->mesh(); }

  /// The names of all arrays, with that of the elevation if a surface's points differ in z.
  ArrayNames names(bool differInZ) const
  {
    ArrayNames names = namesOf(this->mesh());
    if (this->IsSurface && differInZ)
    {
      names.OfPoints.insert(elevationName);
    }
    return names;
  }

  /// A .vtu file is read whole, as VTK does it.
  bool isCutToRange() const
  {
    return !this->Arguments.Bounds.empty() &&
      (this->IsStored || !isOpenedBy(this->Arguments.Input, Opener::Vtk));
  }

  void choosePieces()
  {
    this->Numbers.resize(this->mesh().Pieces.size());
    std::iota(this->Numbers.begin(), this->Numbers.end(), std::size_t(0));
    if (this->isCutToRange())
    {
      const Box3 box = boxOfVtkBounds<3>(this->Arguments.Bounds.data());
      requireSensible(this->mesh(), box);
      this->Range.emplace(this->mesh(), box);
      this->Numbers = this->Range->pieces();
    }
    this->Reading.Borrowed = this->Range.has_value();
  }

  /// Returns the pieces that are read together, within the memory limit.
  std::vector<std::vector<std::size_t>> groups() const
  {
    const std::uint64_t limit = *parseMemorySize(this->Arguments.Memory);
    std::vector<std::vector<std::size_t>> groups;
    std::uint64_t bytes = 0;
    for (const std::size_t number : this->Numbers)
    {
      const std::uint64_t more = bytesOfCell * std::uint64_t(this->mesh().Pieces[number].Cells);
      if (groups.empty() || bytes + more > limit)
      {
        groups.emplace_back();
        bytes = 0;
      }
      groups.back().push_back(number);
      bytes += more;
    }
    return groups;
  }

  Piece read(const std::vector<std::size_t>& numbers)
  {
    std::vector<Piece> pieces = this->Source->read(numbers, this->Reading);
    for (std::size_t i = 0; this->Range && i < pieces.size(); ++i)
    {
      pieces[i] = this->Range->apply(pieces[i], numbers[i], false);
    }
    return pieces.size() == 1 ? std::move(pieces[0]) : mergePieces(pieces);
  }

  const Box3& requireBounds(const Box3& extent)
  {
    this->Bounds =
      this->Arguments.Bounds.empty() ? extent : boxOfVtkBounds<3>(this->Arguments.Bounds.data());
    if (this->Bounds.isEmpty())
    {
      throw std::runtime_error("the input has no points with finite coordinates, so its bounds "
                               "give no range: turn UseInputBounds off.");
    }
    return this->Bounds;
  }

  void add(Piece& piece, std::size_t groups, const Report& report)
  {
    const Box3 own = extentOf(piece, { 2 });
    if (this->IsSurface && own.Min.z <= own.Max.z)
    {
      this->Heights.extend(own);
    }
    if (!this->Samples)
    {
      const bool differInZ = this->Heights.Min.z < this->Heights.Max.z;
      if (!this->IsStored)
      {
        requireArrays(this->Arguments, this->names(differInZ), "");
      }
      const Box3 whole = this->IsStored ? extentOf(this->mesh()) : extentOf(piece, { 0, 1, 2 });
      const Lattice lattice = this->latticeOf(this->requireBounds(whole));
      const std::vector<int> axes =
        surfaceAxes({ int(lattice.size(0)), int(lattice.size(1)), int(lattice.size(2)) });
      if (!this->IsStored && !this->Arguments.Bounds.empty())
      {
        const std::vector<int> used = this->IsSurface ? axes : std::vector<int>{ 0, 1, 2 };
        requireSensible(this->Bounds, extentOf(piece, used), used);
      }
      const std::vector<std::string>& names = this->Arguments.Arrays;
      const bool isWanted =
        names.empty() || std::find(names.begin(), names.end(), elevationName) != names.end();
      this->Elevations = this->IsSurface && isWanted && axes == std::vector<int>{ 0, 1 } &&
        (groups > 1 || differInZ);
      this->makeSamples(this->Bounds, axes, groups == 1);
    }
    if (this->Elevations)
    {
      addElevation(piece);
    }
    if (!this->Samples->add(piece, report))
    {
      throw WorkAborted();
    }
  }

  Lattice latticeOf(const Box3& bounds) const
  {
    std::array<int, 3> dimensions = { 1, 1, 1 };
    std::array<double, 3> delta = {};
    const auto& given = this->Arguments.Dimensions;
    if (!given.empty())
    {
      dimensions = chosenDimensions(bounds, { given[0], given[1], given[2] }, this->IsSurface);
    }
    if (!this->Arguments.Delta.empty())
    {
      std::copy_n(this->Arguments.Delta.begin(), 3, delta.begin());
    }
    return rangeLattice(bounds, dimensions, delta);
  }

  void makeSamples(const Box3& bounds, std::vector<int> axes, bool isWhole)
  {
    const Lattice lattice = this->latticeOf(bounds);
    PieceSampling settings;
    settings.Names = this->Arguments.Arrays;
    settings.Axes = axes.empty() ? settings.Axes : std::move(axes);
    settings.NullValue = nullValueOf(this->Arguments);
    settings.NoData = this->Arguments.NoData;
    settings.Device = parseDeviceChoice(this->Arguments.Device);
    settings.Threads = threadCount(this->Arguments.Threads);
    settings.IsWhole = isWhole;
    settings.Conservative = this->Arguments.Method == "conservative";
    settings.CoveredShare = this->Arguments.CoveredShare;
    std::vector<StoredArray> arrays;
    for (std::size_t i = 0; i < this->mesh().Arrays.size(); ++i)
    {
      const StoredArray& array = this->mesh().Arrays[i];
      if (this->Reading.Wanted[i] && array.Step <= 0)
      {
        arrays.push_back(array);
      }
    }
    requireMemoryFor(arrays, lattice, settings);
    this->Samples = std::make_unique<SampledPieces>(lattice, settings);
  }

  const ResampleArguments& Arguments;
  std::unique_ptr<PieceSource> Source;
  const bool IsStored;
  const bool IsSurface;
  PieceOptions Reading;
  std::vector<std::size_t> Numbers; ///< the pieces that meet the range
  std::optional<RangeFilter> Range;
  Box3 Bounds;
  Box3 Heights = Box3::empty(); ///< of all pieces; only z is used
  bool Elevations = false;      ///< whether heights are sampled
  std::unique_ptr<SampledPieces> Samples;
};

/// Samples the mesh and writes the image.
void resampleMesh(const ResampleArguments& arguments)
{
  const PathState before = requireWritable(arguments.Output, "", { arguments.Input });
  parseDeviceChoice(arguments.Device);
  PieceRun run(arguments);
  auto bar = std::make_unique<ProgressBar>("resampling");
  const Report report = progressOn(bar);
  SampledPieces* samples = nullptr;
  try
  {
    samples = &run.run(report);
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::runtime_error& error)
  {
    throw IOError(arguments.Input, reasonOf(error.what()));
  }
  bar.reset();
  const ImageArrays image = samples->image();
  for (const std::string& warning : samples->warnings())
  {
    fmt::print(stderr, "tipp: warning: {}: {}\n", arguments.Input, warning);
  }
  writeImage(arguments, image, before);
  const bool isLinear = arguments.Method != "conservative";
  summarize(arguments,
    { samples->hits(), image.Grid.samples(), samples->cells(), samples->seconds(),
      isLinear ? "OpenMP" : "" });
}

} // namespace

int runResample(const ResampleArguments& arguments)
{
  const MpiSession session;
  try
  {
    resampleMesh(arguments);
  }
  catch (const WorkAborted&)
  {
    return reportInterrupt();
  }
  catch (const std::bad_alloc&)
  {
    throw IOError(arguments.Input,
      reasonOf(
        "there is not enough memory for the samples: use a smaller range or fewer samples."));
  }
  return Success;
}

} // namespace tipp

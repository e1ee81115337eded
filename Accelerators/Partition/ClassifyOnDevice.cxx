// SPDX-License-Identifier: BSD-3-Clause
#include "Partition/ClassifyCells.h"

#include "OpenCL/ComputeDevice.h"
#include "Partition/Classify.cl.h"

#include <cmath>
#include <utility>

namespace tipp
{
namespace
{

// The verdicts of Classify.cl.
enum Verdict : std::uint8_t
{
  Apart = 0,
  Meet = 1,
  Undecided = 2
};

// Bytes on the device per candidate (its id, cell and verdict), and per cell with candidates (its
// index, and its first candidate).
constexpr std::uint64_t BytesPerCandidate = 4 + 4 + 1;
constexpr std::uint64_t BytesPerListedCell = 4 + 8;

template <typename Value>
cl::Buffer inputOf(const ComputeDevice& device, const std::vector<Value>& values)
{
  return device.input(values.data(), values.size() * sizeof(Value));
}

// Cells to be tested, and the index of each cell's first candidate.
struct Listed
{
  std::vector<cl_uint> Cells;
  std::vector<cl_ulong> Starts = { 0 };

  void add(std::size_t cell, std::uint64_t candidates)
  {
    this->Cells.push_back(static_cast<cl_uint>(cell));
    this->Starts.push_back(this->Starts.back() + candidates);
  }
  void clear()
  {
    this->Cells.clear();
    this->Starts.resize(1);
  }
  std::uint64_t candidates() const { return this->Starts.back(); }
};

class DeviceClassification
{
public:
  DeviceClassification(
    ComputeDevice& device, const CellShape& shape, const BoxTiling& tiling, std::uint64_t memory)
    : Device(device)
    , Cells(shape.cells())
    , Tiling(tiling)
    , Shape(shape)
    , Cuts(inputOf(device, tiling.cuts()))
    , Nodes(inputOf(device, tiling.children()))
    , Middles(inputOf(device, tiling.middles()))
    , Domain(device.input(&tiling.domain(), sizeof(Box3)))
    , Boxes(device.input(&tiling.box(0), static_cast<std::size_t>(tiling.count()) * sizeof(Box3)))
  {
    const DeviceDescription& description = device.description();
    const std::uint64_t all = memory != 0 ? memory : description.Memory / 2;
    // Half for the cells, half for their candidates; no buffer exceeds either.
    this->Room = std::min(all / 2, description.LargestBuffer);
    this->CellBytes =
      sizeof(double) * static_cast<std::size_t>(this->Cells.Corners * this->Cells.Dimension);
    const std::uint64_t most = this->Room / (this->CellBytes + 8);
    this->PieceSize =
      static_cast<std::size_t>(std::min<std::uint64_t>(std::max<std::uint64_t>(most, 1), 1u << 30));
    this->Result.Owner.resize(this->Cells.Cells);
    this->Result.BorrowerStart.resize(this->Cells.Cells + 1);
  }

  Membership run()
  {
    for (std::size_t first = 0; first < this->Cells.Cells; first += this->PieceSize)
    {
      this->classifyPiece(first, std::min(this->PieceSize, this->Cells.Cells - first));
    }
    return std::move(this->Result);
  }

private:
  void classifyPiece(std::size_t first, std::size_t count)
  {
    this->Coordinates = this->Device.input(this->Shape.cell(first), count * this->CellBytes);
    this->countCandidates(first, count);
    // Cells must be finished in order: the start of a cell's borrowers depends on the cells before
    // it.
    std::size_t finished = 0;
    Listed listed;
    for (std::size_t i = 0; i < count; ++i)
    {
      const int n = this->Counts[i];
      if (n == 0)
      {
        // An earlier cell may be invalid as well, and is then reported.
        this->testListed(first, listed);
        this->finish(first, finished, i, listed);
        failForCell(this->Shape, first + i);
      }
      if (n == 1)
      {
        continue;
      }
      const auto candidates = static_cast<std::uint64_t>(std::abs(n));
      const std::uint64_t bytes = (listed.candidates() + candidates) * BytesPerCandidate +
        (listed.Cells.size() + 1) * BytesPerListedCell;
      if (bytes > this->Room && !listed.Cells.empty())
      {
        this->testListed(first, listed);
        finished = this->finish(first, finished, i, listed);
      }
      listed.add(i, candidates);
    }
    this->testListed(first, listed);
    this->finish(first, finished, count, listed);
  }

  /// Launches a kernel for `count` cells of the piece.
  template <typename... Arguments>
  void launch(const char* name, std::size_t count, const Arguments&... arguments) const
  {
    const BoxTiling& tiling = this->Tiling;
    const std::array<int, 3>& counts = tiling.counts();
    const int children =
      tiling.isGrid() ? 0 : BoxTiling::childCount(tiling.dimension(), tiling.domain());
    cl::Kernel kernel = this->Device.kernel(ClassifyKernels, name);
    this->Device.launch(kernel, count, tiling.dimension(), tiling.axes(), children, counts[0],
      counts[1], counts[2], this->Cuts, this->Nodes, this->Middles, this->Domain, this->Coordinates,
      this->Cells.Corners, this->Cells.Dimension, static_cast<cl_uint>(count), arguments...);
  }

  void countCandidates(std::size_t first, std::size_t count)
  {
    const std::size_t bytes = count * sizeof(cl_int);
    const cl::Buffer counts = this->Device.room(bytes);
    const cl::Buffer owners = this->Device.room(bytes);
    this->launch("countCandidates", count, counts, owners);
    this->Counts.resize(count);
    this->Device.read(counts, this->Counts.data(), bytes);
    this->Device.read(owners, this->Result.Owner.data() + first, bytes);
  }

  // Fills Ids and Verdicts with the listed cells' candidates.
  void testListed(std::size_t first, const Listed& listed)
  {
    const auto candidates = static_cast<std::size_t>(listed.candidates());
    this->Ids.resize(candidates);
    this->Verdicts.assign(candidates, Undecided);
    if (candidates == 0)
    {
      return;
    }
    if (candidates * BytesPerCandidate > this->Room)
    {
      // A single cell with more candidates than fit on the device.
      this->listHere(first + listed.Cells[0]);
      return;
    }
    const cl::Buffer cells = inputOf(this->Device, listed.Cells);
    const cl::Buffer starts = inputOf(this->Device, listed.Starts);
    const cl::Buffer ids = this->Device.room(candidates * sizeof(cl_int));
    const cl::Buffer idCells = this->Device.room(candidates * sizeof(cl_uint));
    const cl::Buffer verdicts = this->Device.room(candidates);
    this->launch("listCandidates", listed.Cells.size(), cells, starts, ids, idCells);
    cl::Kernel test = this->Device.kernel(ClassifyKernels, "testCandidates");
    this->Device.launch(test, candidates, this->Tiling.dimension(), this->Boxes, this->Coordinates,
      this->Cells.Corners, this->Cells.Dimension, static_cast<cl_ulong>(candidates), ids, idCells,
      verdicts);
    this->Device.read(ids, this->Ids.data(), candidates * sizeof(cl_int));
    this->Device.read(verdicts, this->Verdicts.data(), candidates);
  }

  void listHere(std::size_t cell)
  {
    Box3 bounds;
    this->Shape.bounds(this->Shape.cell(cell), bounds);
    std::size_t i = 0;
    this->Tiling.forEachMeeting(bounds, [&](std::int32_t id) { this->Ids[i++] = id; });
  }

  // Sets owners and borrowers of the piece's cells [begin, end); clears the list.
  std::size_t finish(std::size_t first, std::size_t begin, std::size_t end, Listed& listed)
  {
    std::size_t next = 0;
    for (std::size_t i = begin; i < end; ++i)
    {
      if (next < listed.Cells.size() && listed.Cells[next] == i)
      {
        this->decide(first + i, static_cast<std::size_t>(listed.Starts[next]),
          static_cast<std::size_t>(listed.Starts[next + 1]));
        ++next;
      }
      this->Result.BorrowerStart[first + i + 1] =
        static_cast<std::int64_t>(this->Result.Borrowers.size());
    }
    listed.clear();
    return end;
  }

  void decide(std::size_t cell, std::size_t begin, std::size_t end)
  {
    std::int32_t owner = -1;
    for (std::size_t i = begin; i < end; ++i)
    {
      const std::int32_t id = this->Ids[i];
      if (this->Verdicts[i] == Meet ||
        (this->Verdicts[i] == Undecided &&
          this->Shape.meets(this->Shape.cell(cell), this->Tiling.box(id))))
      {
        addPartition(id, owner, this->Result.Borrowers);
      }
    }
    if (owner < 0)
    {
      failForCell(this->Shape, cell);
    }
    this->Result.Owner[cell] = owner;
  }

  ComputeDevice& Device;
  const CellsView& Cells;
  const BoxTiling& Tiling;
  const CellShape& Shape;
  // The tiling's flat arrays on the device.
  cl::Buffer Cuts;
  cl::Buffer Nodes;
  cl::Buffer Middles;
  cl::Buffer Domain;
  cl::Buffer Boxes;
  std::uint64_t Room;
  std::size_t CellBytes;
  std::size_t PieceSize;
  cl::Buffer Coordinates;
  std::vector<cl_int> Counts;
  std::vector<cl_int> Ids;
  std::vector<std::uint8_t> Verdicts;
  Membership Result;
};

} // namespace

std::optional<Membership> classifyOnDevice(
  const CellShape& shape, const BoxTiling& tiling, const ClassifyOptions& options)
{
  ComputeDevice* const device = ComputeDevice::open(options.Device);
  return device ? std::optional<Membership>(
                    DeviceClassification(*device, shape, tiling, options.DeviceMemory).run())
                : std::nullopt;
}

} // namespace tipp

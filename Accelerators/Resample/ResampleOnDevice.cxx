// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/ComputeDevice.h"
#include "Parallel/ParallelFor.h"
#include "Resample/CellVisitor.h"
#include "Resample/ClaimSamples.h"
#include "Resample/Resample.h"
#include "Resample/SampleCells.cl.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// Some cells of a mesh for the kernels: all, with the mesh's own points, or a piece, with each
/// cell's corners stored consecutively.
class MeshOnDevice
{
public:
  /// The whole mesh.
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh)
    : Device(device)
    , Mesh(mesh)
    , Cells(mesh)
  {
    this->send();
  }

  /// A piece of `count` cells, gathered by the CPU's threads.
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::int64_t first,
    std::int64_t count, int threads)
    : Device(device)
    , Mesh(mesh)
    , Cells(mesh)
    , First(first)
    , Threads(threads)
    , Numbers(std::size_t(count * (mesh.Dimension + 1)))
  {
    std::iota(this->Numbers.begin(), this->Numbers.end(), 0);
    this->Cells.Ids = this->Numbers.data();
    this->Cells.Wide = false;
    this->Cells.Cells = count;
    this->Cells.Hidden = mesh.Hidden ? mesh.Hidden + first : nullptr;
    this->send();
  }

  MeshOnDevice(const MeshOnDevice&) = delete;
  MeshOnDevice& operator=(const MeshOnDevice&) = delete;

  /// Sends a point array, for these points.
  cl::Buffer values(const void* values, std::size_t tupleBytes) const
  {
    const auto* const from = static_cast<const char*>(values);
    if (this->isWhole())
    {
      return this->Device.input(from, std::size_t(this->Mesh.PointCount) * tupleBytes);
    }
    std::vector<char>& to = this->Values.emplace_back(this->Numbers.size() * tupleBytes);
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        const auto* const ids = access.ids(this->First);
        forChunks(std::int64_t(this->Numbers.size()), 1 << 14, this->Threads, {},
          [&](std::int64_t begin, std::int64_t end, int)
          {
            for (auto i = std::size_t(begin); i < std::size_t(end); ++i)
            {
              std::memcpy(
                to.data() + i * tupleBytes, from + std::size_t(ids[i]) * tupleBytes, tupleBytes);
            }
          });
      });
    return this->Device.input(to.data(), to.size());
  }

  /// The compiler options that define the mesh's types.
  std::string compilerOptions() const
  {
    return "-DCORNERS=" + std::to_string(this->Mesh.Dimension + 1) +
      " -DFLOAT_POINTS=" + (this->Cells.Float ? "1" : "0") +
      " -DWIDE_IDS=" + (this->Cells.Wide ? "1" : "0");
  }

  bool isWhole() const { return this->Numbers.empty(); }
  std::int64_t first() const { return this->First; } ///< index of the first cell in the mesh
  std::int64_t count() const { return this->Cells.Cells; }
  bool hasHidden() const { return this->Cells.Hidden != nullptr; }

  cl::Buffer Points;
  cl::Buffer Ids;
  cl::Buffer Hidden;

private:
  void send()
  {
    const SimplexMesh& cells = this->Cells;
    const std::size_t scalar = cells.Float ? sizeof(float) : sizeof(double);
    const std::size_t id = cells.Wide ? sizeof(cl_long) : sizeof(cl_int);
    const std::size_t ids = std::size_t(cells.Cells) * std::size_t(cells.Dimension + 1);
    this->Points = this->values(cells.Points, 3 * scalar);
    this->Ids = this->Device.input(cells.Ids, ids * id);
    this->Hidden =
      this->Device.input(cells.Hidden, cells.Hidden ? std::size_t(cells.Cells) : std::size_t(0));
  }

  const ComputeDevice& Device;
  const SimplexMesh& Mesh;
  SimplexMesh Cells; ///< as the kernels see them
  const std::int64_t First = 0;
  const int Threads = 1;
  // Of a piece. A device that shares memory with the host reads them directly.
  std::vector<std::int32_t> Numbers;
  mutable std::vector<std::vector<char>> Values;
};

/// A mesh that is sent to a device: as a whole if it fits, in which case it stays there, else piece
/// by piece.
class MeshPieces
{
public:
  /// Takes at most `memory` bytes of the device; 0: half of its memory.
  MeshPieces(ComputeDevice& device, const SimplexMesh& mesh, int threads, std::uint64_t memory)
    : Device(device)
    , Mesh(mesh)
    , Threads(threads)
    , Corners(std::uint64_t(mesh.Dimension) + 1)
    , Room(memory ? memory : device.description().Memory / 2)
    , Largest(memory ? memory : device.description().LargestBuffer)
  {
  }

  /// Calls work(piece) for all cells, on a device that also holds point arrays of `tuple` bytes per
  /// point and `others` bytes besides the mesh. Returns false if `report` stopped it. Throws
  /// AcceleratorError, also if not even one cell fits.
  template <typename Work>
  bool forEach(std::size_t tuple, std::size_t others, const Report& report, const Work& work)
  {
    const std::int64_t cells = this->Mesh.Cells;
    const bool isWhole = this->fits(tuple, others);
    if (!isWhole)
    {
      this->Whole.reset();
    }
    else if (!this->Whole)
    {
      this->Whole.emplace(this->Device, this->Mesh);
    }
    const std::int64_t step =
      isWhole ? std::max<std::int64_t>(cells, 1) : this->most(tuple, others);
    for (std::int64_t first = 0; first < cells; first += step)
    {
      if (report && !report(double(first) / double(cells)))
      {
        return false;
      }
      isWhole ? work(*this->Whole)
              : work(MeshOnDevice(
                  this->Device, this->Mesh, first, std::min(step, cells - first), this->Threads));
    }
    return true;
  }

  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  const int Threads;

private:
  static constexpr std::uint64_t PointBytes = 3 * sizeof(double);
  static constexpr std::uint64_t ListBytes = 8; ///< for each cell, two lists

  /// Whether the device has memory for the whole mesh.
  bool fits(std::size_t tuple, std::size_t others) const
  {
    const auto points = std::uint64_t(this->Mesh.PointCount);
    const std::uint64_t pointBytes = points * (this->Mesh.Float ? PointBytes / 2 : PointBytes);
    const std::uint64_t idBytes =
      std::uint64_t(this->Mesh.Cells) * this->Corners * (this->Mesh.Wide ? 8 : 4);
    const std::uint64_t listBytes = std::uint64_t(this->Mesh.Cells) * ListBytes;
    return points <= std::uint64_t(std::numeric_limits<cl_int>::max()) &&
      pointBytes <= this->Largest && idBytes <= this->Largest &&
      pointBytes + idBytes + listBytes + points * tuple + others <= this->Room;
  }

  /// The number of cells in a piece.
  std::int64_t most(std::size_t tuple, std::size_t others) const
  {
    const std::uint64_t cellBytes = this->Corners * (PointBytes + 4 + tuple) + ListBytes;
    const std::uint64_t left =
      others < this->Room ? std::min(this->Room - others, this->Largest) : 0;
    if (left < cellBytes)
    {
      throw AcceleratorError("The OpenCL device '" + this->Device.description().Name +
        "' has no memory for " + std::to_string(others) +
        " bytes of samples: use a smaller range or fewer samples.");
    }
    return std::int64_t(std::min(
      left / cellBytes, std::uint64_t(std::numeric_limits<cl_int>::max()) / this->Corners));
  }

  const std::uint64_t Corners; ///< per cell
  const std::uint64_t Room;    ///< bytes of device memory that may be used
  const std::uint64_t Largest; ///< bytes of the largest buffer
  std::optional<MeshOnDevice> Whole;
};

/// The number of arrays, and of their components together, that SampleCells.cl supports.
constexpr std::size_t mostArrays = 4;
constexpr int mostComponents = 8;

/// The number of counters of samples in SampleCells.cl.
constexpr std::size_t counterCount = 1024;

std::size_t tupleBytes(const Attribute& attribute)
{
  return std::size_t(attribute.Components) * (attribute.Type == Scalar::Float32 ? 4 : 8);
}

cl_double16 axisArgument(const LatticeAxis& axis)
{
  return { { axis.Origin, axis.Inverse, axis.First, axis.Limit, axis.ErrorScale, axis.ErrorOffset,
    axis.Delta, double(axis.size()), axis.Steps.Start, axis.Steps.Step, axis.Steps.Scale } };
}

/// One run of the kernels of SampleCells.cl over a mesh: they mark the samples that cells claim,
/// and fill the attributes' samples.
class DeviceSampler
{
public:
  /// With `namesCells` a mark is the index of the claiming cell or -1, in 32 bits; otherwise it is
  /// a byte, 1 if a cell claims the sample, else 0.
  DeviceSampler(MeshPieces& mesh, const LatticeAxes& axes, std::vector<Attribute> attributes,
    void* marks, bool namesCells)
    : Pieces(mesh)
    , Device(mesh.Device)
    , Mesh(mesh.Mesh)
    , Axes(axes)
    , Attributes(std::move(attributes))
    , NamesCells(namesCells)
    , IsCpu(mesh.Device.description().Type == DeviceType::Cpu)
    , Share(this->IsCpu ? 32 : 1)
  {
    this->addOutput(marks, namesCells ? sizeof(std::int32_t) : 1);
    this->Outputs[0].fill(namesCells ? 0xff : 0);
    for (const Attribute& attribute : this->Attributes)
    {
      this->addOutput(attribute.Samples, tupleBytes(attribute));
      this->PointBytes += tupleBytes(attribute);
    }
  }

  SampledCells run(const Report& report)
  {
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        OutsidePoints<std::decay_t<decltype(access)>> outside(this->Mesh, this->Axes);
        outside.find(this->Pieces.Threads);
        this->Result.Aborted = !this->Pieces.forEach(this->PointBytes, this->OutputBytes, report,
          [&](const MeshOnDevice& piece)
          { this->samplePiece(piece, piece.isWhole() ? outside.sides() : nullptr); });
      });
    for (const OutputArray& output : this->Outputs)
    {
      output.fetch();
    }
    return std::move(this->Result);
  }

private:
  /// An array argument of the kernels; unused ones have no components.
  struct Array
  {
    cl::Buffer Values;
    cl::Buffer Samples;
    cl_int Float = 0;
    cl_int Components = 0;
  };

  void addOutput(void* data, std::size_t bytesPerSample)
  {
    const std::size_t bytes = std::size_t(this->Axes.samples()) * bytesPerSample;
    this->Outputs.emplace_back(this->Device, data, bytes);
    this->OutputBytes += bytes;
  }

  std::vector<Array> arraysOf(const MeshOnDevice& piece) const
  {
    const cl::Buffer none = this->Device.room(1);
    std::vector<Array> arrays;
    for (std::size_t i = 0; i < this->Attributes.size(); ++i)
    {
      const Attribute& attribute = this->Attributes[i];
      arrays.push_back(
        { piece.values(attribute.Values, tupleBytes(attribute)), this->Outputs[i + 1].buffer(),
          cl_int(attribute.Type == Scalar::Float32), cl_int(attribute.Components) });
    }
    while (arrays.size() < mostArrays)
    {
      arrays.push_back({ none, none });
    }
    return arrays;
  }

  template <typename... Arguments>
  void launch(const char* name, std::int64_t items, const MeshOnDevice& piece,
    const std::vector<Array>& a, const Arguments&... arguments) const
  {
    const std::string options = piece.compilerOptions() +
      " -DSHARE=" + std::to_string(this->Share) +
      " -DNAMES_CELLS=" + (this->NamesCells ? "1" : "0");
    cl::Kernel kernel = this->Device.kernel(SampleCellsKernels, name, options);
    this->Device.launch(kernel, std::size_t(items), piece.Points, piece.Ids,
      cl_int(this->Mesh.Axes[0]), cl_int(this->Mesh.Axes[1]), axisArgument(this->Axes.U),
      axisArgument(this->Axes.V), axisArgument(this->Axes.W), cl_long(piece.first()),
      this->Outputs[0].buffer(), cl_int(this->Attributes.size()), a[0].Values, a[0].Samples,
      a[0].Float, a[0].Components, a[1].Values, a[1].Samples, a[1].Float, a[1].Components,
      a[2].Values, a[2].Samples, a[2].Float, a[2].Components, a[3].Values, a[3].Samples, a[3].Float,
      a[3].Components, arguments...);
  }

  /// Returns a buffer of `count` zeros of 32 bits.
  cl::Buffer zeros(std::size_t count) const
  {
    const std::size_t bytes = count * sizeof(cl_int);
    cl::Buffer buffer = this->Device.room(bytes);
    this->Device.run([&] { this->Device.queue().enqueueFillBuffer(buffer, cl_int(0), 0, bytes); });
    return buffer;
  }

  /// Waits for the kernels and reads `count` values.
  template <typename T>
  std::vector<T> read(const cl::Buffer& buffer, std::int64_t count) const
  {
    std::vector<T> values(static_cast<std::size_t>(count));
    this->Device.read(buffer, values.data(), values.size() * sizeof(T));
    return values;
  }

  void samplePiece(const MeshOnDevice& piece, const unsigned char* outside)
  {
    const auto count = std::size_t(piece.count());
    const std::int64_t items = (piece.count() + this->Share - 1) / this->Share;
    const std::vector<Array> arrays = this->arraysOf(piece);
    const cl::Buffer sides =
      this->Device.input(outside, outside ? std::size_t(this->Mesh.PointCount) : 0);
    // The numbers of claimed samples, their carries, and lists of the cells that are skipped.
    const cl::Buffer counters = this->zeros(2 * counterCount);
    const cl::Buffer lengths = this->zeros(2);
    const cl::Buffer large = this->Device.room(count * sizeof(cl_int));
    const cl::Buffer doubtful = this->Device.room(count * sizeof(cl_int));
    // Cells with more samples in their boxes are processed with a work item per row. On a CPU,
    // starting a kernel costs more than waiting for one large cell.
    const cl_long largest = this->IsCpu ? 1 << 16 : 1 << 12;
    this->launch("sampleCells", items, piece, arrays, cl_long(count), largest, piece.Hidden,
      cl_int(piece.hasHidden()), sides, cl_int(outside != nullptr), counters, large, doubtful,
      lengths);
    const std::vector<cl_uint> counted = this->read<cl_uint>(counters, 2 * counterCount);
    for (std::size_t i = 0; i < counterCount; ++i)
    {
      this->Result.Claimed += std::int64_t(counted[counterCount + i]) << 32 | counted[i];
    }
    const std::vector<cl_int> length = this->read<cl_int>(lengths, 2);
    for (const cl_int cell : this->read<cl_int>(doubtful, length[1]))
    {
      this->Result.Open.push_back(std::int32_t(piece.first() + cell));
    }
    for (const cl_int cell : this->read<cl_int>(large, length[0]))
    {
      this->sampleLarge(piece, arrays, cell);
    }
  }

  void sampleLarge(const MeshOnDevice& piece, const std::vector<Array>& arrays, cl_int cell)
  {
    const std::int64_t number = piece.first() + cell;
    const std::int64_t rows = this->rowsOf(number);
    const cl::Buffer counts = this->Device.room(std::size_t(rows) * sizeof(cl_int));
    this->launch("sampleLarge", rows, piece, arrays, cl_long(cell), cl_int(rows), counts);
    const std::vector<cl_int> counted = this->read<cl_int>(counts, rows);
    if (std::find(counted.begin(), counted.end(), -1) != counted.end())
    {
      this->Result.Open.push_back(std::int32_t(number));
      return;
    }
    this->Result.Claimed += std::accumulate(counted.begin(), counted.end(), std::int64_t(0));
  }

  /// The number of rows of samples in a cell's box.
  std::int64_t rowsOf(std::int64_t cell) const
  {
    std::int64_t rows = 0;
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        using Access = std::decay_t<decltype(access)>;
        CellRows<Access::Dimension> spans(this->Axes);
        typename Access::Point corners[Access::Corners];
        access.corners(cell, corners);
        spans.set(corners);
        rows = std::int64_t(spans.rows().size()) * spans.layers().size();
      });
    return rows;
  }

  MeshPieces& Pieces;
  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  const LatticeAxes& Axes;
  const std::vector<Attribute> Attributes;
  const bool NamesCells;
  const bool IsCpu;
  /// Cells per work item: several on a CPU, whose items do not run in SIMD lanes.
  const cl_int Share;
  std::vector<OutputArray> Outputs; ///< for the marks, and then for each attribute
  std::size_t OutputBytes = 0;
  std::size_t PointBytes = 0; ///< of the attributes, per point
  SampledCells Result;
};

class OpenCLResampler : public DeviceResampler
{
public:
  OpenCLResampler(ComputeDevice& device, const SimplexMesh& mesh, const ResampleOptions& options)
    : Pieces(device, mesh, options.Threads, options.DeviceMemory)
  {
  }

  std::string name() const override { return this->Pieces.Device.description().Name; }
  double transferSeconds() const override { return this->Pieces.Device.transferSeconds(); }

  bool canSample(const std::vector<Attribute>& attributes) const override
  {
    int components = 0;
    for (const Attribute& attribute : attributes)
    {
      components += attribute.Components;
    }
    const auto isSupported = [](const Attribute& attribute)
    {
      return attribute.Values && !attribute.OfCells &&
        (attribute.Type == Scalar::Float32 || attribute.Type == Scalar::Float64);
    };
    return std::all_of(attributes.begin(), attributes.end(), isSupported) &&
      attributes.size() <= mostArrays && components <= mostComponents;
  }

  DirectResult sample(const Lattice& lattice, const std::vector<Attribute>& attributes,
    const ResampleOptions& options) override
  {
    const LatticeAxes axes(this->Pieces.Mesh, lattice);
    // A temporary: its buffers must be gone before the threads write to the arrays.
    const SampledCells sampled = DeviceSampler(this->Pieces, axes, attributes, options.Valid, false)
                                   .run(partOf(options.Progress, 0, deviceShare));
    ResampleOptions rest = options;
    rest.Progress = partOf(options.Progress, deviceShare, 1);
    return sampled.Aborted ? DirectResult{ {}, 0, false, true }
                           : finishDirectly(this->Pieces.Mesh, lattice, attributes, rest, sampled);
  }

  Claims claim(const Lattice& lattice, const Report& report) override
  {
    const LatticeAxes axes(this->Pieces.Mesh, lattice);
    Claims claims;
    claims.Cells.reset(new std::int32_t[std::size_t(axes.samples())]);
    const SampledCells sampled = DeviceSampler(this->Pieces, axes, {}, claims.Cells.get(), true)
                                   .run(partOf(report, 0, deviceShare));
    claims.Aborted = sampled.Aborted;
    return sampled.Aborted ? std::move(claims)
                           : finishClaims(this->Pieces.Mesh, lattice, this->Pieces.Threads,
                               std::move(claims.Cells), sampled, partOf(report, deviceShare, 1));
  }

private:
  static constexpr double deviceShare = 0.9; ///< of the progress; the threads complete the work

  MeshPieces Pieces;
};

} // namespace

std::unique_ptr<DeviceResampler> DeviceResampler::open(
  const SimplexMesh& mesh, const ResampleOptions& options)
{
  ComputeDevice* const device = ComputeDevice::open(options.Device);
  return device ? std::make_unique<OpenCLResampler>(*device, mesh, options) : nullptr;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCL/ComputeDevice.h"
#include "Resample/CellVisitor.h"
#include "Resample/MeshOnDevice.h"
#include "Resample/Resample.h"
#include "Resample/SampleCells.cl.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tipp
{
namespace
{

/// The number of arrays, and of their components together, that SampleCells.cl supports.
constexpr std::size_t mostArrays = 4;
constexpr int mostComponents = 8;

/// The number of counters of samples in SampleCells.cl.
constexpr std::size_t counterCount = 1024;

std::size_t tupleBytes(const Attribute& attribute)
{
  return std::size_t(attribute.Components) * (attribute.Type == Scalar::Float32 ? 4 : 8);
}

/// A host array that kernels write to, first filled with a byte. It is not copied if host and
/// device share memory.
class OutputArray
{
public:
  OutputArray(const ComputeDevice& device, void* data, std::size_t bytes)
    : Device(device)
    , Data(data)
    , Bytes(bytes)
    , Room(device.sharesHostMemory() ? device.run(
                                         [&] {
                                           return cl::Buffer(device.context(),
                                             CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, data);
                                         })
                                     : device.room(bytes))
  {
  }

  const cl::Buffer& buffer() const { return this->Room; }

  void fill(unsigned char byte) const
  {
    this->Device.run(
      [&] { this->Device.queue().enqueueFillBuffer(this->Room, cl_uchar(byte), 0, this->Bytes); });
  }

  /// Waits for the kernels and makes their results visible.
  void fetch() const
  {
    if (!this->Device.sharesHostMemory())
    {
      this->Device.read(this->Room, this->Data, this->Bytes);
      return;
    }
    this->Device.run(
      [&]
      {
        void* const mapped = this->Device.queue().enqueueMapBuffer(
          this->Room, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, this->Bytes);
        this->Device.queue().enqueueUnmapMemObject(this->Room, mapped);
        this->Device.queue().finish();
      });
  }

private:
  const ComputeDevice& Device;
  void* Data;
  std::size_t Bytes;
  cl::Buffer Room;
};

cl_double8 axisArgument(const LatticeAxis& axis)
{
  return { { axis.origin(), axis.inverse(), axis.firstIndex(), axis.limit(), axis.errorScale(),
    axis.errorOffset(), axis.delta(), double(axis.size()) } };
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
    , Share(shareOf(mesh.Device))
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
        OutsidePoints<std::decay_t<decltype(access)>> outside(
          this->Mesh, { &this->Axes.U, &this->Axes.V, &this->Axes.W });
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

  /// The number of cells per work item: several on a CPU, whose items do not run in SIMD lanes.
  static cl_int shareOf(const ComputeDevice& device)
  {
    return device.description().Type == DeviceType::Cpu ? 32 : 1;
  }

  /// Cells with more samples in their boxes are processed with a work item per row. On a CPU,
  /// starting a kernel costs more than waiting for one large cell.
  static cl_long largestCellOf(const ComputeDevice& device)
  {
    return device.description().Type == DeviceType::Cpu ? 1 << 16 : 1 << 12;
  }

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
    this->Device.launch(kernel, std::size_t(items), piece.Points, piece.Ids, piece.U, piece.V,
      axisArgument(this->Axes.U), axisArgument(this->Axes.V), axisArgument(this->Axes.W),
      cl_long(piece.first()), this->Outputs[0].buffer(), cl_int(this->Attributes.size()),
      a[0].Values, a[0].Samples, a[0].Float, a[0].Components, a[1].Values, a[1].Samples, a[1].Float,
      a[1].Components, a[2].Values, a[2].Samples, a[2].Float, a[2].Components, a[3].Values,
      a[3].Samples, a[3].Float, a[3].Components, arguments...);
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
    this->launch("sampleCells", items, piece, arrays, cl_long(count), largestCellOf(this->Device),
      piece.Hidden, cl_int(piece.hasHidden()), sides, cl_int(outside != nullptr), counters, large,
      doubtful, lengths);
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
        auto spans = this->Axes.rows(std::integral_constant<int, Access::Dimension>());
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
    const InterpolationOptions& options) override
  {
    const LatticeAxes axes(this->Pieces.Mesh, lattice);
    // A temporary: its buffers must be gone before the threads write to the arrays.
    const SampledCells sampled = DeviceSampler(this->Pieces, axes, attributes, options.Valid, false)
                                   .run(partOf(options.Progress, 0, deviceShare));
    InterpolationOptions rest = options;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ResampleOnDevice.h"

#include "Resample/CellVisitor.h"
#include "Resample/ClaimSamples.cl.h"
#include "Resample/InterpolateSamples.cl.h"
#include "Resample/MeshOnDevice.h"

#include <algorithm>

namespace tipp
{
namespace
{

constexpr std::size_t GroupSize = 64;
/// Cells with more samples in their boxes are done by an item a row.
constexpr cl_long LargestCell = 4096;
/// Neighbours that one work item does on a CPU, where items are not side by side in lanes.
constexpr cl_int CpuShare = 64;

cl_int shareOf(const ComputeDevice& device)
{
  return device.description().Type == DeviceType::Cpu ? CpuShare : 1;
}

template <typename... Arguments>
void enqueue(const ComputeDevice& device, cl::Kernel& kernel, std::int64_t items,
  const Arguments&... arguments)
{
  device.run(
    [&]
    {
      cl_uint index = 0;
      (kernel.setArg(index++, arguments), ...);
      const std::size_t rounded = (std::size_t(items) + GroupSize - 1) / GroupSize * GroupSize;
      device.queue().enqueueNDRangeKernel(
        kernel, cl::NullRange, cl::NDRange(rounded), cl::NDRange(GroupSize));
    });
}

/// An array of this process that kernels write to: in place where the memory is shared.
class OutputArray
{
public:
  OutputArray(const ComputeDevice& device, void* data, std::size_t bytes, bool keeps)
    : Device(device)
    , Data(data)
    , Bytes(bytes)
  {
    device.run(
      [&]
      {
        const bool shared = device.sharesHostMemory();
        const cl_mem_flags placing = shared ? CL_MEM_USE_HOST_PTR
          : keeps                           ? CL_MEM_COPY_HOST_PTR
                                            : cl_mem_flags(0);
        this->Room = cl::Buffer(
          device.context(), CL_MEM_READ_WRITE | placing, bytes, shared || keeps ? data : nullptr);
      });
  }

  const cl::Buffer& buffer() const { return this->Room; }

  /// Waits for the kernels and makes their results visible.
  void fetch() const
  {
    this->Device.run(
      [&]
      {
        if (!this->Device.sharesHostMemory())
        {
          this->Device.queue().enqueueReadBuffer(this->Room, CL_TRUE, 0, this->Bytes, this->Data);
          return;
        }
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

class DeviceClaimer
{
public:
  DeviceClaimer(ComputeDevice& device, const SimplexMesh& mesh, const Lattice& lattice, int threads)
    : Device(device)
    , Mesh(mesh)
    , Grid(lattice)
    , Axes(mesh, lattice)
    , Threads(threads)
    , CellKernel(device.kernel(ClaimSamplesKernels, "claimCells"))
    , LargeKernel(device.kernel(ClaimSamplesKernels, "claimLarge"))
  {
  }

  Claims run(std::uint64_t memory, const Report& report)
  {
    const std::size_t samples = std::size_t(this->Axes.samples());
    std::unique_ptr<std::int32_t[]> claims(new std::int32_t[samples]);
    std::fill(claims.get(), claims.get() + samples, -1);
    bool wanted = true;
    {
      const OutputArray output(this->Device, claims.get(), samples * sizeof(std::int32_t), true);
      const std::int64_t piece =
        cellsOnDevice(this->Device, this->Mesh, 0, samples * sizeof(std::int32_t), memory);
      for (std::int64_t first = 0; wanted && first < this->Mesh.Cells; first += piece)
      {
        wanted = !report || report(0.9 * double(first) / double(this->Mesh.Cells));
        this->claimPiece(first, std::min(piece, this->Mesh.Cells - first), output.buffer());
      }
      output.fetch();
    }
    Claims result;
    result.Aborted = true;
    return wanted ? finishClaims(this->Mesh, this->Grid, this->Threads, std::move(claims),
                      this->Claimed, this->Doubtful, {})
                  : std::move(result);
  }

private:
  void claimPiece(std::int64_t first, std::int64_t count, const cl::Buffer& claims)
  {
    const MeshOnDevice piece(this->Device, this->Mesh, first, count, this->Threads);
    const cl_int share = shareOf(this->Device);
    const std::int64_t items = (count + share - 1) / share;
    const cl::Buffer counts = this->Device.room(std::size_t(items) * sizeof(cl_uint));
    const cl::Buffer large = this->Device.room(std::size_t(count) * sizeof(cl_int));
    const cl::Buffer doubtful = this->Device.room(std::size_t(count) * sizeof(cl_int));
    std::vector<cl_int> lengths(2, 0);
    const OutputArray lengthsOutput(this->Device, lengths.data(), 2 * sizeof(cl_int), true);
    const cl::Buffer hidden =
      this->Device.input(this->Mesh.Hidden ? this->Mesh.Hidden + first : nullptr,
        this->Mesh.Hidden ? std::size_t(count) : 0);
    enqueue(this->Device, this->CellKernel, items, piece.Points, piece.Ids, piece.Float, piece.Wide,
      piece.Corners, piece.U, piece.V, axisArgument(this->Axes.U), axisArgument(this->Axes.V),
      axisArgument(this->Axes.W), cl_long(count), cl_long(first), share, LargestCell, hidden,
      cl_int(this->Mesh.Hidden != nullptr), claims, counts, large, doubtful,
      lengthsOutput.buffer());
    lengthsOutput.fetch();
    std::vector<cl_uint> counted(static_cast<std::size_t>(items));
    this->Device.read(counts, counted.data(), counted.size() * sizeof(cl_uint));
    for (const cl_uint n : counted)
    {
      this->Claimed += n;
    }
    std::vector<cl_int> cells(static_cast<std::size_t>(lengths[1]));
    this->Device.read(doubtful, cells.data(), cells.size() * sizeof(cl_int));
    for (const cl_int cell : cells)
    {
      this->Doubtful.push_back(std::int32_t(first + cell));
    }
    cells.resize(std::size_t(lengths[0]));
    this->Device.read(large, cells.data(), cells.size() * sizeof(cl_int));
    for (const cl_int cell : cells)
    {
      this->claimLarge(piece, first, cell, claims);
    }
  }

  void claimLarge(
    const MeshOnDevice& piece, std::int64_t first, cl_int cell, const cl::Buffer& claims)
  {
    std::int64_t rows = 0;
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        constexpr int dimension = std::decay_t<decltype(access)>::Dimension;
        auto spans = this->Axes.rows(std::integral_constant<int, dimension>());
        typename CellGeometry<dimension>::Corners corners;
        access.corners(first + cell, corners);
        spans.set(corners);
        rows = std::int64_t(spans.rows().size()) * spans.layers().size();
      });
    const cl::Buffer counts = this->Device.room(std::size_t(rows) * sizeof(cl_int));
    enqueue(this->Device, this->LargeKernel, rows, piece.Points, piece.Ids, piece.Float, piece.Wide,
      piece.Corners, piece.U, piece.V, axisArgument(this->Axes.U), axisArgument(this->Axes.V),
      axisArgument(this->Axes.W), cl_long(cell), cl_long(first), cl_int(rows), claims, counts);
    std::vector<cl_int> counted(static_cast<std::size_t>(rows));
    this->Device.read(counts, counted.data(), counted.size() * sizeof(cl_int));
    if (std::find(counted.begin(), counted.end(), -1) != counted.end())
    {
      this->Doubtful.push_back(std::int32_t(first + cell));
      return;
    }
    for (const cl_int n : counted)
    {
      this->Claimed += n;
    }
  }

  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  const Lattice& Grid;
  LatticeAxes Axes;
  int Threads;
  cl::Kernel CellKernel;
  cl::Kernel LargeKernel;
  std::int64_t Claimed = 0;
  std::vector<std::int32_t> Doubtful;
};

bool onDevice(const Attribute& attribute)
{
  return attribute.Values && !attribute.OfCells &&
    (attribute.Type == Scalar::Float32 || attribute.Type == Scalar::Float64);
}

std::size_t tupleBytes(const Attribute& attribute)
{
  return std::size_t(attribute.Components) * (attribute.Type == Scalar::Float32 ? 4 : 8);
}

class DeviceInterpolation
{
public:
  DeviceInterpolation(ComputeDevice& device, const SimplexMesh& mesh, const Lattice& lattice,
    const std::vector<Attribute>& attributes)
    : Device(device)
    , Mesh(mesh)
    , Axes(mesh, lattice)
    , Attributes(attributes)
    , WeighKernel(device.kernel(InterpolateSamplesKernels, "weighSamples"))
    , ArrayKernel(device.kernel(InterpolateSamplesKernels, "interpolateArray"))
  {
  }

  void run(const std::int32_t* claims, std::uint64_t memory)
  {
    const std::size_t samples = std::size_t(this->Axes.samples());
    const cl::Buffer claimed = this->Device.input(claims, samples * sizeof(std::int32_t));
    std::size_t bytes = samples * sizeof(std::int32_t);
    std::size_t tuple = 0;
    for (const Attribute& attribute : this->Attributes)
    {
      this->Outputs.emplace_back(
        this->Device, attribute.Samples, samples * tupleBytes(attribute), true);
      bytes += samples * tupleBytes(attribute);
      tuple += tupleBytes(attribute);
    }
    const int corners = this->Mesh.Dimension + 1;
    this->Block = std::min<std::int64_t>(this->Axes.samples(), BlockSize);
    this->CornerIds = this->Device.room(std::size_t(this->Block * corners) * sizeof(cl_int));
    this->Weights = this->Device.room(std::size_t(this->Block * corners) * sizeof(cl_double));
    const std::int64_t piece = cellsOnDevice(this->Device, this->Mesh, tuple, bytes, memory);
    for (std::int64_t first = 0; first < this->Mesh.Cells; first += piece)
    {
      this->samplePiece(first, std::min(piece, this->Mesh.Cells - first), claimed);
    }
    for (const OutputArray& output : this->Outputs)
    {
      output.fetch();
    }
  }

private:
  static constexpr std::int64_t BlockSize = std::int64_t(1) << 18;

  void samplePiece(std::int64_t first, std::int64_t count, const cl::Buffer& claims)
  {
    const MeshOnDevice piece(this->Device, this->Mesh, first, count, 1);
    std::vector<cl::Buffer> values;
    for (const Attribute& attribute : this->Attributes)
    {
      values.push_back(piece.values(this->Mesh, attribute.Values, tupleBytes(attribute)));
    }
    const cl_int share = shareOf(this->Device);
    const std::int64_t samples = this->Axes.samples();
    for (std::int64_t begin = 0; begin < samples; begin += this->Block)
    {
      const std::int64_t size = std::min(this->Block, samples - begin);
      enqueue(this->Device, this->WeighKernel, (size + share - 1) / share, piece.Points, piece.Ids,
        piece.Float, piece.Wide, piece.Corners, piece.U, piece.V, axisArgument(this->Axes.U),
        axisArgument(this->Axes.V), axisArgument(this->Axes.W), cl_long(count), cl_long(first),
        share, cl_long(begin), cl_long(size), claims, this->CornerIds, this->Weights);
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        const Attribute& attribute = this->Attributes[i];
        enqueue(this->Device, this->ArrayKernel, size, values[i],
          cl_int(attribute.Type == Scalar::Float32), cl_int(attribute.Components), piece.Corners,
          cl_long(begin), cl_long(size), this->CornerIds, this->Weights, this->Outputs[i].buffer());
      }
    }
    this->Device.run([&] { this->Device.queue().finish(); });
  }

  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  LatticeAxes Axes;
  const std::vector<Attribute>& Attributes;
  cl::Kernel WeighKernel;
  cl::Kernel ArrayKernel;
  std::vector<OutputArray> Outputs;
  cl::Buffer CornerIds;
  cl::Buffer Weights;
  std::int64_t Block = 0;
};

} // namespace

Claims claimOnDevice(ComputeDevice& device, const SimplexMesh& mesh, const Lattice& lattice,
  int threads, std::uint64_t memory, const Report& report)
{
  return DeviceClaimer(device, mesh, lattice, threads).run(memory, report);
}

void interpolateOnDevice(ComputeDevice& device, const SimplexMesh& mesh, const Lattice& lattice,
  const std::int32_t* claims, const std::vector<Attribute>& attributes, std::uint64_t memory)
{
  std::vector<Attribute> chosen;
  std::copy_if(attributes.begin(), attributes.end(), std::back_inserter(chosen), onDevice);
  if (!chosen.empty())
  {
    DeviceInterpolation(device, mesh, lattice, chosen).run(claims, memory);
  }
}

} // namespace tipp

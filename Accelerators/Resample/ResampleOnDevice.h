// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResampleOnDevice_h
#define tippResampleOnDevice_h

#include "OpenCL/ComputeDevice.h"
#include "Parallel/ParallelFor.h"
#include "Resample/CellVisitor.h"
#include "Resample/Interpolate.h"
#include "Resample/Resample.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace tipp
{

/// How a mesh is sent to a device: as a whole, or in pieces of this many cells.
struct DevicePieces
{
  bool Whole;
  std::int64_t Cells;
};

/// Computes the pieces for a device that holds point arrays of `tuple` bytes per point and `others`
/// bytes besides the mesh. `memory` is the limit in bytes, 0 for half of the device's memory.
/// Throws AcceleratorError if not even one cell fits.
DevicePieces piecesOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::size_t tuple,
  std::size_t others, std::uint64_t memory);

/// Some cells of a mesh for the kernels of ClaimSamples.cl: all, with the mesh's own points, or a
/// piece, with each cell's corners stored consecutively.
class MeshOnDevice
{
public:
  /// The whole mesh.
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh);
  /// A piece, gathered by the CPU's threads.
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::int64_t first,
    std::int64_t count, int threads);

  /// Sends a point array for these points.
  cl::Buffer values(const SimplexMesh& mesh, const void* values, std::size_t tupleBytes) const;

  /// The compiler options that define the mesh's types.
  std::string compilerOptions() const;

  std::int64_t first() const { return this->First; }
  std::int64_t count() const { return this->Count; }
  bool isWhole() const { return this->Whole; }

  cl::Buffer Points;
  cl::Buffer Ids;
  cl_int U;
  cl_int V;

private:
  bool Float;
  bool Wide;
  int Corners;
  const ComputeDevice& Device;
  std::int64_t First;
  std::int64_t Count;
  bool Whole;
  int Threads;
  std::vector<double> Gathered; ///< must outlive Points
  std::vector<std::int32_t> Numbers;
  mutable std::vector<std::vector<char>> GatheredValues;
};

/// A mesh that is sent to a device: as a whole if it fits, in which case it stays there, else piece
/// by piece.
class MeshPieces
{
public:
  MeshPieces(ComputeDevice& device, const SimplexMesh& mesh, int threads, std::uint64_t memory);

  /// Calls work(piece) for all cells, with memory as computed by piecesOnDevice(). Returns false if
  /// `report` stopped it. Throws AcceleratorError.
  template <typename Work>
  bool forEach(std::size_t tuple, std::size_t others, const Report& report, const Work& work)
  {
    const DevicePieces pieces =
      piecesOnDevice(this->Device, this->Mesh, tuple, others, this->Memory);
    if (!pieces.Whole)
    {
      this->Whole = nullptr;
    }
    for (std::int64_t first = 0; first < this->Mesh.Cells; first += pieces.Cells)
    {
      if (report && !report(double(first) / double(this->Mesh.Cells)))
      {
        return false;
      }
      if (pieces.Whole)
      {
        if (!this->Whole)
        {
          this->Whole = std::make_unique<MeshOnDevice>(this->Device, this->Mesh);
        }
        work(*this->Whole);
        continue;
      }
      const std::int64_t count = std::min(pieces.Cells, this->Mesh.Cells - first);
      work(MeshOnDevice(this->Device, this->Mesh, first, count, this->Threads));
    }
    return true;
  }

  ComputeDevice& device() const { return this->Device; }
  const SimplexMesh& mesh() const { return this->Mesh; }
  int threads() const { return this->Threads; }

private:
  ComputeDevice& Device;
  const SimplexMesh& Mesh;
  int Threads;
  std::uint64_t Memory;
  std::unique_ptr<MeshOnDevice> Whole;
};

/// Number of consecutive cells or samples per work item: several on a CPU, whose items do not run
/// in SIMD lanes.
inline cl_int shareOf(const ComputeDevice& device)
{
  return device.description().Type == DeviceType::Cpu ? 32 : 1;
}

/// Cells with more samples in their boxes are processed with a work item per row. On a CPU,
/// starting a kernel costs more than waiting for one large cell.
inline cl_long largestCellOf(const ComputeDevice& device)
{
  return device.description().Type == DeviceType::Cpu ? 1 << 16 : 1 << 12;
}

/// A host array that kernels write to. It is not copied if host and device share memory.
class OutputArray
{
public:
  OutputArray(const ComputeDevice& device, void* data, std::size_t bytes, bool keeps)
    : Device(device)
    , Data(data)
    , Bytes(bytes)
  {
    if (!device.sharesHostMemory())
    {
      this->Room = device.room(bytes);
      keeps ? device.write(this->Room, data, bytes) : void();
      return;
    }
    device.run(
      [&]
      {
        this->Room =
          cl::Buffer(device.context(), CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes, data);
      });
  }

  const cl::Buffer& buffer() const { return this->Room; }

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

inline cl_double8 axisArgument(const LatticeAxis& axis)
{
  return { { axis.origin(), axis.inverse(), axis.firstIndex(), axis.limit(), axis.errorScale(),
    axis.errorOffset(), axis.delta(), double(axis.size()) } };
}

/// Whether kernels can sample the attribute.
inline bool isForDevice(const Attribute& attribute)
{
  return attribute.Values && isInterpolated(attribute);
}

inline std::size_t tupleBytes(const Attribute& attribute)
{
  return std::size_t(attribute.Components) * (attribute.Type == Scalar::Float32 ? 4 : 8);
}

/// The number of rows of samples in a cell's box.
inline std::int64_t rowsOfCell(const SimplexMesh& mesh, const LatticeAxes& axes, std::int64_t cell)
{
  std::int64_t rows = 0;
  withAccess(mesh,
    [&](const auto& access)
    {
      constexpr int dimension = std::decay_t<decltype(access)>::Dimension;
      auto spans = axes.rows(std::integral_constant<int, dimension>());
      typename CellGeometry<dimension>::Corners corners;
      access.corners(cell, corners);
      spans.set(corners);
      rows = std::int64_t(spans.rows().size()) * spans.layers().size();
    });
  return rows;
}

/// A kernel's results for a piece besides the samples: the number of claimed samples, and the cells
/// that it skipped because they are large or undecided.
class CellLists
{
public:
  CellLists(const ComputeDevice& device, const MeshOnDevice& piece)
    : Device(device)
    , First(piece.first())
    , Share(shareOf(device))
    , Items((piece.count() + this->Share - 1) / this->Share)
    , Counts(device.room(std::size_t(this->Items) * sizeof(cl_uint)))
    , Large(device.room(std::size_t(piece.count()) * sizeof(cl_int)))
    , Doubtful(device.room(std::size_t(piece.count()) * sizeof(cl_int)))
    , Lengths(device, this->Length, sizeof(this->Length), true)
  {
  }
  CellLists(const CellLists&) = delete;
  CellLists& operator=(const CellLists&) = delete;

  cl_int share() const { return this->Share; } ///< cells per work item
  std::int64_t items() const { return this->Items; }

  /// @name Arguments of the kernel
  ///@{
  const cl::Buffer& counts() const { return this->Counts; }
  const cl::Buffer& large() const { return this->Large; }
  const cl::Buffer& doubtful() const { return this->Doubtful; }
  const cl::Buffer& lengths() const { return this->Lengths.buffer(); }
  ///@}

  /// Waits for the kernel. Returns the number of samples claimed.
  std::int64_t fetch() const
  {
    this->Lengths.fetch();
    std::vector<cl_uint> counted(static_cast<std::size_t>(this->Items));
    this->Device.read(this->Counts, counted.data(), counted.size() * sizeof(cl_uint));
    return std::accumulate(counted.begin(), counted.end(), std::int64_t(0));
  }

  /// @name After fetch()
  /// @{
  /// Indices in the piece.
  std::vector<std::int32_t> largeCells() const { return this->listed(this->Large, 0, 0); }
  /// Indices in the mesh.
  std::vector<std::int32_t> doubtfulCells() const
  {
    return this->listed(this->Doubtful, 1, this->First);
  }
  ///@}

private:
  std::vector<std::int32_t> listed(const cl::Buffer& list, int which, std::int64_t first) const
  {
    std::vector<cl_int> cells(static_cast<std::size_t>(this->Length[which]));
    this->Device.read(list, cells.data(), cells.size() * sizeof(cl_int));
    for (cl_int& cell : cells)
    {
      cell = cl_int(first + cell);
    }
    return cells;
  }

  const ComputeDevice& Device;
  const std::int64_t First;
  const cl_int Share;
  const std::int64_t Items;
  const cl::Buffer Counts;
  const cl::Buffer Large;
  const cl::Buffer Doubtful;
  cl_int Length[2] = { 0, 0 }; ///< lengths of the lists
  const OutputArray Lengths;
};

/// Whether sampleOnDevice() supports all of the arrays: a few floating-point point arrays.
bool canSampleOnDevice(const std::vector<Attribute>& attributes);

/// sampleDirectly() on an OpenCL device; finishDirectly() completes the result. Throws
/// AcceleratorError.
SampledCells sampleOnDevice(MeshPieces& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, unsigned char* valid, const Report& report);

/// claimSamples() on an OpenCL device. The device's filters decide most cells; threads of this
/// process do the undecided ones and those at the border. The claims are the same; the statistics
/// count only the undecided cells. Throws AcceleratorError.
Claims claimOnDevice(MeshPieces& mesh, const Lattice& lattice, const Report& report);

/// interpolate() for floating-point point arrays, at the samples that a cell claims in `claims`.
/// The other samples are left unchanged if `keeps`, else undefined. Only the window's samples are
/// transferred. Returns false if `report` stopped it. Throws AcceleratorError.
bool interpolateOnDevice(MeshPieces& mesh, const SampleWindow& window, const std::int32_t* claims,
  const std::vector<Attribute>& attributes, bool keeps, const Report& report);

} // namespace tipp

#endif

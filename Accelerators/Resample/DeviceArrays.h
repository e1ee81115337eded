// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDeviceArrays_h
#define tippDeviceArrays_h

#include "OpenCL/ComputeDevice.h"
#include "Resample/CellVisitor.h"
#include "Resample/Interpolate.h"
#include "Resample/MeshOnDevice.h"

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tipp
{

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

/// What a kernel returns for the cells of a piece besides the samples: the number of samples
/// claimed, and the cells that it has not finished because they are large or undecided.
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
  cl_int Length[2] = { 0, 0 }; ///< of the lists
  const OutputArray Lengths;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCellLists_h
#define tippCellLists_h

#include "Resample/DeviceArrays.h"
#include "Resample/MeshOnDevice.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace tipp
{

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

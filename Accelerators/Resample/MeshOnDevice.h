// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshOnDevice_h
#define tippMeshOnDevice_h

#include "OpenCL/ComputeDevice.h"
#include "Parallel/ParallelFor.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

namespace tipp
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
    , Corners(3 * std::size_t(count * (mesh.Dimension + 1)))
    , Numbers(Corners.size() / 3)
  {
    std::iota(this->Numbers.begin(), this->Numbers.end(), 0);
    this->forCorners(
      [this](const auto& access, std::int64_t i, std::int64_t id)
      {
        const auto [x, y, z] = access.point(id);
        double* const to = this->Corners.data() + 3 * i;
        to[0] = x;
        to[1] = y;
        to[2] = z;
      });
    this->Cells.Points = this->Corners.data();
    this->Cells.Float = false;
    this->Cells.Ids = this->Numbers.data();
    this->Cells.Wide = false;
    this->Cells.Cells = count;
    this->Cells.PointCount = std::int64_t(this->Numbers.size());
    this->Cells.Hidden = mesh.Hidden ? mesh.Hidden + first : nullptr;
    this->send();
  }

  MeshOnDevice(const MeshOnDevice&) = delete;
  MeshOnDevice& operator=(const MeshOnDevice&) = delete;

  /// Sends a point array for these points.
  cl::Buffer values(const void* values, std::size_t tupleBytes) const
  {
    const auto* const from = static_cast<const char*>(values);
    if (this->isWhole())
    {
      return this->Device.input(from, std::size_t(this->Mesh.PointCount) * tupleBytes);
    }
    std::vector<char>& to = this->Values.emplace_back(this->Numbers.size() * tupleBytes);
    this->forCorners(
      [&](const auto&, std::int64_t i, std::int64_t id)
      {
        std::memcpy(
          to.data() + std::size_t(i) * tupleBytes, from + std::size_t(id) * tupleBytes, tupleBytes);
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
  cl_int U;
  cl_int V;

private:
  void send()
  {
    const SimplexMesh& cells = this->Cells;
    this->U = cells.Axes[0];
    this->V = cells.Axes[1];
    const std::size_t scalar = cells.Float ? sizeof(float) : sizeof(double);
    const std::size_t id = cells.Wide ? sizeof(cl_long) : sizeof(cl_int);
    const std::size_t ids = std::size_t(cells.Cells) * std::size_t(cells.Dimension + 1);
    this->Points = this->Device.input(cells.Points, 3 * std::size_t(cells.PointCount) * scalar);
    this->Ids = this->Device.input(cells.Ids, ids * id);
    this->Hidden =
      this->Device.input(cells.Hidden, cells.Hidden ? std::size_t(cells.Cells) : std::size_t(0));
  }

  /// Calls work(access, i, id) for corner i of the piece, which is point `id` of the mesh.
  template <typename Work>
  void forCorners(const Work& work) const
  {
    withAccess(this->Mesh,
      [&](const auto& access)
      {
        forChunks(std::int64_t(this->Numbers.size()), 1 << 14, this->Threads, {},
          [&](std::int64_t begin, std::int64_t end, int)
          {
            for (std::int64_t i = begin; i < end; ++i)
            {
              work(access, i, std::int64_t(access.ids(this->First)[i]));
            }
          });
      });
  }

  const ComputeDevice& Device;
  const SimplexMesh& Mesh;
  SimplexMesh Cells; ///< as the kernels see them
  const std::int64_t First = 0;
  const int Threads = 1;
  // Of a piece. A device that shares memory with the host reads them directly.
  std::vector<double> Corners;
  std::vector<std::int32_t> Numbers;
  mutable std::vector<std::vector<char>> Values;
};

/// A mesh that is sent to a device: as a whole if it fits, in which case it stays there, else piece
/// by piece.
class MeshPieces
{
public:
  MeshPieces(ComputeDevice& device, const SimplexMesh& mesh, int threads, std::uint64_t memory)
    : Device(device)
    , Mesh(mesh)
    , Threads(threads)
    , Memory(memory)
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

  std::uint64_t corners() const { return std::uint64_t(this->Mesh.Dimension) + 1; }
  /// The device memory that may be used.
  std::uint64_t room() const
  {
    return this->Memory ? this->Memory : this->Device.description().Memory / 2;
  }
  std::uint64_t largest() const
  {
    return this->Memory ? this->Memory : this->Device.description().LargestBuffer;
  }

  /// Whether the device has memory for the whole mesh.
  bool fits(std::size_t tuple, std::size_t others) const
  {
    const auto points = std::uint64_t(this->Mesh.PointCount);
    const std::uint64_t pointBytes = points * (this->Mesh.Float ? PointBytes / 2 : PointBytes);
    const std::uint64_t idBytes =
      std::uint64_t(this->Mesh.Cells) * this->corners() * (this->Mesh.Wide ? 8 : 4);
    const std::uint64_t listBytes = std::uint64_t(this->Mesh.Cells) * ListBytes;
    return points <= std::uint64_t(std::numeric_limits<cl_int>::max()) &&
      pointBytes <= this->largest() && idBytes <= this->largest() &&
      pointBytes + idBytes + listBytes + points * tuple + others <= this->room();
  }

  /// The number of cells in a piece.
  std::int64_t most(std::size_t tuple, std::size_t others) const
  {
    const std::uint64_t cellBytes = this->corners() * (PointBytes + 4 + tuple) + ListBytes;
    const std::uint64_t left =
      others < this->room() ? std::min(this->room() - others, this->largest()) : 0;
    if (left < cellBytes)
    {
      throw AcceleratorError("The OpenCL device '" + this->Device.description().Name +
        "' has no memory for " + std::to_string(others) +
        " bytes of samples: use a smaller range or fewer samples.");
    }
    return std::int64_t(std::min(
      left / cellBytes, std::uint64_t(std::numeric_limits<cl_int>::max()) / this->corners()));
  }

  const std::uint64_t Memory; ///< the limit in bytes, 0 for half of the device's memory
  std::optional<MeshOnDevice> Whole;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshOnDevice_h
#define tippMeshOnDevice_h

#include "OpenCL/ComputeDevice.h"
#include "Parallel/ParallelFor.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstdint>
#include <memory>
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

/// For a device with `others` bytes in use besides the mesh and point arrays of `tuple` bytes per
/// point. `memory` is the maximum number of bytes, 0: half of the device's memory. Throws
/// AcceleratorError if no cell fits.
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

/// A mesh that is sent to a device, piece by piece, or as a whole if it fits; then it stays there.
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

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMeshOnDevice_h
#define tippMeshOnDevice_h

#include "OpenCL/ComputeDevice.h"
#include "Parallel/ForChunks.h"
#include "Resample/SimplexMesh.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// How a mesh goes to a device: whole, or cell by cell in pieces of so many.
struct DevicePieces
{
  bool Whole;
  std::int64_t Cells;
};

/// For a device with `others` bytes beside the mesh and point arrays of `tuple` bytes a point.
/// `memory` is how many bytes may be used, 0: half of the device's. Throws AcceleratorError if no
/// cell fits.
DevicePieces piecesOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::size_t tuple,
  std::size_t others, std::uint64_t memory);

/// Some cells of a mesh for the kernels of ClaimSamples.cl: all, with the mesh's own points, or a
/// piece, with the corners of each cell side by side.
class MeshOnDevice
{
public:
  /// The whole mesh.
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh);
  /// A piece, gathered by the threads.
  MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::int64_t first,
    std::int64_t count, int threads);

  /// A point array for these points.
  cl::Buffer values(const SimplexMesh& mesh, const void* values, std::size_t tupleBytes) const;

  /// Tells the compiler of the kernels the types of the mesh.
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
  std::vector<double> Gathered; ///< must last as long as Points
  std::vector<std::int32_t> Numbers;
  mutable std::vector<std::vector<char>> GatheredValues;
};

/// A mesh that goes to a device once or more, whole if it fits; then it stays there.
class MeshPieces
{
public:
  MeshPieces(ComputeDevice& device, const SimplexMesh& mesh, int threads, std::uint64_t memory);

  /// Calls work(piece) for all cells, beside what piecesOnDevice() is told of. False if `report`
  /// stopped it. Throws AcceleratorError.
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

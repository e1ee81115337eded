// SPDX-License-Identifier: BSD-3-Clause
#include "Resample/ResampleOnDevice.h"

#include "Resample/Resample.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

namespace tipp
{
namespace
{

constexpr std::int64_t PointBytes = 3 * sizeof(double);

} // namespace

DevicePieces piecesOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::size_t tuple,
  std::size_t others, std::uint64_t memory)
{
  const DeviceDescription& description = device.description();
  const std::uint64_t room = memory ? memory : description.Memory / 2;
  const std::uint64_t largest = memory ? memory : description.LargestBuffer;
  const std::uint64_t corners = std::uint64_t(mesh.Dimension) + 1;
  const std::uint64_t points = std::uint64_t(mesh.PointCount);
  const std::uint64_t pointBytes = points * (mesh.Float ? PointBytes / 2 : PointBytes);
  const std::uint64_t idBytes = std::uint64_t(mesh.Cells) * corners * (mesh.Wide ? 8 : 4);
  // In addition, two lists and a count for each cell.
  const std::uint64_t listBytes = std::uint64_t(mesh.Cells) * 12;
  if (points <= std::uint64_t(std::numeric_limits<cl_int>::max()) && pointBytes <= largest &&
    idBytes <= largest && pointBytes + idBytes + listBytes + points * tuple + others <= room)
  {
    return { true, std::max<std::int64_t>(mesh.Cells, 1) };
  }
  const std::uint64_t cellBytes = corners * (std::uint64_t(PointBytes) + 4 + tuple) + 12;
  const std::uint64_t left = others < room ? std::min((room - others), largest) : 0;
  if (left < cellBytes)
  {
    throw AcceleratorError("The OpenCL device '" + description.Name + "' has no memory for " +
      std::to_string(others) + " bytes of samples: use a smaller range or fewer samples.");
  }
  // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): `corners` is positive.
  const std::int64_t most = std::numeric_limits<cl_int>::max() / std::int64_t(corners);
  return { false, std::min(std::int64_t(left / cellBytes), most) };
}

MeshOnDevice::MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh)
  : U(mesh.Dimension == 2 ? mesh.Axes[0] : 0)
  , V(mesh.Dimension == 2 ? mesh.Axes[1] : 1)
  , Float(mesh.Float)
  , Wide(mesh.Wide)
  , Corners(mesh.Dimension + 1)
  , Device(device)
  , First(0)
  , Count(mesh.Cells)
  , Whole(true)
  , Threads(1)
{
  const std::size_t scalar = mesh.Float ? sizeof(float) : sizeof(double);
  const std::size_t id = mesh.Wide ? sizeof(cl_long) : sizeof(cl_int);
  this->Points = device.input(mesh.Points, 3 * std::size_t(mesh.PointCount) * scalar);
  this->Ids = device.input(mesh.Ids, std::size_t(mesh.Cells * this->Corners) * id);
}

MeshOnDevice::MeshOnDevice(const ComputeDevice& device, const SimplexMesh& mesh, std::int64_t first,
  std::int64_t count, int threads)
  : U(mesh.Dimension == 2 ? mesh.Axes[0] : 0)
  , V(mesh.Dimension == 2 ? mesh.Axes[1] : 1)
  , Float(false)
  , Wide(false)
  , Corners(mesh.Dimension + 1)
  , Device(device)
  , First(first)
  , Count(count)
  , Whole(false)
  , Threads(threads)
{
  this->Gathered.resize(3 * std::size_t(count * this->Corners));
  this->Numbers.resize(std::size_t(count * this->Corners));
  std::iota(this->Numbers.begin(), this->Numbers.end(), 0);
  withAccess(mesh,
    [&](const auto& access)
    {
#pragma omp parallel for num_threads(threads)
      for (std::int64_t i = 0; i < count; ++i)
      {
        for (int corner = 0; corner < access.Corners; ++corner)
        {
          const Point3 p = access.point(access.ids(first + i)[corner]);
          double* const to = this->Gathered.data() + 3 * (i * access.Corners + corner);
          to[0] = p.x;
          to[1] = p.y;
          to[2] = p.z;
        }
      }
    });
  this->Points = device.input(this->Gathered.data(), this->Gathered.size() * sizeof(double));
  this->Ids = device.input(this->Numbers.data(), this->Numbers.size() * sizeof(std::int32_t));
}

std::string MeshOnDevice::compilerOptions() const
{
  return "-DCORNERS=" + std::to_string(this->Corners) +
    " -DFLOAT_POINTS=" + (this->Float ? "1" : "0") + " -DWIDE_IDS=" + (this->Wide ? "1" : "0");
}

cl::Buffer MeshOnDevice::values(
  const SimplexMesh& mesh, const void* values, std::size_t tupleBytes) const
{
  if (this->Whole)
  {
    return this->Device.input(values, std::size_t(mesh.PointCount) * tupleBytes);
  }
  this->GatheredValues.emplace_back(this->Numbers.size() * tupleBytes);
  std::vector<char>& gathered = this->GatheredValues.back();
  withAccess(mesh,
    [&](const auto& access)
    {
#pragma omp parallel for num_threads(this->Threads)
      for (std::int64_t i = 0; i < this->Count * access.Corners; ++i)
      {
        const std::int64_t id = access.ids(this->First)[i];
        std::memcpy(gathered.data() + std::size_t(i) * tupleBytes,
          static_cast<const char*>(values) + std::size_t(id) * tupleBytes, tupleBytes);
      }
    });
  return this->Device.input(gathered.data(), gathered.size());
}

MeshPieces::MeshPieces(
  ComputeDevice& device, const SimplexMesh& mesh, int threads, std::uint64_t memory)
  : Device(device)
  , Mesh(mesh)
  , Threads(threads)
  , Memory(memory)
{
}

namespace
{

class OpenCLResampler : public DeviceResampler
{
public:
  OpenCLResampler(ComputeDevice& device, const SimplexMesh& mesh, const ResampleOptions& options)
    : Device(device)
    , Pieces(device, mesh, options.Threads, options.DeviceMemory)
  {
  }

  std::string name() const override { return this->Device.description().Name; }
  double transferSeconds() const override { return this->Device.transferSeconds(); }

  bool canSample(const std::vector<Attribute>& attributes) const override
  {
    return canSampleOnDevice(attributes);
  }
  SampledCells sample(const Lattice& lattice, const std::vector<Attribute>& attributes,
    unsigned char* valid, const Report& report) override
  {
    return sampleOnDevice(this->Pieces, lattice, attributes, valid, report);
  }
  Claims claim(const Lattice& lattice, const Report& report) override
  {
    return claimOnDevice(this->Pieces, lattice, report);
  }
  bool interpolate(const SampleWindow& window, const std::int32_t* claims,
    const std::vector<Attribute>& attributes, bool keeps, const Report& report) override
  {
    return interpolateOnDevice(this->Pieces, window, claims, attributes, keeps, report);
  }

private:
  ComputeDevice& Device;
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

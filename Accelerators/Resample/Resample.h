// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippResample_h
#define tippResample_h

#include "OpenCL/DeviceChoice.h"
#include "Resample/Interpolate.h"

#include <string>

namespace tipp
{

struct ResampleOptions
{
  DeviceChoice Device = { tipp::Device::OpenMP, -1, "" };
  std::uint64_t DeviceMemory = 0; ///< bytes of an OpenCL device to use; 0: half of them
  int Threads = 1;
  /// One a sample, of the cells that answer so far (noCellKey: none): the mesh is a part of a
  /// whole, only adds what has lower keys, and costs what its own box covers. Null: it is all there
  /// is, and samples that it does not answer get the attributes' NullValue.
  CellKey* Keys = nullptr;
  /// One a sample, 1 if a cell answers it. With Keys the caller clears it.
  unsigned char* Valid = nullptr;
  const std::int64_t* Parents = nullptr; ///< see InterpolationOptions
  Report Progress;
};

struct ResampleResult
{
  ClaimStatistics Statistics;
  /// Where threads do it and the mesh is all there is, most of the interpolation is counted here.
  double ClaimSeconds = 0;
  double InterpolationSeconds = 0;
  double TransferSeconds = 0; ///< to and from an OpenCL device; the others are without them
  /// "OpenMP", or an OpenCL device's name; empty if a part has no samples to find.
  std::string Device;
  std::string Warning; ///< why it is not the device asked for; else empty
  bool Aborted = false;
};

/// Samples a mesh on a lattice: see claimSamples() and interpolate(). The attributes' arrays have
/// the lattice's samples, the first axis fastest; for triangles those of its two `mesh.Axes`. If an
/// OpenCL device is missing or fails, OpenMP does it all, and Warning tells.
VTKTIPPACCELERATORS_EXPORT ResampleResult resample(const SimplexMesh& mesh, const Lattice& lattice,
  const std::vector<Attribute>& attributes, const ResampleOptions& options);

} // namespace tipp

#endif

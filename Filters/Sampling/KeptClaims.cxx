// SPDX-License-Identifier: BSD-3-Clause
#include "Sampling/KeptClaims.h"

#include "Files/Checksum.h"
#include "Resample/ClaimSamples.h"

#include <cstddef>

namespace tipp
{
namespace
{

/// Returns a checksum of all that claims depend on.
std::uint64_t keyOf(const SimplexMesh& mesh, const Lattice& lattice)
{
  Checksum sum;
  const auto add = [&sum](const auto& value) { sum.add(&value, sizeof value); };
  add(mesh.Float);
  add(mesh.Wide);
  add(mesh.Cells);
  add(mesh.PointCount);
  add(mesh.Dimension);
  add(mesh.Axes);
  add(lattice.Min);
  add(lattice.Delta);
  add(lattice.Extent);
  add(lattice.Slack);
  sum.add(mesh.Points, 3 * std::size_t(mesh.PointCount) * (mesh.Float ? 4 : 8));
  sum.add(
    mesh.Ids, std::size_t(mesh.Dimension + 1) * std::size_t(mesh.Cells) * (mesh.Wide ? 8 : 4));
  if (mesh.Hidden)
  {
    sum.add(mesh.Hidden, std::size_t(mesh.Cells));
  }
  add(mesh.Hidden != nullptr);
  return sum.finish();
}

} // namespace

const Claims* KeptClaims::of(
  const SimplexMesh& mesh, const Lattice& lattice, int threads, const Report& progress)
{
  const std::uint64_t key = keyOf(mesh, lattice);
  if (key != this->Key)
  {
    this->Key.reset();
    this->Kept = claimSamples(mesh, lattice, threads, progress);
    if (this->Kept.Aborted)
    {
      return nullptr;
    }
    this->Key = key;
  }
  return &this->Kept;
}

} // namespace tipp

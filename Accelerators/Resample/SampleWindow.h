// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSampleWindow_h
#define tippSampleWindow_h

#include "Resample/Lattice.h"
#include "Resample/SimplexMesh.h"
#include "vtkTIPPAcceleratorsModule.h"

#include <algorithm>
#include <cstdint>

namespace tipp
{

/// A box of a lattice's samples, and where these lie among all of them. A part of a mesh then costs
/// what its own box holds, not what the whole image does.
///
/// For triangles the samples are those of the lattice's two `mesh.Axes`.
class VTKTIPPACCELERATORS_EXPORT SampleWindow
{
public:
  /// All samples.
  SampleWindow(const SimplexMesh& mesh, const Lattice& lattice);
  /// Those that the mesh's cells may answer, which are found exactly.
  static SampleWindow around(const SimplexMesh& mesh, const Lattice& lattice, int threads);

  /// The window's samples: the very same as the whole lattice's.
  const Lattice& lattice() const { return this->Part; }
  std::int64_t samples() const { return this->Width * this->Height * this->Layers; }
  bool isWhole() const { return this->Whole; }

  /// The first sample of the window's row of this number among all samples.
  std::int64_t place(std::int64_t row) const
  {
    return this->First +
      ((row / this->Height) * this->AllHeight + row % this->Height) * this->AllWidth;
  }

  /// Calls work(first, last, shift) for runs of the window's samples begin..end - 1, of which
  /// first..last - 1 lie at first + shift and so on among all samples.
  template <typename Work>
  void forRuns(std::int64_t begin, std::int64_t end, const Work& work) const
  {
    if (this->Whole)
    {
      work(begin, end, std::int64_t(0));
      return;
    }
    while (begin < end)
    {
      const std::int64_t row = begin / this->Width;
      const std::int64_t last = std::min(end, (row + 1) * this->Width);
      work(begin, last, this->place(row) - row * this->Width);
      begin = last;
    }
  }

private:
  void measure(const SimplexMesh& mesh);

  Lattice Part;
  std::int64_t Width = 0;
  std::int64_t Height = 0;
  std::int64_t Layers = 0;
  std::int64_t AllWidth;
  std::int64_t AllHeight;
  std::int64_t First = 0; ///< of the window's samples among all
  bool Whole = true;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPieceBorders_h
#define tippPieceBorders_h

#include "Engine/Routing.h"
#include "OutOfCore/PieceResult.h"

#include <cstdint>
#include <map>
#include <vector>

namespace tipp
{

/// Sorts triangles at the borders of pieces by the piece that owns them: of all that they meet, the
/// first in the mesh. The others borrow them.
class PieceBorders : public FinalTaker
{
public:
  explicit PieceBorders(const PieceWork& work)
    : Work(work)
  {
  }

  void add(const BoundaryTriangle& triangle) override;
  void appendTo(std::map<PartitionIndex, BorderTriangles>& borders) const;

private:
  void findMet(const BoundaryTriangle& triangle);

  const PieceWork& Work;
  std::map<PartitionIndex, BorderTriangles> Borders;
  std::vector<std::int32_t> Met;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInitialPoint_h
#define tippInitialPoint_h

#include "Engine/PartitionIndex.h"
#include "Predicates/Geometry.h"

#include <cstdint>

namespace tipp
{

/// A point of the initial mesh of a run out of core in D dimensions.
template <int D>
struct InitialPointOf
{
  std::int64_t Id; ///< index in the stream
  /// Multiplied by InputSurveyOf::Factor.
  Point<D> Position;
  PartitionIndex Partition;
  std::int32_t Padding = 0;   ///< so that all bytes of a record are defined
  std::int64_t InPieces = -1; ///< index among all spilled points; -1: not known yet
};

using InitialPoint = InitialPointOf<2>;

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPartitionIndex_h
#define tippPartitionIndex_h

#include <cstdint>

namespace tipp
{

/// The index of a partition, or of a set of partitions, such as a piece.
using PartitionIndex = std::int32_t;
constexpr PartitionIndex NoPartition = -1;

} // namespace tipp

#endif

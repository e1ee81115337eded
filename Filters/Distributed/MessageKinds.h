// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMessageKinds_h
#define tippMessageKinds_h

#include "Messages/Postbox.h"

namespace tipp
{

constexpr MessageKind kindAfter(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// The triangulation's messages between master, sub-masters and workers.
constexpr MessageKind TaskMessage = kindAfter(0);
constexpr MessageKind ResultMessage = kindAfter(1);
constexpr MessageKind FinishedMessage = kindAfter(2);
/// Without a master: a partition is done, and what it sends to a rank's partitions.
constexpr MessageKind PartitionDoneMessage = kindAfter(3);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMessageKinds_h
#define tippMessageKinds_h

#include "Messages/Communicator.h"

namespace tipp
{

constexpr MessageKind kindAfter(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// A partition is done; with the messages that it sends.
constexpr MessageKind PartitionDoneMessage = kindAfter(0);
/// With masters: a partition to triangulate, with its inbox.
constexpr MessageKind TaskMessage = kindAfter(1);

} // namespace tipp

#endif

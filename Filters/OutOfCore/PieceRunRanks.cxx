// SPDX-License-Identifier: BSD-3-Clause
// The part of PieceRun that speaks to other ranks.
#include "OutOfCore/PieceMessages.h"
#include "OutOfCore/PieceRun.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

namespace tipp
{

/// Until all pieces that this rank waits for are done, and on ranks other than the first until it
/// says so.
void PieceRun::coordinate()
{
  constexpr auto pause = std::chrono::microseconds(300);
  for (;;)
  {
    const bool moved = this->sendAndReceive();
    if (!this->tell())
    {
      throw RankFailure(this->rank(), true, "The run was stopped.");
    }
    {
      const Lock lock(this->Mutex);
      const bool isEnded = this->rank() == 0 ? this->PiecesLeft == 0 : this->IsEnded;
      if (this->Ready->isStopped() || (isEnded && this->ToSend.empty()))
      {
        return;
      }
    }
    if (!moved)
    {
      std::this_thread::sleep_for(pause);
    }
  }
}

/// False if there was nothing to do.
bool PieceRun::sendAndReceive()
{
  std::vector<Outgoing> outgoing;
  {
    const Lock lock(this->Mutex);
    outgoing.swap(this->ToSend);
  }
  bool moved = !outgoing.empty();
  for (Outgoing& message : outgoing)
  {
    this->Post->post(message.Rank, message.Kind, std::move(message.Content));
  }
  for (Message message; this->Post->poll(message); moved = true)
  {
    this->receive(message);
  }
  return moved;
}

void PieceRun::receive(const Message& message)
{
  if (message.Kind == EndMessage)
  {
    this->IsEnded = true;
    return;
  }
  if (message.Kind == PartitionMessage)
  {
    this->receivePartition(message);
    return;
  }
  const auto piece = ByteReader(message.Content).value<PartitionIndex>();
  const Lock lock(this->Mutex);
  if (message.Kind != PieceMessage || piece < 0 || std::size_t(piece) >= this->Pieces.size() ||
    this->at(piece).Rank != message.Source)
  {
    throw std::runtime_error("A message from another rank is damaged: no such piece.");
  }
  if (this->PiecesLeft == 0)
  {
    return; // no piece of this rank's wants the result, which the first rank may have removed by
            // now
  }
  this->setDone(piece);
  this->PiecesLeft -= this->rank() == 0 ? 1 : 0;
}

/// One of another rank's is done; and what it sends to this rank's.
void PieceRun::receivePartition(const Message& message)
{
  PartitionIndex sender = -1;
  SentMessages sent = readDone(message.Content, this->Inboxes.size(), sender);
  const auto rankOf = [this](PartitionIndex p) { return this->at(this->pieceOf(p)).Rank; };
  if (rankOf(sender) != message.Source ||
    std::any_of(
      sent.begin(), sent.end(), [&](const auto& to) { return rankOf(to.first) != this->rank(); }))
  {
    throw std::runtime_error("A message from another rank is damaged: it is for another one.");
  }
  {
    const Lock lock(this->Mutex);
    for (auto& [to, vertices] : sent)
    {
      this->deliver(to, std::move(vertices));
    }
  }
  this->Ready->finish(sender);
}

} // namespace tipp

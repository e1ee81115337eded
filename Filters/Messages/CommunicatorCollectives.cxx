// SPDX-License-Identifier: BSD-3-Clause
#include "Messages/Communicator.h"

#include <algorithm>

namespace tipp
{

std::vector<Bytes> Communicator::allToAll(std::vector<Bytes> contents)
{
  std::vector<Bytes> received(static_cast<std::size_t>(this->Size));
  received[std::size_t(this->Rank)] = std::move(contents[std::size_t(this->Rank)]);
  // Each rank starts with the next rank, so that not all send to the same one.
  for (int step = 1; step < this->Size; ++step)
  {
    const int to = (this->Rank + step) % this->Size;
    this->post(to, MessageKind::AllToAll, std::move(contents[std::size_t(to)]));
  }
  for (int step = 1; step < this->Size; ++step)
  {
    const int from = (this->Rank + this->Size - step) % this->Size;
    received[std::size_t(from)] = this->wait(MessageKind::AllToAll, from).Content;
  }
  return received;
}

Bytes Communicator::allToAllInParts(
  Bytes memory, const std::vector<Stretch>& contents, const TakePart& takePart)
{
  const auto shared = std::make_shared<Bytes>(std::move(memory));
  for (int step = 1; step < this->Size; ++step)
  {
    const int to = (this->Rank + step) % this->Size;
    this->postStretch(to, MessageKind::AllToAll, shared, contents[std::size_t(to)]);
  }
  InParts inParts{ takePart, std::vector<char>(std::size_t(this->Size), 1) };
  inParts.IsAwaited[std::size_t(this->Rank)] = 0;
  // Some may have arrived while this rank waited for another message.
  for (auto kept = this->Inbox.begin(); kept != this->Inbox.end();)
  {
    if (!inParts.concerns(*kept))
    {
      ++kept;
      continue;
    }
    inParts.IsAwaited[std::size_t(kept->Source)] = 0;
    takePart(kept->Source, kept->Content.data(), kept->Content.size());
    kept = this->Inbox.erase(kept);
  }
  while (std::count(inParts.IsAwaited.begin(), inParts.IsAwaited.end(), 1) > 0)
  {
    Message message;
    if (!this->receiveGood(message, &inParts))
    {
      this->pause();
    }
    else if (inParts.concerns(message))
    {
      inParts.IsAwaited[std::size_t(message.Source)] = 0;
    }
    else
    {
      this->Inbox.push_back(std::move(message));
    }
  }
  this->flush();
  return std::move(*shared);
}

std::vector<Bytes> Communicator::gather(Bytes content)
{
  std::vector<Bytes> received;
  if (this->Rank != 0)
  {
    this->post(0, MessageKind::Gather, std::move(content));
    return received;
  }
  received.push_back(std::move(content));
  for (int from = 1; from < this->Size; ++from)
  {
    received.push_back(this->wait(MessageKind::Gather, from).Content);
  }
  return received;
}

/// Along a binomial tree: a rank receives from the rank whose number lacks its lowest set bit.
Bytes Communicator::broadcast(Bytes content)
{
  int bit = 1;
  while (bit < this->Size && !(this->Rank & bit))
  {
    bit *= 2;
  }
  if (this->Rank != 0)
  {
    content = this->wait(MessageKind::Broadcast, this->Rank - bit).Content;
  }
  for (bit /= 2; bit > 0; bit /= 2)
  {
    if (this->Rank + bit < this->Size)
    {
      Bytes copy(content.size());
      std::copy(content.begin(), content.end(), copy.begin());
      this->post(this->Rank + bit, MessageKind::Broadcast, std::move(copy));
    }
  }
  return content;
}

void Communicator::sum(std::vector<std::int64_t>& values)
{
  const auto pack = [](const std::vector<std::int64_t>& v)
  {
    ByteWriter writer;
    writer.array(v);
    return writer.take();
  };
  for (int bit = 1; bit < this->Size; bit *= 2)
  {
    if (this->Rank & bit)
    {
      this->post(this->Rank - bit, MessageKind::Sum, pack(values));
      break;
    }
    if (this->Rank + bit < this->Size)
    {
      const Message message = this->wait(MessageKind::Sum, this->Rank + bit);
      const auto others = ByteReader(message.Content).array<std::int64_t>();
      for (std::size_t i = 0; i < values.size(); ++i)
      {
        values[i] += others.at(i);
      }
    }
  }
  const Bytes total = this->broadcast(this->Rank == 0 ? pack(values) : Bytes());
  values = ByteReader(total).array<std::int64_t>();
}

void Communicator::barrier()
{
  std::vector<std::int64_t> none;
  this->sum(none);
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Communicator.h"

#include "Files/IOError.h"

#include <algorithm>
#include <exception>
#include <new>

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
  Bytes memory, const std::vector<ByteRange>& contents, const TakePart& takePart)
{
  const auto shared = std::make_shared<Bytes>(std::move(memory));
  for (int step = 1; step < this->Size; ++step)
  {
    const int to = (this->Rank + step) % this->Size;
    this->postRange(to, MessageKind::AllToAll, shared, contents[std::size_t(to)]);
  }
  std::vector<char> isAwaited(std::size_t(this->Size), 1);
  isAwaited[std::size_t(this->Rank)] = 0;
  const PartReceiver receiver{ takePart,
    [&](const Message& message)
    { return message.Kind == MessageKind::AllToAll && isAwaited[std::size_t(message.Source)]; } };
  // Some messages may have arrived while this rank waited for another.
  for (auto kept = this->Inbox.begin(); kept != this->Inbox.end();)
  {
    if (!receiver.Concerns(*kept))
    {
      ++kept;
      continue;
    }
    isAwaited[std::size_t(kept->Source)] = 0;
    takePart(kept->Source, kept->Content.data(), kept->Content.size());
    kept = this->Inbox.erase(kept);
  }
  while (std::count(isAwaited.begin(), isAwaited.end(), 1) > 0)
  {
    Message message;
    if (!this->receiveGood(message, &receiver))
    {
      this->pause();
    }
    else if (receiver.Concerns(message))
    {
      isAwaited[std::size_t(message.Source)] = 0;
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

/// Along a binary tree to rank 0; the content that the other ranks return is unspecified.
Bytes Communicator::combine(Bytes mine, const std::function<Bytes(Bytes, const Bytes&)>& merge)
{
  for (int bit = 1; bit < this->Size; bit *= 2)
  {
    if (this->Rank & bit)
    {
      this->post(this->Rank - bit, MessageKind::Sum, std::move(mine));
      return {};
    }
    if (this->Rank + bit < this->Size)
    {
      mine = merge(std::move(mine), this->wait(MessageKind::Sum, this->Rank + bit).Content);
    }
  }
  return mine;
}

template <typename Value, typename Operation>
void Communicator::allReduce(std::vector<Value>& values, const Operation& operation)
{
  const auto merge = [&operation](const Bytes& mine, const Bytes& other)
  {
    auto all = unpacked<std::vector<Value>>(mine);
    const auto others = unpacked<std::vector<Value>>(other);
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      all[i] = operation(all[i], others.at(i));
    }
    return packed(all);
  };
  values = unpacked<std::vector<Value>>(this->broadcast(this->combine(packed(values), merge)));
}

void Communicator::sum(std::vector<std::int64_t>& values)
{
  this->allReduce(values, std::plus<>());
}

void Communicator::minimum(std::vector<double>& values)
{
  this->allReduce(values, [](double a, double b) { return std::min(a, b); });
}

void Communicator::barrier()
{
  std::vector<std::int64_t> none;
  this->sum(none);
}

std::vector<Bytes> Communicator::allGather(Bytes content)
{
  SaveArchive writer;
  for (const Bytes& one : this->gather(std::move(content)))
  {
    writer.array(one.data(), one.size());
  }
  const Bytes all = this->broadcast(writer.take());
  std::vector<Bytes> contents;
  for (LoadArchive reader(all); reader.left() > 0;)
  {
    const auto size = std::size_t(reader.get<std::uint64_t>());
    contents.emplace_back(size);
    std::copy_n(reader.raw(size), size, contents.back().data());
  }
  return contents;
}

std::string Communicator::reduce(
  std::string text, const std::function<std::string(const std::string&, const std::string&)>& merge)
{
  std::exception_ptr failure;
  this->combine(packed(text),
    [&](const Bytes& mine, const Bytes& other)
    {
      try
      {
        text = failure ? text : merge(unpacked<std::string>(mine), unpacked<std::string>(other));
      }
      catch (...)
      {
        // Rethrown later, because the other ranks wait for messages in any case.
        failure = std::current_exception();
      }
      return packed(text);
    });
  this->attempt(
    [&]
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    });
  return this->isFirst() ? text : std::string();
}

std::pair<std::int64_t, std::int64_t> Communicator::shareOf(std::int64_t count) const
{
  const std::int64_t each = count / this->Size;
  const std::int64_t rest = count % this->Size;
  const auto startOf = [&](std::int64_t rank) { return rank * each + std::min(rank, rest); };
  return { startOf(this->Rank), startOf(this->Rank + 1) };
}

void Communicator::attempt(const std::function<void()>& work)
{
  if (this->Size == 1)
  {
    work();
    return;
  }
  constexpr char aborted = 'a';
  constexpr char failed = 'f'; // and then the reason
  std::string outcome;
  try
  {
    work();
  }
  catch (const std::bad_alloc&)
  {
    outcome = failed + ("there is not enough memory on rank " + std::to_string(this->Rank)) +
      "; give less to --memory or use fewer ranks on a machine.";
  }
  catch (const std::exception& error)
  {
    outcome = failed + std::string(error.what());
  }
  catch (const WorkAborted&)
  {
    outcome = aborted;
  }
  const std::vector<std::string> all = this->allGather(outcome);
  const auto is = [](char what)
  { return [what](const std::string& end) { return !end.empty() && end[0] == what; }; };
  const auto failure = std::find_if(all.begin(), all.end(), is(failed));
  if (failure != all.end())
  {
    throw IOError(failure->substr(1));
  }
  if (std::any_of(all.begin(), all.end(), is(aborted)))
  {
    throw WorkAborted();
  }
}

void Communicator::note(int rank, bool aborted, const std::string& reason)
{
  if (!this->Failure || rank < this->Failure->Rank)
  {
    this->Failure = std::make_unique<RankFailure>(rank, aborted, reason);
  }
}

void Communicator::noteFailure(const Message& message)
{
  if (message.Kind == MessageKind::Failure)
  {
    LoadArchive reader(message.Content);
    const bool aborted = reader.get<char>() != 0;
    this->note(message.Source, aborted, reader.get<std::string>());
  }
  else
  {
    this->HasShutDown[std::size_t(message.Source)] = 1;
    this->note(this->Size, false, "Another rank has ended the run.");
  }
}

void Communicator::announceFailure(bool aborted, const std::string& why)
{
  constexpr std::size_t longest = 4096; // so that the message is never in parts
  this->HasAnnounced = true;
  const std::string reason = why.substr(0, longest);
  this->note(this->Rank, aborted, reason);
  for (int to = 0; to < this->Size; ++to)
  {
    if (to != this->Rank)
    {
      this->sendTo(to, MessageKind::Failure, packed(char(aborted), reason));
    }
  }
}

/// Sends a shutdown message to every other rank and receives all messages up to theirs. Afterwards
/// no message of this run is left for the next one, and all ranks know the same failures.
void Communicator::shutDown()
{
  for (int to = 0; to < this->Size; ++to)
  {
    if (to != this->Rank)
    {
      this->sendTo(to, MessageKind::Shutdown, Bytes());
    }
  }
  this->HasShutDown[std::size_t(this->Rank)] = 1;
  // Messages of this run that report no failure are received in parts and discarded.
  const TakePart discard = [](int, const char*, std::size_t) {};
  const PartReceiver others{ discard, [](const Message& m) { return !m.isOfFailure(); } };
  while (
    !this->Unsent.empty() || std::count(this->HasShutDown.begin(), this->HasShutDown.end(), 0) > 0)
  {
    Message message;
    if (!this->receive(message, &others))
    {
      this->pause();
    }
    else if (message.isOfFailure())
    {
      this->noteFailure(message);
    }
  }
  const RankFailure failure = *this->Failure;
  this->Failure.reset();
  this->HasAnnounced = false;
  this->HasShutDown.assign(this->HasShutDown.size(), 0);
  this->Inbox.clear();
  this->setTogether(false);
  throw RankFailure(failure);
}

void Communicator::setTogether(bool together)
{
  this->IsTogether = together;
  ++this->Run;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Messages/Postbox.h"

#include "Triangulation/Stopwatch.h"

#include "vtkMPIController.h"

#include <algorithm>
#include <array>
#include <thread>

namespace tipp
{
namespace
{

constexpr int HeadTag = 1;
constexpr int PartTag = 2;
constexpr std::size_t LargestPart = std::size_t(1) << 24;
constexpr std::size_t LargestInHead = std::size_t(1) << 16;

// For messages that nobody wants any more, and for those there is no memory for: taking them in
// must not fail, or their senders would wait for ever.
char Discarded[LargestPart];

struct Head
{
  std::uint64_t Size;
  MessageKind Kind;
  std::uint32_t IsComplete; ///< the content follows in the same message
};

} // namespace

/// A message's first part, which has been taken in.
struct Postbox::Arrival
{
  int Source = 0;
  Head About = {};
  std::array<char, sizeof(Head) + LargestInHead> First;
};

struct Postbox::Outgoing
{
  Bytes Head;
  Bytes Content;
  std::vector<vtkMPICommunicator::Request> Requests;

  bool hasLeft()
  {
    while (!this->Requests.empty() && this->Requests.back().Test())
    {
      this->Requests.pop_back();
    }
    return this->Requests.empty();
  }
};

Postbox::Postbox(vtkMultiProcessController* controller)
{
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    if (!vtkMPIController::SafeDownCast(controller))
    {
      throw std::invalid_argument(std::string("The controller is a ") + controller->GetClassName() +
        "; several ranks need a vtkMPIController.");
    }
    this->Rank = controller->GetLocalProcessId();
    this->Size = controller->GetNumberOfProcesses();
    this->Controller.TakeReference(
      vtkMPIController::SafeDownCast(controller->PartitionController(0, this->Rank)));
  }
  this->HasParted.assign(std::size_t(this->Size), 0);
}

/// What is on its way must not be freed. Whoever waits for it still does.
Postbox::~Postbox()
{
  this->flush();
}

void Postbox::post(int to, MessageKind kind, Bytes content)
{
  if (to == this->Rank)
  {
    this->Inbox.push_back({ to, kind, std::move(content) });
    return;
  }
  const Stopwatch watch;
  Traffic& traffic = this->Sent[kind];
  ++traffic.Messages;
  traffic.Bytes += std::int64_t(sizeof(Head) + content.size());
  this->sendTo(to, kind, std::move(content));
  this->testOutgoing();
  this->SendingSeconds += watch.seconds();
}

void Postbox::sendTo(int to, MessageKind kind, Bytes content)
{
  const bool complete = content.size() <= LargestInHead;
  const Head head{ content.size(), kind, complete };
  this->Unsent.emplace_back();
  Outgoing& outgoing = this->Unsent.back();
  outgoing.Head = Bytes(sizeof(Head) + (complete ? content.size() : 0));
  std::memcpy(outgoing.Head.data(), &head, sizeof(Head));
  if (complete && !content.empty())
  {
    std::memcpy(outgoing.Head.data() + sizeof(Head), content.data(), content.size());
  }
  const auto send = [&](const char* data, std::size_t size, int tag)
  {
    outgoing.Requests.emplace_back();
    this->Controller->NoBlockSend(data, static_cast<int>(size), to, tag, outgoing.Requests.back());
  };
  send(outgoing.Head.data(), outgoing.Head.size(), HeadTag);
  if (!complete)
  {
    outgoing.Content = std::move(content);
    const std::size_t size = outgoing.Content.size();
    for (std::size_t at = 0; at < size; at += LargestPart)
    {
      send(outgoing.Content.data() + at, std::min(LargestPart, size - at), PartTag);
    }
  }
}

void Postbox::testOutgoing()
{
  for (auto it = this->Unsent.begin(); it != this->Unsent.end();)
  {
    it = it->hasLeft() ? this->Unsent.erase(it) : std::next(it);
  }
}

bool Postbox::probe(Arrival& arrival)
{
  if (!this->Controller)
  {
    return false;
  }
  this->testOutgoing();
  int found = 0;
  int size = 0;
  const char* const type = nullptr;
  this->Controller->Iprobe(
    vtkMultiProcessController::ANY_SOURCE, HeadTag, &found, &arrival.Source, type, &size);
  if (!found)
  {
    return false;
  }
  this->Controller->Receive(arrival.First.data(), size, arrival.Source, HeadTag);
  std::memcpy(&arrival.About, arrival.First.data(), sizeof(Head));
  return true;
}

bool Postbox::receive(Message& message)
{
  Arrival arrival;
  if (!this->probe(arrival))
  {
    return false;
  }
  const std::size_t size = arrival.About.Size;
  message.Source = arrival.Source;
  message.Kind = arrival.About.Kind;
  try
  {
    message.Content = Bytes(size);
  }
  catch (...)
  {
    this->discardParts(arrival);
    throw;
  }
  if (arrival.About.IsComplete)
  {
    std::copy_n(arrival.First.data() + sizeof(Head), size, message.Content.data());
    return true;
  }
  for (std::size_t at = 0; at < size; at += LargestPart)
  {
    const std::size_t part = std::min(LargestPart, size - at);
    this->Controller->Receive(
      message.Content.data() + at, static_cast<vtkIdType>(part), arrival.Source, PartTag);
  }
  return true;
}

/// Takes in the next message, and returns whether it tells of a failure; others are discarded.
bool Postbox::receiveOfFailure(Message& message)
{
  Arrival arrival;
  while (this->probe(arrival))
  {
    message.Source = arrival.Source;
    message.Kind = arrival.About.Kind;
    if (message.Kind == MessageKind::Failure || message.Kind == MessageKind::Farewell)
    {
      message.Content = Bytes(arrival.About.Size);
      std::copy_n(arrival.First.data() + sizeof(Head), arrival.About.Size, message.Content.data());
      return true;
    }
    this->discardParts(arrival);
  }
  return false;
}

void Postbox::discardParts(const Arrival& arrival)
{
  if (arrival.About.IsComplete)
  {
    return;
  }
  for (std::size_t at = 0; at < arrival.About.Size; at += LargestPart)
  {
    const std::size_t part = std::min(LargestPart, std::size_t(arrival.About.Size) - at);
    this->Controller->Receive(Discarded, static_cast<vtkIdType>(part), arrival.Source, PartTag);
  }
}

bool Postbox::poll(Message& message)
{
  // A rank that is further on may have begun a collective call already.
  const auto isCallers = [](const Message& m) { return m.Kind >= MessageKind::FirstFree; };
  const auto kept = std::find_if(this->Inbox.begin(), this->Inbox.end(), isCallers);
  if (kept != this->Inbox.end())
  {
    message = std::move(*kept);
    this->Inbox.erase(kept);
    return true;
  }
  while (this->receiveGood(message))
  {
    if (isCallers(message))
    {
      return true;
    }
    this->Inbox.push_back(std::move(message));
  }
  return false;
}

/// Throws if the message tells of a failure.
bool Postbox::receiveGood(Message& message)
{
  if (!this->receive(message))
  {
    return false;
  }
  this->Pauses = 0;
  if (message.Kind == MessageKind::Failure || message.Kind == MessageKind::Farewell)
  {
    this->noteFailure(message);
    throw *this->Failure;
  }
  return true;
}

Message Postbox::wait(MessageKind kind, int from)
{
  const auto wanted = [kind, from](const Message& m) { return m.Kind == kind && m.Source == from; };
  const auto kept = std::find_if(this->Inbox.begin(), this->Inbox.end(), wanted);
  if (kept != this->Inbox.end())
  {
    Message message = std::move(*kept);
    this->Inbox.erase(kept);
    return message;
  }
  for (;;)
  {
    Message message;
    if (!this->receiveGood(message))
    {
      this->pause();
      continue;
    }
    if (wanted(message))
    {
      return message;
    }
    this->Inbox.push_back(std::move(message));
  }
}

void Postbox::flush()
{
  while (!this->Unsent.empty())
  {
    this->testOutgoing();
    if (!this->Unsent.empty())
    {
      this->pause();
    }
  }
}

void Postbox::pause()
{
  constexpr int yields = 16;
  constexpr int longest = 200; // microseconds
  ++this->Pauses;
  if (this->Pauses <= yields)
  {
    std::this_thread::yield();
    return;
  }
  std::this_thread::sleep_for(
    std::chrono::microseconds(std::min(10 * (this->Pauses - yields), longest)));
}

std::vector<Bytes> Postbox::allToAll(std::vector<Bytes> contents)
{
  std::vector<Bytes> received(static_cast<std::size_t>(this->Size));
  received[std::size_t(this->Rank)] = std::move(contents[std::size_t(this->Rank)]);
  // Each rank begins with the next one, so that not all send to the same.
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

std::vector<Bytes> Postbox::gather(Bytes content)
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

/// Along a binomial tree: a rank gets it from the one without its lowest bit.
Bytes Postbox::broadcast(Bytes content)
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

void Postbox::sum(std::vector<std::int64_t>& values)
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

void Postbox::barrier()
{
  std::vector<std::int64_t> none;
  this->sum(none);
}

void Postbox::note(int rank, bool aborted, const std::string& reason)
{
  if (!this->Failure || rank < this->Failure->Rank)
  {
    this->Failure = std::make_unique<RankFailure>(rank, aborted, reason);
  }
}

void Postbox::noteFailure(const Message& message)
{
  if (message.Kind == MessageKind::Failure)
  {
    ByteReader reader(message.Content);
    const bool aborted = reader.value<char>() != 0;
    this->note(message.Source, aborted, reader.text());
  }
  else
  {
    this->HasParted[std::size_t(message.Source)] = 1;
    this->note(this->Size, false, "Another rank has ended the run.");
  }
}

void Postbox::tellFailure(bool aborted, const std::string& reason)
{
  this->Told = true;
  this->note(this->Rank, aborted, reason);
  for (int to = 0; to < this->Size; ++to)
  {
    if (to != this->Rank)
    {
      ByteWriter writer;
      writer.value(char(aborted));
      writer.text(reason);
      this->sendTo(to, MessageKind::Failure, writer.take());
    }
  }
}

/// Every rank says farewell to every other and takes in all that comes before the others'
/// farewells: nothing of this run is left for the next, and all know of the same failures.
void Postbox::partAfterFailure()
{
  for (int to = 0; to < this->Size; ++to)
  {
    if (to != this->Rank)
    {
      this->sendTo(to, MessageKind::Farewell, Bytes());
    }
  }
  this->HasParted[std::size_t(this->Rank)] = 1;
  while (!this->Unsent.empty() || std::count(this->HasParted.begin(), this->HasParted.end(), 0) > 0)
  {
    Message message;
    this->receiveOfFailure(message) ? this->noteFailure(message) : this->pause();
  }
  throw *this->Failure;
}

} // namespace tipp

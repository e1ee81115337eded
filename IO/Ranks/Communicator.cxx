// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Communicator.h"

#include "Parallel/Stopwatch.h"

#include <algorithm>
#include <array>
#include <thread>

namespace tipp
{
namespace
{

constexpr int HeadTag = 1;
constexpr int PartTag = 2;
constexpr std::size_t LargestPart = std::size_t(1) << 20;
constexpr std::size_t LargestInHead = std::size_t(1) << 16;
constexpr std::size_t LargestReason = 4096; // so that a failure's message is never in parts

// Buffer for messages that are received in parts or discarded, and for those that do not fit into
// memory: they must be received in any case, or their senders would wait forever.
char Taken[LargestPart];

void discard(int, const char*, std::size_t) {}

struct MessageHeader
{
  std::uint64_t Size;
  MessageKind Kind;
  std::uint32_t Run; ///< the number of the sender's run

  bool isComplete() const { return this->Size <= LargestInHead; } ///< the content follows at once
};

} // namespace

/// The first part of a message, already received.
struct Communicator::Arriving
{
  int Source = 0;
  MessageHeader Header = {};
  std::array<char, sizeof(MessageHeader) + LargestInHead> First;
};

struct Communicator::Outgoing
{
  Bytes First; ///< the header, and a content that fits beside it
  std::shared_ptr<Bytes> Content;
  std::vector<std::unique_ptr<RankTransport::Sending>> Parts;

  bool hasLeft()
  {
    while (!this->Parts.empty() && this->Parts.back()->hasLeft())
    {
      this->Parts.pop_back();
    }
    return this->Parts.empty();
  }
};

Communicator::Communicator(vtkMultiProcessController* controller)
  : Controller(controller)
  , Transport(RankTransport::open(controller))
{
  if (this->Transport)
  {
    this->Rank = this->Transport->rank();
    this->Size = this->Transport->size();
  }
  this->HasShutDown.assign(std::size_t(this->Size), 0);
}

/// Buffers must not be freed before their sends complete. Receivers still wait for these messages.
Communicator::~Communicator()
{
  this->flush();
}

void Communicator::post(int to, MessageKind kind, Bytes content)
{
  if (to == this->Rank)
  {
    this->Inbox.push_back({ to, kind, std::move(content) });
    return;
  }
  const ByteRange whole{ 0, content.size() };
  this->postRange(to, kind, std::make_shared<Bytes>(std::move(content)), whole);
}

void Communicator::postRange(
  int to, MessageKind kind, const std::shared_ptr<Bytes>& memory, const ByteRange& range)
{
  const Stopwatch watch;
  Traffic& traffic = this->Sent[kind];
  ++traffic.Messages;
  traffic.Bytes += std::int64_t(sizeof(MessageHeader) + range.Size);
  this->sendTo(to, kind, memory, range);
  this->testOutgoing();
  this->SendingSeconds += watch.seconds();
}

void Communicator::sendTo(int to, MessageKind kind, Bytes content)
{
  const ByteRange whole{ 0, content.size() };
  this->sendTo(to, kind, std::make_shared<Bytes>(std::move(content)), whole);
}

void Communicator::sendTo(
  int to, MessageKind kind, const std::shared_ptr<Bytes>& memory, const ByteRange& range)
{
  const char* const content = memory->data() + range.Begin;
  const std::size_t size = range.Size;
  const MessageHeader header{ size, kind, this->Run };
  const bool complete = header.isComplete();
  this->Unsent.emplace_back();
  Outgoing& outgoing = this->Unsent.back();
  outgoing.First = Bytes(sizeof(MessageHeader) + (complete ? size : 0));
  std::memcpy(outgoing.First.data(), &header, sizeof(MessageHeader));
  if (complete && size > 0)
  {
    std::memcpy(outgoing.First.data() + sizeof(MessageHeader), content, size);
  }
  const auto send = [&](const char* data, std::size_t bytes, int tag)
  { outgoing.Parts.push_back(this->Transport->send(data, bytes, to, tag)); };
  send(outgoing.First.data(), outgoing.First.size(), HeadTag);
  if (!complete)
  {
    outgoing.Content = memory;
    for (std::size_t at = 0; at < size; at += LargestPart)
    {
      send(content + at, std::min(LargestPart, size - at), PartTag);
    }
  }
}

void Communicator::testOutgoing()
{
  for (auto it = this->Unsent.begin(); it != this->Unsent.end();)
  {
    it = it->hasLeft() ? this->Unsent.erase(it) : std::next(it);
  }
}

bool Communicator::probe(Arriving& arriving)
{
  if (!this->Transport)
  {
    return false;
  }
  this->testOutgoing();
  int size = 0;
  if (!this->Transport->probe(HeadTag, arriving.Source, size))
  {
    return false;
  }
  this->Transport->receive(arriving.First.data(), std::size_t(size), arriving.Source, HeadTag);
  std::memcpy(&arriving.Header, arriving.First.data(), sizeof(MessageHeader));
  return true;
}

/// Takes the next kept message of this run, if any.
bool Communicator::takeEarly(Message& message)
{
  if (this->Early.empty() || this->Early.front().Run > this->Run)
  {
    return false;
  }
  message = std::move(this->Early.front().Content);
  this->Early.pop_front();
  return true;
}

bool Communicator::receive(Message& message, const PartReceiver* receiver)
{
  if (this->takeEarly(message))
  {
    if (receiver && receiver->concerns(message))
    {
      receiver->Take(message.Source, message.Content.data(), message.Content.size());
    }
    return true;
  }
  Arriving arriving;
  while (this->probe(arriving))
  {
    message.Source = arriving.Source;
    message.Kind = arriving.Header.Kind;
    if (arriving.Header.Run > this->Run)
    {
      this->keepForItsRun(arriving);
    }
    else if (receiver && receiver->concerns(message))
    {
      this->receiveParts(arriving, receiver->Take);
      return true;
    }
    else
    {
      message.Content = this->receiveContent(arriving);
      return true;
    }
  }
  return false;
}

Bytes Communicator::receiveContent(const Arriving& arriving)
{
  const std::size_t size = arriving.Header.Size;
  Bytes content;
  try
  {
    content = Bytes(size);
  }
  catch (...)
  {
    this->receiveParts(arriving, discard);
    throw;
  }
  if (arriving.Header.isComplete())
  {
    std::copy_n(arriving.First.data() + sizeof(MessageHeader), size, content.data());
    return content;
  }
  for (std::size_t at = 0; at < size; at += LargestPart)
  {
    const std::size_t part = std::min(LargestPart, size - at);
    this->Transport->receive(content.data() + at, part, arriving.Source, PartTag);
  }
  return content;
}

/// Keeps a message of a later run: another rank may have begun the next run before this rank.
void Communicator::keepForItsRun(const Arriving& arriving)
{
  EarlyMessage early{ arriving.Header.Run,
    { arriving.Source, arriving.Header.Kind, this->receiveContent(arriving) } };
  const auto isLater = [&](const EarlyMessage& other) { return other.Run > early.Run; };
  this->Early.insert(
    std::find_if(this->Early.begin(), this->Early.end(), isLater), std::move(early));
}

/// Receives all parts, even if `takePart` fails.
void Communicator::receiveParts(const Arriving& arriving, const TakePart& takePart)
{
  if (arriving.Header.isComplete())
  {
    takePart(arriving.Source, arriving.First.data() + sizeof(MessageHeader), arriving.Header.Size);
    return;
  }
  std::exception_ptr failure;
  for (std::size_t at = 0; at < arriving.Header.Size; at += LargestPart)
  {
    const std::size_t part = std::min(LargestPart, std::size_t(arriving.Header.Size) - at);
    this->Transport->receive(Taken, part, arriving.Source, PartTag);
    try
    {
      failure ? void() : takePart(arriving.Source, Taken, part);
    }
    catch (...)
    {
      failure = std::current_exception();
    }
  }
  if (failure)
  {
    std::rethrow_exception(failure);
  }
}

/// Receives the next message and discards it unless it reports a failure or belongs to a later run.
/// Returns whether it reports a failure of this run.
bool Communicator::receiveOfFailure(Message& message)
{
  const auto isOfFailure = [](MessageKind kind)
  { return kind == MessageKind::Failure || kind == MessageKind::Shutdown; };
  while (this->takeEarly(message))
  {
    if (isOfFailure(message.Kind))
    {
      return true;
    }
  }
  Arriving arriving;
  while (this->probe(arriving))
  {
    if (arriving.Header.Run > this->Run)
    {
      this->keepForItsRun(arriving);
    }
    else if (isOfFailure(arriving.Header.Kind))
    {
      message = { arriving.Source, arriving.Header.Kind, this->receiveContent(arriving) };
      return true;
    }
    else
    {
      this->receiveParts(arriving, discard);
    }
  }
  return false;
}

bool Communicator::poll(Message& message)
{
  // A rank that is ahead may have started a collective call already.
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

/// Receives the next message, if any. Throws if it reports a failure.
bool Communicator::receiveGood(Message& message, const PartReceiver* receiver)
{
  if (!this->receive(message, receiver))
  {
    return false;
  }
  this->Pauses = 0;
  if (message.Kind == MessageKind::Failure || message.Kind == MessageKind::Shutdown)
  {
    this->noteFailure(message);
    throw *this->Failure;
  }
  return true;
}

Message Communicator::wait(MessageKind kind, int from)
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

void Communicator::flush()
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

void Communicator::pause()
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
  this->HasAnnounced = true;
  const std::string reason = why.substr(0, LargestReason);
  this->note(this->Rank, aborted, reason);
  for (int to = 0; to < this->Size; ++to)
  {
    if (to != this->Rank)
    {
      SaveArchive writer;
      writer(char(aborted));
      writer(reason);
      this->sendTo(to, MessageKind::Failure, writer.take());
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
  while (
    !this->Unsent.empty() || std::count(this->HasShutDown.begin(), this->HasShutDown.end(), 0) > 0)
  {
    Message message;
    this->receiveOfFailure(message) ? this->noteFailure(message) : this->pause();
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

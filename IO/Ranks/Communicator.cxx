// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Communicator.h"

#include "Files/IOError.h"
#include "Parallel/Stopwatch.h"

#ifdef TIPP_HAVE_MPI
#include "vtkMPIController.h"
#include "vtkSmartPointer.h"
#elif !defined(TIPP_WITHOUT_VTK)
#include "vtkMultiProcessController.h"
#endif

#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <thread>

namespace tipp
{

/// Sends bytes from rank to rank, with MPI's semantics. Only one thread of each rank may call it.
class RankTransport
{
public:
  virtual ~RankTransport() = default;

  /// A send in progress.
  class Sending
  {
  public:
    virtual ~Sending() = default;
    /// Whether the send has completed, so that its memory may be freed.
    virtual bool hasLeft() = 0;
  };
  virtual std::unique_ptr<Sending> send(const char* data, std::size_t size, int to, int tag) = 0;

  /// Whether a message with the tag has arrived from any rank.
  virtual bool probe(int tag, int& source, int& size) = 0;
  /// Receives a message of this size; blocks until it has arrived.
  virtual void receive(char* data, std::size_t size, int source, int tag) = 0;
};

namespace
{

#ifdef TIPP_HAVE_MPI

class MpiSending : public RankTransport::Sending
{
public:
  bool hasLeft() override { return this->Request.Test() != 0; }
  vtkMPICommunicator::Request Request;
};

class MpiTransport : public RankTransport
{
public:
  /// Uses its own communicator, so that its messages are not mixed with the program's other
  /// messages.
  explicit MpiTransport(vtkMPIController* all)
  {
    this->Controller.TakeReference(
      vtkMPIController::SafeDownCast(all->PartitionController(0, all->GetLocalProcessId())));
  }

  std::unique_ptr<Sending> send(const char* data, std::size_t size, int to, int tag) override
  {
    auto sending = std::make_unique<MpiSending>();
    this->Controller->NoBlockSend(data, static_cast<int>(size), to, tag, sending->Request);
    return sending;
  }

  bool probe(int tag, int& source, int& size) override
  {
    int found = 0;
    const char* const type = nullptr;
    this->Controller->Iprobe(
      vtkMultiProcessController::ANY_SOURCE, tag, &found, &source, type, &size);
    return found != 0;
  }

  void receive(char* data, std::size_t size, int source, int tag) override
  {
    this->Controller->Receive(data, static_cast<vtkIdType>(size), source, tag);
  }

private:
  vtkSmartPointer<vtkMPIController> Controller;
};

/// Connects all ranks of the controller, separately from the program's other messages. Sets `rank`
/// to this rank's number and `size` to the number of ranks. For one rank returns null and sets
/// neither. Throws std::invalid_argument if there are several ranks without MPI. Collective.
std::unique_ptr<RankTransport> openTransport(
  vtkMultiProcessController* controller, int& rank, int& size)
{
  if (!controller || controller->GetNumberOfProcesses() < 2)
  {
    return nullptr;
  }
  auto* const mpi = vtkMPIController::SafeDownCast(controller);
  if (!mpi)
  {
    throw std::invalid_argument(std::string("The controller is a ") + controller->GetClassName() +
      "; several ranks need a vtkMPIController.");
  }
  rank = mpi->GetLocalProcessId();
  size = mpi->GetNumberOfProcesses();
  return std::make_unique<MpiTransport>(mpi);
}

#else

std::unique_ptr<RankTransport> openTransport(
  [[maybe_unused]] vtkMultiProcessController* controller, int&, int&)
{
#ifndef TIPP_WITHOUT_VTK
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    throw std::invalid_argument("TIPP was built without MPI, so that it works on one rank alone; "
                                "build it with -DTIPP_USE_MPI=ON against a VTK that has MPI.");
  }
#endif
  return nullptr;
}

#endif

constexpr int HeadTag = 1;
constexpr int PartTag = 2;
constexpr std::size_t LargestPart = std::size_t(1) << 20;
constexpr std::size_t LargestInHead = std::size_t(1) << 16;

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
  , Transport(openTransport(controller, this->Rank, this->Size))
{
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
  this->Unsent.remove_if([](Outgoing& outgoing) { return outgoing.hasLeft(); });
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
  if (this->Early.empty() || this->Early.begin()->first > this->Run)
  {
    return false;
  }
  message = std::move(this->Early.begin()->second);
  this->Early.erase(this->Early.begin());
  return true;
}

bool Communicator::receive(Message& message, const PartReceiver* receiver)
{
  if (this->takeEarly(message))
  {
    if (receiver && receiver->Concerns(message))
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
    else if (receiver && receiver->Concerns(message))
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
  this->Early.emplace(arriving.Header.Run,
    Message{ arriving.Source, arriving.Header.Kind, this->receiveContent(arriving) });
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
      if (!failure)
      {
        takePart(arriving.Source, Taken, part);
      }
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

bool Communicator::poll(Message& message)
{
  // A rank that is ahead may have started a collective call already.
  return this->receiveWanted(
    message, [](const Message& m) { return m.Kind >= MessageKind::FirstFree; });
}

/// Takes the first wanted message among those that are kept or have arrived, and keeps the others.
bool Communicator::receiveWanted(
  Message& message, const std::function<bool(const Message&)>& isWanted)
{
  const auto kept = std::find_if(this->Inbox.begin(), this->Inbox.end(), isWanted);
  if (kept != this->Inbox.end())
  {
    message = std::move(*kept);
    this->Inbox.erase(kept);
    return true;
  }
  while (this->receiveGood(message))
  {
    if (isWanted(message))
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
  if (message.isOfFailure())
  {
    this->noteFailure(message);
    throw *this->Failure;
  }
  return true;
}

Message Communicator::wait(MessageKind kind, int from)
{
  Message message;
  while (!this->receiveWanted(
    message, [kind, from](const Message& m) { return m.Kind == kind && m.Source == from; }))
  {
    this->pause();
  }
  return message;
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

Box3 Communicator::boundsOfAll(const Box3& own)
{
  const auto& [low, high] = own;
  std::vector<double> least = { low.x, low.y, low.z, -high.x, -high.y, -high.z };
  this->minimum(least);
  return { { least[0], least[1], least[2] }, { -least[3], -least[4], -least[5] } };
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

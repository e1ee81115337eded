// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCommunicator_h
#define tippCommunicator_h

#include "Parallel/Poll.h"
#include "Predicates/Geometry.h"
#include "Ranks/Archive.h"
#include "vtkTIPPIOModule.h"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

class RankTransport;

/// The kind of a message. Kinds from FirstFree on are the callers'.
enum class MessageKind : std::uint32_t
{
  Failure,  ///< a rank has failed; the content is the reason
  Shutdown, ///< a rank's last message after a failure
  AllToAll,
  Gather,
  Broadcast,
  Sum,
  FirstFree
};

/// Returns the n-th of the callers' kinds, counted from 0.
constexpr MessageKind kindAfter(std::uint32_t n)
{
  return static_cast<MessageKind>(static_cast<std::uint32_t>(MessageKind::FirstFree) + n);
}

/// A received message.
struct Message
{
  int Source = 0; ///< the rank that sent it
  MessageKind Kind = MessageKind::FirstFree;
  Bytes Content;

  bool isOfFailure() const
  {
    return this->Kind == MessageKind::Failure || this->Kind == MessageKind::Shutdown;
  }
};

/// Thrown by all ranks, with the same text, if any rank fails.
class RankFailure : public std::runtime_error
{
public:
  RankFailure(int rank, bool aborted, const std::string& reason)
    : std::runtime_error(reason)
    , Rank(rank)
    , Aborted(aborted)
  {
  }
  int Rank;     ///< the lowest rank that failed
  bool Aborted; ///< the user stopped the run; not an error
};

/// Messages between the ranks of a controller. Sending does not block, messages may have any size,
/// and a rank that waits for a message gets an exception if another rank fails, instead of waiting
/// forever. Only one thread of each rank may use it, the one that calls MPI.
///
/// All ranks construct it together and call the collective methods in the same order. A wait sleeps
/// instead of spinning, so that ranks may share a core.
class VTKTIPPIO_EXPORT Communicator
{
public:
  /// Null: one rank. Throws std::invalid_argument if the controller has several ranks without MPI.
  explicit Communicator(vtkMultiProcessController* controller);
  ~Communicator();
  Communicator(const Communicator&) = delete;
  void operator=(const Communicator&) = delete;

  /// Null for a single rank. Not owned.
  vtkMultiProcessController* controller() const { return this->Controller; }
  int rank() const { return this->Rank; }
  int size() const { return this->Size; }
  bool isFirst() const { return this->Rank == 0; }

  /// This rank's share [first, last) of [0, count); shares differ by at most one.
  std::pair<std::int64_t, std::int64_t> shareOf(std::int64_t count) const;

  /// Sends a message to any rank, including this one. Messages from one rank to another arrive in
  /// the order of posting.
  void post(int to, MessageKind kind, Bytes content);

  /// Receives the next message into `message`; returns false if none has arrived. Throws
  /// RankFailure.
  bool poll(Message& message);

  /// Waits for the next message of a kind from a rank; other messages are kept for later. Throws
  /// RankFailure.
  Message wait(MessageKind kind, int from);

  /// Waits until all sends have completed.
  void flush();

  /// Sleeps briefly; longer after each call without a message in between.
  void pause();

  ///@{
  /// Collective.
  std::vector<Bytes> allToAll(
    std::vector<Bytes> contents); ///< sends one to, receives one from each rank
  std::vector<Bytes> gather(
    Bytes content); ///< all contents, by rank, on rank 0; empty on the others
  std::vector<Bytes> allGather(Bytes content); ///< all contents, by rank, on all ranks
  Bytes broadcast(Bytes content);              ///< returns rank 0's content on all ranks
  void sum(std::vector<std::int64_t>& values);
  void minimum(std::vector<double>& values);
  Box3 boundsOfAll(const Box3& own); ///< the bounding box of all ranks' boxes
  void barrier();
  /// Combines all ranks' texts by merge(mine, other) in a binary tree. Returns the result on rank
  /// 0, an empty text on the others. If merge throws on any rank, throws on all, like attempt().
  std::string reduce(std::string text,
    const std::function<std::string(const std::string&, const std::string&)>& merge);
  ///@}

  /// @{ The collectives above for values of any type that SaveArchive can save.
  template <typename T>
  std::vector<T> gather(const T& value)
  {
    return allUnpacked<T>(this->gather(packed(value)));
  }
  template <typename T>
  std::vector<T> allGather(const T& value)
  {
    return allUnpacked<T>(this->allGather(packed(value)));
  }
  template <typename T>
  T broadcast(const T& value)
  {
    return unpacked<T>(this->broadcast(this->isFirst() ? packed(value) : Bytes()));
  }
  /// Sends values[rank] to each rank; returns one from each rank.
  template <typename T>
  std::vector<T> allToAll(const std::vector<T>& values)
  {
    const auto own = std::size_t(this->Rank); // its value is only copied
    std::vector<Bytes> contents;
    for (std::size_t to = 0; to < values.size(); ++to)
    {
      contents.push_back(to == own ? Bytes() : packed(values[to]));
    }
    contents = this->allToAll(std::move(contents));
    std::vector<T> received;
    for (std::size_t from = 0; from < contents.size(); ++from)
    {
      received.push_back(from == own ? values[from] : unpacked<T>(contents[from]));
    }
    return received;
  }
  ///@}

  /// Runs `work` on every rank and waits for all; `work` must not communicate except by attempt().
  /// If it throws on any rank, this throws on all ranks: an IOError with the message of the first
  /// rank that failed, or WorkAborted if the run was only aborted. Collective.
  void attempt(const std::function<void()>& work);

  /// A byte range of a buffer.
  struct ByteRange
  {
    std::size_t Begin = 0;
    std::size_t Size = 0;
  };
  using TakePart = std::function<void(int from, const char* part, std::size_t size)>;

  /// Like allToAll(), for messages stored in one buffer, one byte range for each other rank.
  /// Returns the buffer once all sends have completed. Received messages are passed to `takePart`
  /// in parts, so that none has to be in memory as a whole: the parts of one rank in order, those
  /// of different ranks interleaved.
  Bytes allToAllInParts(
    Bytes memory, const std::vector<ByteRange>& contents, const TakePart& takePart);

  /// Runs `work` on every rank. If it throws on any rank, it ends on all ranks, every rank throws
  /// the same RankFailure, and no message is left, so that the next call starts afresh. A nested
  /// call just runs `work`; the outer call handles failures. Collective.
  template <typename Work>
  void together(Work&& work)
  {
    if (this->IsTogether)
    {
      work();
      return;
    }
    this->setTogether(true);
    try
    {
      work();
      this->barrier(); // no rank leaves while another may still fail
      this->flush();
      this->setTogether(false);
      return;
    }
    catch (const RankFailure& failure)
    {
      this->note(failure.Rank, failure.Aborted, failure.what());
      if (failure.Rank == this->Rank && !this->HasAnnounced)
      {
        this->announceFailure(failure.Aborted, failure.what());
      }
    }
    catch (const std::bad_alloc&)
    {
      this->announceFailure(
        false, "there is not enough memory; use more ranks on more machines, or fewer points.");
    }
    catch (const std::exception& error)
    {
      this->announceFailure(false, error.what());
    }
    catch (...)
    {
      this->announceFailure(false, "an error of unknown kind ended the work.");
    }
    this->shutDown();
  }

  /// The number of messages and of their bytes.
  struct Traffic
  {
    std::int64_t Messages = 0;
    std::int64_t Bytes = 0;
  };
  /// Messages and bytes sent to other ranks, by kind.
  const std::map<MessageKind, Traffic>& traffic() const { return this->Sent; }
  double sendingSeconds() const { return this->SendingSeconds; }

private:
  struct Outgoing;
  struct Arriving;

  /// Takes some messages in parts, so that they need not be in memory as a whole.
  struct PartReceiver
  {
    const TakePart& Take;
    std::function<bool(const Message&)> Concerns; ///< looks only at the source and kind
  };

  template <typename T>
  static std::vector<T> allUnpacked(const std::vector<Bytes>& contents)
  {
    std::vector<T> values;
    values.reserve(contents.size());
    for (const Bytes& content : contents)
    {
      values.push_back(unpacked<T>(content));
    }
    return values;
  }

  bool probe(Arriving& arriving);
  bool receive(Message& message, const PartReceiver* receiver);
  Bytes receiveContent(const Arriving& arriving);
  void keepForItsRun(const Arriving& arriving);
  void receiveParts(const Arriving& arriving, const TakePart& takePart);
  bool takeEarly(Message& message);
  bool receiveGood(Message& message, const PartReceiver* receiver = nullptr);
  bool receiveWanted(Message& message, const std::function<bool(const Message&)>& isWanted);
  void testOutgoing();
  void postRange(
    int to, MessageKind kind, const std::shared_ptr<Bytes>& memory, const ByteRange& range);
  void sendTo(
    int to, MessageKind kind, const std::shared_ptr<Bytes>& memory, const ByteRange& range);
  void sendTo(int to, MessageKind kind, Bytes content);
  void announceFailure(bool aborted, const std::string& why);
  void note(int rank, bool aborted, const std::string& reason);
  void noteFailure(const Message& message);
  [[noreturn]] void shutDown();
  void setTogether(bool together);
  Bytes combine(Bytes mine, const std::function<Bytes(Bytes, const Bytes&)>& merge);
  template <typename Value, typename Operation>
  void allReduce(std::vector<Value>& values, const Operation& operation);

  vtkMultiProcessController* Controller;

  int Rank = 0;
  int Size = 1;
  std::unique_ptr<RankTransport> Transport; ///< null: one rank
  std::uint32_t Run = 0;                    ///< how often together() has begun or ended
  std::deque<Message> Inbox;
  std::multimap<std::uint32_t, Message> Early; ///< messages of later runs, by run
  std::list<Outgoing> Unsent;
  std::map<MessageKind, Traffic> Sent;
  double SendingSeconds = 0;
  int Pauses = 0;
  bool IsTogether = false;
  bool HasAnnounced = false; ///< this rank has sent its failure to the others
  std::unique_ptr<RankFailure> Failure;
  std::vector<char> HasShutDown;
};

/// Whether `condition` is true on any rank. Collective.
inline bool isTrueOnAny(Communicator& ranks, bool condition)
{
  std::vector<std::int64_t> count = { condition ? 1 : 0 };
  ranks.sum(count);
  return count[0] > 0;
}

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPostbox_h
#define tippPostbox_h

#include "Messages/Bytes.h"
#include "Messages/RankTransport.h"
#include "vtkTIPPFiltersModule.h"

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// What a message is about. Kinds from FirstFree on are the callers' own.
enum class MessageKind : std::uint32_t
{
  Failure,  ///< a rank has failed; the text tells why
  Farewell, ///< the last message of a rank after a failure
  AllToAll,
  Gather,
  Broadcast,
  Sum,
  FirstFree
};

struct Message
{
  int Source = 0;
  MessageKind Kind = MessageKind::FirstFree;
  Bytes Content;
};

/// Some rank has failed: all ranks throw this, with the same text.
class RankFailure : public std::runtime_error
{
public:
  RankFailure(int rank, bool aborted, const std::string& reason)
    : std::runtime_error(reason)
    , Rank(rank)
    , Aborted(aborted)
  {
  }
  int Rank;     ///< the lowest one that failed
  bool Aborted; ///< the user wished to stop; nothing is wrong
};

/// Messages between the ranks of a controller: sending never waits, messages may be of any size,
/// and whoever waits for one learns of another rank's failure instead of waiting for ever. One
/// thread of each rank may speak, the one that speaks MPI.
///
/// All ranks make a Postbox together and call the collective methods in the same order. A wait
/// sleeps rather than spins, so that ranks may share a core.
class VTKTIPPFILTERS_EXPORT Postbox
{
public:
  /// Throws std::invalid_argument if there are several ranks without MPI between them. Null: one
  /// rank.
  explicit Postbox(vtkMultiProcessController* controller);
  ~Postbox();
  Postbox(const Postbox&) = delete;
  void operator=(const Postbox&) = delete;

  int rank() const { return this->Rank; }
  int size() const { return this->Size; }

  /// To any rank, oneself too. Messages from one rank to another arrive in the order of posting.
  void post(int to, MessageKind kind, Bytes content);

  /// The next message, if one is there. Throws RankFailure.
  bool poll(Message& message);

  /// The next message of a kind from a rank; others are kept for later.
  Message wait(MessageKind kind, int from);

  /// Waits until all posted messages have left.
  void flush();

  /// A moment's sleep, longer the more often it is called without a message in between.
  void pause();

  ///@{
  /// Collective.
  std::vector<Bytes> allToAll(std::vector<Bytes> contents); ///< one to each rank, one from each
  std::vector<Bytes> gather(Bytes content);                 ///< on rank 0 one from each rank
  Bytes broadcast(Bytes content);                           ///< rank 0's
  void sum(std::vector<std::int64_t>& values);
  void barrier();
  ///@}

  /// So many bytes of a memory.
  struct Stretch
  {
    std::size_t Begin = 0;
    std::size_t Size = 0;
  };
  using TakePart = std::function<void(int from, const char* part, std::size_t size)>;

  /// As allToAll(), of messages that lie in one memory, a stretch for each of the other ranks. It
  /// comes back when they have left. What comes is handed on part by part, so that none of it need
  /// be in memory as a whole: a rank's parts in order, those of several ranks by turns.
  Bytes allToAllInParts(
    Bytes memory, const std::vector<Stretch>& contents, const TakePart& takePart);

  /// Runs the work on every rank. If it throws anywhere, it ends everywhere, and every rank throws
  /// the same RankFailure; no message is left behind. Within the work of another call it just runs
  /// the work, for that call sees to the rest. Collective.
  template <typename Work>
  void together(Work&& work)
  {
    if (this->IsTogether)
    {
      work();
      return;
    }
    this->IsTogether = true;
    try
    {
      work();
      this->barrier(); // nobody leaves while another may still fail
      this->flush();
      this->IsTogether = false;
      return;
    }
    catch (const RankFailure& failure)
    {
      this->note(failure.Rank, failure.Aborted, failure.what());
      if (failure.Rank == this->Rank && !this->Told)
      {
        this->tellFailure(failure.Aborted, failure.what());
      }
    }
    catch (const std::bad_alloc&)
    {
      this->tellFailure(
        false, "there is not enough memory; use more ranks on more machines, or fewer points.");
    }
    catch (const std::exception& error)
    {
      this->tellFailure(false, error.what());
    }
    catch (...)
    {
      this->tellFailure(false, "an error of unknown kind ended the work.");
    }
    this->partAfterFailure();
  }

  struct Traffic
  {
    std::int64_t Messages = 0;
    std::int64_t Bytes = 0;
  };
  /// Sent to other ranks, by kind.
  const std::map<MessageKind, Traffic>& traffic() const { return this->Sent; }
  double sendingSeconds() const { return this->SendingSeconds; }

private:
  struct Outgoing;
  struct Arrival;

  /// Who is to take the parts of messages, and from which ranks.
  struct InParts
  {
    const TakePart& Take;
    std::vector<char> IsAwaited;

    bool concerns(const Message& message) const
    {
      return message.Kind == MessageKind::AllToAll && this->IsAwaited[std::size_t(message.Source)];
    }
  };

  bool probe(Arrival& arrival);
  bool receive(Message& message, const InParts* inParts);
  void receiveParts(const Arrival& arrival, const TakePart& takePart);
  bool receiveOfFailure(Message& message);
  void discardParts(const Arrival& arrival);
  bool receiveGood(Message& message, const InParts* inParts = nullptr);
  void testOutgoing();
  void postStretch(
    int to, MessageKind kind, const std::shared_ptr<Bytes>& memory, const Stretch& stretch);
  void sendTo(
    int to, MessageKind kind, const std::shared_ptr<Bytes>& memory, const Stretch& stretch);
  void sendTo(int to, MessageKind kind, Bytes content);
  void tellFailure(bool aborted, const std::string& reason);
  void note(int rank, bool aborted, const std::string& reason);
  void noteFailure(const Message& message);
  [[noreturn]] void partAfterFailure();

  std::unique_ptr<RankTransport> Transport; ///< null: one rank
  int Rank = 0;
  int Size = 1;
  std::deque<Message> Inbox;
  std::list<Outgoing> Unsent;
  std::map<MessageKind, Traffic> Sent;
  double SendingSeconds = 0;
  int Pauses = 0;
  bool IsTogether = false;
  bool Told = false; ///< the others know of this rank's failure
  std::unique_ptr<RankFailure> Failure;
  std::vector<char> HasParted;
};

} // namespace tipp

#endif

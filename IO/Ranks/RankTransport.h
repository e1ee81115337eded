// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankTransport_h
#define tippRankTransport_h

#include <cstddef>
#include <memory>

class vtkMultiProcessController;

namespace tipp
{

/// Sends bytes from rank to rank, with MPI's semantics. Only one thread of each rank may call it.
class RankTransport
{
public:
  /// Connects all ranks of the controller, separately from the program's other messages. Returns
  /// null for one rank. Throws std::invalid_argument if there are several ranks without MPI.
  /// Collective.
  static std::unique_ptr<RankTransport> open(vtkMultiProcessController* controller);

  virtual ~RankTransport() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;

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

} // namespace tipp

#endif

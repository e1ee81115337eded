// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRankTransport_h
#define tippRankTransport_h

#include <cstddef>
#include <memory>

class vtkMultiProcessController;

namespace tipp
{

/// Bytes from rank to rank, as MPI carries them. One thread of each rank may call it.
class RankTransport
{
public:
  /// Between all ranks of the controller, apart from all other messages of the program. Null for
  /// one rank. Throws std::invalid_argument if there are several without MPI between them. All
  /// ranks open it together.
  static std::unique_ptr<RankTransport> open(vtkMultiProcessController* controller);

  virtual ~RankTransport() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;

  /// A message on its way.
  class Sending
  {
  public:
    virtual ~Sending() = default;
    /// Whether its memory may be freed.
    virtual bool hasLeft() = 0;
  };
  virtual std::unique_ptr<Sending> send(const char* data, std::size_t size, int to, int tag) = 0;

  /// Whether a message with the tag has arrived from any rank.
  virtual bool probe(int tag, int& source, int& size) = 0;
  /// Waits for a message of this size.
  virtual void receive(char* data, std::size_t size, int source, int tag) = 0;
};

} // namespace tipp

#endif

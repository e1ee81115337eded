// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRanks_h
#define tippRanks_h

#include "Parallel/Poll.h"
#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

class vtkMultiProcessController;

namespace tipp
{

/// The ranks that work on one mesh; one alone if there is no controller.
class VTKTIPPIO_EXPORT Ranks
{
public:
  explicit Ranks(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  /// Null for one alone.
  vtkMultiProcessController* controller() const { return this->Controller; }
  int count() const;
  int rank() const;
  bool isFirst() const { return this->rank() == 0; }

  /// This rank's share of the numbers from 0 to before `count`, all ranks' shares being equal but
  /// for one.
  std::pair<std::int64_t, std::int64_t> shareOf(std::int64_t count) const;

  /// Runs work on every rank and waits for all. If it throws on any, this throws on all: an IOError
  /// with the words of the first rank that failed, else WorkAborted.
  void attempt(const std::function<void()>& work) const;

  /// The first rank's bytes, on all.
  std::string broadcast(const std::string& bytes) const;
  /// Every rank's bytes in the order of the ranks, on all.
  std::vector<std::string> gather(const std::string& bytes) const;
  /// All ranks' bytes made one by merge(mine, other), two ranks at a time as in a tournament; what
  /// comes out is on the first rank, and other ranks get nothing. Throws on all ranks if merge
  /// throws on any.
  std::string reduce(const std::string& bytes,
    const std::function<std::string(const std::string&, const std::string&)>& merge) const;
  /// Over all ranks, for each value.
  std::vector<double> minimum(const std::vector<double>& values) const;
  std::vector<std::int64_t> sum(const std::vector<std::int64_t>& values) const;

private:
  vtkMultiProcessController* Controller;
};

} // namespace tipp

#endif

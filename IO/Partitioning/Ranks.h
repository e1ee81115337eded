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

/// The ranks that work on one mesh; without a controller a single rank.
class VTKTIPPIO_EXPORT Ranks
{
public:
  explicit Ranks(vtkMultiProcessController* controller)
    : Controller(controller)
  {
  }

  /// Null for a single rank. Not owned.
  vtkMultiProcessController* controller() const { return this->Controller; }
  int count() const;
  int rank() const;
  bool isFirst() const { return this->rank() == 0; }

  /// This rank's share [first, last) of [0, count); shares differ by at most one.
  std::pair<std::int64_t, std::int64_t> shareOf(std::int64_t count) const;

  /// Runs `work` on every rank and waits for all. If it throws on any, this throws on all: an
  /// IOError with the message of the first rank that failed, else WorkAborted. Collective.
  void attempt(const std::function<void()>& work) const;

  /// Returns the first rank's bytes on all ranks. Collective.
  std::string broadcast(const std::string& bytes) const;
  /// Returns every rank's bytes, in the order of the ranks, on all ranks. Collective.
  std::vector<std::string> gather(const std::string& bytes) const;
  /// Combines all ranks' bytes by merge(mine, other) in a binary tree. Returns the result on the
  /// first rank, an empty string on the others. Throws on all ranks if merge throws on any.
  /// Collective.
  std::string reduce(const std::string& bytes,
    const std::function<std::string(const std::string&, const std::string&)>& merge) const;
  /// The minimum over all ranks of each value. Collective.
  std::vector<double> minimum(const std::vector<double>& values) const;
  std::vector<std::int64_t> sum(const std::vector<std::int64_t>& values) const;

private:
  vtkMultiProcessController* Controller;
};

} // namespace tipp

#endif

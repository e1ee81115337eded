// SPDX-License-Identifier: BSD-3-Clause
#include "Ranks/Communicator.h"

#include "Files/IOError.h"

#include "vtkMultiProcessController.h"

#include <gtest/gtest.h>

using namespace tipp;

namespace
{

class AttemptOnRanks : public testing::Test
{
protected:
  /// The result of attempt() in which the first rank runs `first` and the last rank `last`: the
  /// error message, "aborted", or an empty string.
  template <typename First, typename Last>
  std::string outcome(const First& first, const Last& last)
  {
    try
    {
      this->All.attempt(
        [&]
        {
          if (this->All.rank() == this->All.size() - 1)
          {
            last();
          }
          if (this->All.isFirst())
          {
            first();
          }
        });
    }
    catch (const IOError& error)
    {
      return error.what();
    }
    catch (const WorkAborted&)
    {
      return "aborted";
    }
    return "";
  }

  Communicator All{ vtkMultiProcessController::GetGlobalController() };
};

void nothing() {}
void abortWork()
{
  throw WorkAborted();
}
void failWork()
{
  throw IOError("no luck");
}

TEST_F(AttemptOnRanks, SucceedTogether)
{
  EXPECT_EQ("", this->outcome(nothing, nothing));
}

TEST_F(AttemptOnRanks, FailTogether)
{
  EXPECT_EQ("no luck", this->outcome(nothing, failWork));
  EXPECT_EQ("no luck", this->outcome(failWork, nothing));
}

TEST_F(AttemptOnRanks, AbortTogether)
{
  EXPECT_EQ("aborted", this->outcome(abortWork, nothing));
  EXPECT_EQ("aborted", this->outcome(nothing, abortWork));
}

TEST_F(AttemptOnRanks, ReportAFailureRatherThanAnAbort)
{
  EXPECT_EQ("no luck", this->outcome(abortWork, failWork));
}

TEST_F(AttemptOnRanks, GatherAllRanksBytesInOrder)
{
  const std::vector<std::string> all =
    this->All.allGather(std::string(std::size_t(this->All.rank()), 'x'));
  ASSERT_EQ(std::size_t(this->All.size()), all.size());
  for (std::size_t rank = 0; rank < all.size(); ++rank)
  {
    EXPECT_EQ(std::string(rank, 'x'), all[rank]);
  }
}

TEST_F(AttemptOnRanks, DivideARangeWithoutGapOrOverlap)
{
  for (const std::int64_t count : { 0, 1, 2, 17, 1000 })
  {
    const auto [first, last] = this->All.shareOf(count);
    EXPECT_LE(last - first, count / this->All.size() + 1);
    const std::vector<std::string> all =
      this->All.allGather(std::to_string(first) + " " + std::to_string(last));
    std::int64_t end = 0;
    for (const std::string& share : all)
    {
      EXPECT_EQ(end, std::stoll(share));
      end = std::stoll(share.substr(share.find(' ')));
    }
    EXPECT_EQ(count, end);
  }
}

} // namespace

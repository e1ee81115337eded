// SPDX-License-Identifier: BSD-3-Clause
#include "Engine/ReadyPartitions.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

namespace tipp
{
namespace
{

/// Waits: first by yielding the core to another thread, later by sleeping.
void waitAWhile(int turn)
{
  constexpr int yields = 32;
  if (turn < yields)
  {
    std::this_thread::yield();
  }
  else
  {
    std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

} // namespace

ReadyPartitions::ReadyPartitions(const PartitionOrder& order, Waits waits, std::vector<char> isOwn)
  : Order(order)
  , For(waits)
  , Own(std::move(isOwn))
  , Awaited(order.partitionCount())
  , LeftInColour(waits == Waits::ForColour ? order.colourCount() : 0)
  , Ranks(order.partitionCount(), 0)
  , ReadyBits((order.sequence().size() + 63) / 64)
{
  for (const PartitionIndex p : order.byUrgency())
  {
    if (this->isOwn(p))
    {
      this->Ranks[std::size_t(p)] = static_cast<std::uint32_t>(this->Urgency.size());
      this->Urgency.push_back(p);
    }
  }
  this->Left = this->Urgency.size();
  waits == Waits::ForColour ? this->countColours() : this->awaitEarlier();
}

void ReadyPartitions::countColours()
{
  for (std::size_t colour = 0; colour < this->Order.colourCount(); ++colour)
  {
    this->LeftInColour[colour] = std::int64_t(this->Order.colourSize(colour));
  }
  if (this->Order.colourCount() > 0)
  {
    this->releaseColour(0);
  }
}

void ReadyPartitions::awaitEarlier()
{
  for (const PartitionIndex p : this->Order.sequence())
  {
    this->Awaited[std::size_t(p)] += this->For == Waits::ForEarlier ? 0 : 1;
    if (this->For != Waits::ForLoad)
    {
      for (const PartitionIndex later : this->Order.later(p))
      {
        ++this->Awaited[std::size_t(later)];
      }
    }
  }
  for (const PartitionIndex p : this->Order.sequence())
  {
    if (this->Awaited[std::size_t(p)] == 0 && this->isOwn(p))
    {
      this->release(p);
    }
  }
}

/// Releases the partitions of a colour. They are consecutive, since the order has no windows.
void ReadyPartitions::releaseColour(std::size_t colour)
{
  const auto& sequence = this->Order.sequence();
  const auto first = std::partition_point(sequence.begin(), sequence.end(),
    [&](PartitionIndex p) { return this->Order.colourOf(p) < colour; });
  std::for_each(first, first + std::ptrdiff_t(this->Order.colourSize(colour)),
    [this](PartitionIndex p)
    {
      if (this->isOwn(p))
      {
        this->release(p);
      }
    });
}

void ReadyPartitions::release(PartitionIndex p)
{
  const std::uint32_t rank = this->Ranks[std::size_t(p)];
  this->ReadyBits[rank / 64].fetch_or(std::uint64_t(1) << rank % 64, std::memory_order_release);
}

PartitionIndex ReadyPartitions::take()
{
  for (int turn = 0; !this->isStopped(); ++turn)
  {
    const PartitionIndex p = this->tryTake();
    if (p >= 0 || this->Left.load(std::memory_order_relaxed) == 0)
    {
      return p;
    }
    waitAWhile(turn);
  }
  return -1;
}

PartitionIndex ReadyPartitions::tryTake()
{
  for (std::size_t i = 0; i < this->ReadyBits.size() && !this->isStopped(); ++i)
  {
    std::atomic<std::uint64_t>& bits = this->ReadyBits[i];
    for (std::uint64_t seen = bits.load(std::memory_order_relaxed); seen != 0;)
    {
      const std::uint64_t lowest = seen & (~seen + 1);
      seen = bits.fetch_and(~lowest, std::memory_order_acquire);
      if ((seen & lowest) != 0)
      {
        this->Left.fetch_sub(1, std::memory_order_relaxed);
        return this->Urgency[64 * i + std::size_t(__builtin_ctzll(lowest))];
      }
    }
  }
  return -1;
}

void ReadyPartitions::finish(PartitionIndex p)
{
  if (this->For == Waits::ForLoad)
  {
    return;
  }
  if (this->For == Waits::ForColour)
  {
    const std::size_t colour = this->Order.colourOf(p);
    const bool isLast = this->LeftInColour[colour].fetch_sub(1, std::memory_order_acq_rel) == 1;
    if (isLast && colour + 1 < this->Order.colourCount())
    {
      this->releaseColour(colour + 1);
    }
    return;
  }
  for (const PartitionIndex q : this->Order.later(p))
  {
    this->countDown(q);
  }
}

void ReadyPartitions::countDown(PartitionIndex p)
{
  if (this->isOwn(p) && this->Awaited[std::size_t(p)].fetch_sub(1, std::memory_order_acq_rel) == 1)
  {
    this->release(p);
  }
}

void ReadyPartitions::stop(const std::exception_ptr& reason)
{
  const std::lock_guard<std::mutex> lock(this->FailureMutex);
  if (reason && !this->Failure)
  {
    this->Failure = reason;
  }
  this->Stopped = true;
}

void runWorkers(ReadyPartitions& ready, int threads, const std::function<void(int thread)>& work)
{
#pragma omp parallel num_threads(threads)
  {
    try
    {
      work(omp_get_thread_num());
    }
    catch (...)
    {
      ready.stop(std::current_exception());
    }
  }
  if (ready.failure())
  {
    std::rethrow_exception(ready.failure());
  }
}

} // namespace tipp

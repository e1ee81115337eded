// SPDX-License-Identifier: BSD-3-Clause
#include "OutOfCore/PieceHelper.h"

#include <chrono>
#include <thread>
#include <vector>

namespace tipp
{

PieceHelper::PieceHelper(
  const PieceWork& work, Postbox& ranks, int threads, std::function<bool(std::int64_t)> progress)
  : Ranks(ranks)
  , Pieces(work)
  , Threads(threads)
  , Progress(std::move(progress))
{
}

void PieceHelper::run()
{
  std::vector<std::thread> threads;
  this->guard(
    [&]
    {
      threads.emplace_back([this] { this->guard([this] { this->loadPieces(); }); });
      for (int i = 0; i < this->Threads; ++i)
      {
        threads.emplace_back([this] { this->guard([this] { this->work(); }); });
      }
      this->Ranks.post(0, ReadyMessage, pack(std::int32_t(this->Threads)));
      this->serve();
    });
  this->stop(nullptr);
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
}

/// This thread alone speaks to other ranks.
void PieceHelper::serve()
{
  constexpr std::chrono::microseconds moment(500);
  while (this->receive())
  {
    this->sendAnswers();
    this->tell();
    std::unique_lock<std::mutex> lock(this->Mutex);
    if (this->Stopped)
    {
      return;
    }
    if (this->Answers.empty())
    {
      this->Changed.wait_for(lock, moment);
    }
  }
}

/// False when there is no more work.
bool PieceHelper::receive()
{
  Message message;
  while (this->Ranks.poll(message))
  {
    if (message.Kind == EndMessage)
    {
      return false;
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (message.Kind == LoadMessage)
    {
      this->Loads.emplace_back();
      unpack(message.Content, this->Loads.back());
    }
    else
    {
      this->Tasks.emplace_back();
      Task& task = this->Tasks.back();
      task.IsInterior = message.Kind == WriteMessage;
      task.IsInterior ? unpack(message.Content, task.Interior)
                      : unpack(message.Content, task.Partition);
    }
    this->Changed.notify_all();
  }
  return true;
}

void PieceHelper::sendAnswers()
{
  std::deque<std::pair<MessageKind, Bytes>> answers;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    answers.swap(this->Answers);
  }
  for (auto& answer : answers)
  {
    this->Ranks.post(0, answer.first, std::move(answer.second));
  }
}

void PieceHelper::tell()
{
  std::int64_t done = 0;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    done = this->PointsDone;
  }
  if (done == this->PointsTold)
  {
    return;
  }
  this->PointsTold = done;
  if (!this->Progress(done))
  {
    throw RankFailure(this->Ranks.rank(), true, "The run was stopped.");
  }
}

void PieceHelper::loadPieces()
{
  for (;;)
  {
    LoadOrder order;
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      this->Changed.wait(lock, [this] { return this->Stopped || !this->Loads.empty(); });
      if (this->Stopped)
      {
        return;
      }
      order = std::move(this->Loads.front());
      this->Loads.pop_front();
    }
    this->Pieces.load(order.Piece, order.Finished);
    this->answer(LoadedMessage, pack(std::int32_t(order.Piece)));
  }
}

void PieceHelper::work()
{
  LoadedPieces::Place place;
  for (;;)
  {
    Task task;
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      this->Changed.wait(lock, [this] { return this->Stopped || !this->Tasks.empty(); });
      if (this->Stopped)
      {
        return;
      }
      task = std::move(this->Tasks.front());
      this->Tasks.pop_front();
    }
    if (task.IsInterior)
    {
      WrittenInterior written;
      written.Piece = task.Interior.Piece;
      written.Growing = this->Pieces.writeInterior(task.Interior);
      this->answer(WrittenMessage, pack(written));
      continue;
    }
    place.Vertices = std::move(task.Partition.Vertices);
    const PartitionResult result = this->Pieces.triangulate(place, task.Partition.Partition);
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->PointsDone += result.Points;
    }
    this->answer(PartitionMessage, pack(result));
  }
}

void PieceHelper::answer(MessageKind kind, Bytes content)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Answers.emplace_back(kind, std::move(content));
  this->Changed.notify_all();
}

void PieceHelper::stop(const std::exception_ptr& reason)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Stopped = true;
  this->Failure = this->Failure ? this->Failure : reason;
  this->Changed.notify_all();
}

void PieceHelper::guard(const std::function<void()>& body)
{
  try
  {
    body();
  }
  catch (...)
  {
    this->stop(std::current_exception());
  }
}

} // namespace tipp

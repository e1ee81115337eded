// SPDX-License-Identifier: BSD-3-Clause
#include "Partitioning/Ranks.h"

#include "Files/IOError.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <exception>
#include <new>
#include <numeric>

namespace tipp
{
namespace
{

// A VTK message holds at most 2^31 - 1 values.
constexpr std::size_t mostAtOnce = std::size_t(1) << 30;

constexpr int reduceTag = 4096;

void broadcastBytes(vtkMultiProcessController* controller, std::string& bytes, int from)
{
  for (std::size_t at = 0; at < bytes.size(); at += mostAtOnce)
  {
    controller->Broadcast(
      bytes.data() + at, vtkIdType(std::min(mostAtOnce, bytes.size() - at)), from);
  }
}

/// Broadcasts the size first, then the bytes of rank `from`.
void broadcastText(vtkMultiProcessController* controller, std::string& text, int from)
{
  vtkTypeInt64 size = vtkTypeInt64(text.size());
  controller->Broadcast(&size, 1, from);
  text.resize(std::size_t(size));
  broadcastBytes(controller, text, from);
}

void sendText(vtkMultiProcessController* controller, const std::string& text, int to)
{
  const vtkTypeInt64 size = vtkTypeInt64(text.size());
  controller->Send(&size, 1, to, reduceTag);
  for (std::size_t at = 0; at < text.size(); at += mostAtOnce)
  {
    controller->Send(
      text.data() + at, vtkIdType(std::min(mostAtOnce, text.size() - at)), to, reduceTag);
  }
}

std::string receiveText(vtkMultiProcessController* controller, int from)
{
  vtkTypeInt64 size = 0;
  controller->Receive(&size, 1, from, reduceTag);
  std::string text(std::size_t(size), '\0');
  for (std::size_t at = 0; at < text.size(); at += mostAtOnce)
  {
    controller->Receive(
      text.data() + at, vtkIdType(std::min(mostAtOnce, text.size() - at)), from, reduceTag);
  }
  return text;
}

} // namespace

int Ranks::count() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

int Ranks::rank() const
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

std::pair<std::int64_t, std::int64_t> Ranks::shareOf(std::int64_t count) const
{
  const std::int64_t each = count / this->count();
  const std::int64_t rest = count % this->count();
  const auto startOf = [&](std::int64_t rank) { return rank * each + std::min(rank, rest); };
  return { startOf(this->rank()), startOf(this->rank() + 1) };
}

void Ranks::attempt(const std::function<void()>& work) const
{
  if (this->count() == 1)
  {
    work();
    return;
  }
  std::string problem;
  int failed = this->count();
  int aborted = this->count();
  try
  {
    work();
  }
  catch (const std::bad_alloc&)
  {
    problem = "there is not enough memory on rank " + std::to_string(this->rank()) +
      "; give less to --memory or use fewer ranks on a machine.";
    failed = this->rank();
  }
  catch (const std::exception& error)
  {
    problem = error.what();
    failed = this->rank();
  }
  catch (const WorkAborted&)
  {
    aborted = this->rank();
  }
  const int mine[2] = { failed, aborted };
  int first[2] = {};
  this->Controller->AllReduce(mine, first, 2, vtkCommunicator::MIN_OP);
  if (first[0] < this->count())
  {
    broadcastText(this->Controller, problem, first[0]);
    throw IOError(problem);
  }
  if (first[1] < this->count())
  {
    throw WorkAborted();
  }
}

std::string Ranks::broadcast(const std::string& bytes) const
{
  std::string all = bytes;
  if (this->count() > 1)
  {
    broadcastText(this->Controller, all, 0);
  }
  return all;
}

std::vector<std::string> Ranks::gather(const std::string& bytes) const
{
  std::vector<std::string> all(std::size_t(this->count()));
  all[std::size_t(this->rank())] = bytes;
  for (int from = 0; this->count() > 1 && from < this->count(); ++from)
  {
    broadcastText(this->Controller, all[std::size_t(from)], from);
  }
  return all;
}

std::string Ranks::reduce(const std::string& bytes,
  const std::function<std::string(const std::string&, const std::string&)>& merge) const
{
  std::string mine = bytes;
  std::exception_ptr failure;
  for (int step = 1; step < this->count(); step *= 2)
  {
    if (this->rank() % (2 * step) != 0)
    {
      sendText(this->Controller, mine, this->rank() - step);
      mine.clear();
      break;
    }
    if (this->rank() + step < this->count())
    {
      const std::string other = receiveText(this->Controller, this->rank() + step);
      try
      {
        mine = failure ? mine : merge(mine, other);
      }
      catch (...)
      {
        // Rethrown later, because the partner waits for a message in any case.
        failure = std::current_exception();
      }
    }
  }
  this->attempt(
    [&]
    {
      if (failure)
      {
        std::rethrow_exception(failure);
      }
    });
  return mine;
}

std::vector<double> Ranks::minimum(const std::vector<double>& values) const
{
  std::vector<double> all = values;
  if (this->count() > 1)
  {
    this->Controller->AllReduce(
      values.data(), all.data(), vtkIdType(values.size()), vtkCommunicator::MIN_OP);
  }
  return all;
}

std::vector<std::int64_t> Ranks::sum(const std::vector<std::int64_t>& values) const
{
  std::vector<vtkTypeInt64> mine(values.begin(), values.end());
  std::vector<vtkTypeInt64> all = mine;
  if (this->count() > 1)
  {
    this->Controller->AllReduce(
      mine.data(), all.data(), vtkIdType(mine.size()), vtkCommunicator::SUM_OP);
  }
  return { all.begin(), all.end() };
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
// What stands for Ranks.cxx in a build without VTK: one rank.
#include "Partitioning/Ranks.h"

namespace tipp
{

int Ranks::count() const
{
  return 1;
}

int Ranks::rank() const
{
  return 0;
}

std::pair<std::int64_t, std::int64_t> Ranks::shareOf(std::int64_t count) const
{
  return { 0, count };
}

void Ranks::attempt(const std::function<void()>& work) const
{
  work();
}

std::string Ranks::broadcast(const std::string& bytes) const
{
  return bytes;
}

std::vector<std::string> Ranks::gather(const std::string& bytes) const
{
  return { bytes };
}

std::string Ranks::reduce(const std::string& bytes,
  const std::function<std::string(const std::string&, const std::string&)>&) const
{
  return bytes;
}

std::vector<double> Ranks::minimum(const std::vector<double>& values) const
{
  return values;
}

std::vector<std::int64_t> Ranks::sum(const std::vector<std::int64_t>& values) const
{
  return values;
}

} // namespace tipp

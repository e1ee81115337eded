// SPDX-License-Identifier: BSD-3-Clause
#include "Loading/VertexLoader.h"

#include "Loading/ArrayFiles.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace tipp
{
namespace
{

constexpr std::array<const char*, 5> names = { "auto", "direct", "fine", "lru", "mmap" };

constexpr std::uint64_t defaultMemoryLimit = std::uint64_t(512) << 20;

/// Mapped files share the memory with the caller's data, so they may take at most half of it.
bool fitsWell(const ArrayFiles& files, std::uint64_t memoryLimit)
{
  return std::uint64_t(files.tuples()) <=
    memoryLimit / 2 / std::max<std::size_t>(files.recordBytes(), 1);
}

} // namespace

VertexLoader::~VertexLoader() = default;

Loader loaderFromName(const std::string& name)
{
  for (std::size_t kind = 0; kind < names.size(); ++kind)
  {
    if (name == names[kind])
    {
      return Loader(kind);
    }
  }
  throw std::invalid_argument(
    "no loader is called '" + name + "'; there are auto, direct, fine, lru and mmap");
}

const char* loaderName(Loader kind)
{
  return names[std::size_t(kind)];
}

std::unique_ptr<VertexLoader> makeVertexLoader(
  std::vector<RawArray> arrays, const LoaderOptions& options)
{
  ArrayFiles files(std::move(arrays));
  const std::uint64_t limit = options.MemoryLimit > 0 ? options.MemoryLimit : defaultMemoryLimit;
  const std::uint64_t record = std::max<std::size_t>(files.recordBytes(), 1);
  std::int64_t m = options.M > 0 ? options.M : std::int64_t(limit / record);
  m = std::max<std::int64_t>(std::min(m, files.tuples()), 1);
  switch (options.Kind)
  {
    case Loader::Direct:
      return makeDirectLoader(std::move(files), m, options.Threads);
    case Loader::Fine:
      return makeFineLoader(std::move(files), m, options.Threads);
    case Loader::Lru:
      return makeLruLoader(std::move(files), m, options.Blocks);
    case Loader::Mmap:
      return makeMmapLoader(std::move(files), options.Threads);
    case Loader::Auto:
      break;
  }
  return fitsWell(files, limit) ? makeMmapLoader(std::move(files), options.Threads)
                                : makeFineLoader(std::move(files), m, options.Threads);
}

} // namespace tipp

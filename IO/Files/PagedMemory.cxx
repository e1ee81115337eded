// SPDX-License-Identifier: BSD-3-Clause
#include "Files/PagedMemory.h"

#include "Files/IOError.h"
#include "Files/OutputFile.h"
#include "Files/Platform.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <new>
#include <set>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace tipp
{
namespace
{

/// Opens a new file without a name. Throws IOError.
int openUnnamed(const std::string& folder)
{
#ifdef O_TMPFILE
  const int unnamed = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (unnamed >= 0)
  {
    return unnamed;
  }
#endif
  std::string path = (std::filesystem::path(folder) / ".tipp-XXXXXX").string();
  const int file = mkstemp(path.data());
  if (file < 0)
  {
    failToWrite(folder);
  }
  unlink(path.c_str());
  fcntl(file, F_SETFD, FD_CLOEXEC);
  return file;
}

} // namespace

/// The mapped ranges of all files.
class PagedMemory::Pages
{
public:
  using Range = std::pair<char*, std::size_t>; ///< begin and bytes

  explicit Pages(std::uint64_t limit)
    : Limit(limit)
  {
  }

  void add(const Range& range)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Ranges.insert(range);
  }
  /// Once this returns, no other method touches the range.
  void remove(const Range& range)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Ranges.erase(range);
  }

  /// Hands all pages back if the limit requires it. Other threads may use them at the same time:
  /// the mappings are shared, so the content is in the system's cache or in the file.
  void keepLimit()
  {
    // Room for what threads touch until this is called again.
    const std::uint64_t room = std::min<std::uint64_t>(this->Limit / 4, std::uint64_t(256) << 20);
    if (residentMemory().Bytes + room <= this->Limit)
    {
      return;
    }
    // While one thread hands pages back, the others wait, and so touch no further ones.
    const std::lock_guard<std::mutex> lock(this->Mutex);
    const ResidentMemory now = residentMemory();
    // If other memory takes up the limit, handing back few pages would cost much and gain little.
    constexpr std::uint64_t least = std::uint64_t(8) << 20;
    this->Kept = std::min(this->Kept, now.Mapped);
    if (now.Bytes + room > this->Limit && now.Mapped > this->Kept + least)
    {
      for (const auto& [begin, bytes] : this->Ranges)
      {
        static_cast<void>(madvise(begin, bytes, MADV_DONTNEED));
      }
      this->Kept = residentMemory().Mapped;
    }
  }

  const std::uint64_t Limit;

private:
  std::mutex Mutex;
  std::set<Range> Ranges;
  std::uint64_t Kept = 0; ///< bytes of files that stayed resident, such as the program's code
};

/// A file without a name, and its mapping.
class PagedMemory::File : public GrowingMemory
{
public:
  File(const std::string& folder, const std::string& advice, std::size_t size,
    std::shared_ptr<Pages> all)
    : Folder(folder)
    , Advice(advice)
    , Descriptor(openUnnamed(folder))
    , Size(size)
    , All(std::move(all))
  {
    void* const memory =
      mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_NORESERVE, this->Descriptor, 0);
    if (memory == MAP_FAILED)
    {
      close(this->Descriptor);
      throw std::bad_alloc();
    }
    this->Memory = static_cast<char*>(memory);
    this->All->add({ this->Memory, size });
  }
  ~File() override
  {
    this->All->remove({ this->Memory, this->Size });
    munmap(this->Memory, this->Size);
    close(this->Descriptor);
  }

  void* data() override { return this->Memory; }
  std::size_t grow(std::size_t bytes) override
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (bytes > this->Usable)
    {
      // In large steps, so that files have few extents.
      constexpr std::size_t least = std::size_t(1) << 20;
      constexpr std::size_t most = std::size_t(256) << 20;
      const std::size_t more = std::clamp(this->Usable / 4, least, most);
      const std::size_t end = std::min(this->Size, std::max(bytes, this->Usable + more));
      this->allocate(end);
      this->Usable = end;
    }
    return this->Usable;
  }

private:
  /// Extends the file to `end` bytes, with all blocks: a write to a page without one would end the
  /// process by SIGBUS once the disk is full.
  void allocate(std::size_t end)
  {
    int problem = EINTR;
    while (problem == EINTR)
    {
      problem = allocateRange(this->Descriptor, off_t(this->Usable), off_t(end - this->Usable));
    }
    if (problem != 0)
    {
      throw IOError(this->Folder,
        std::string("cannot hold the temporary files (") + std::strerror(problem) +
          "); free space on its disk, or " + this->Advice + ".");
    }
  }

  const std::string Folder;
  const std::string Advice;
  const int Descriptor;
  const std::size_t Size;
  const std::shared_ptr<Pages> All;
  char* Memory = nullptr;
  std::mutex Mutex;
  std::size_t Usable = 0; ///< bytes of the file
};

PagedMemory::PagedMemory(const std::string& folder, std::uint64_t limit, std::string advice)
  : Folder(folder.empty() ? "." : folder)
  , Advice(std::move(advice))
  , All(std::make_shared<Pages>(limit))
{
  close(openUnnamed(this->Folder)); // reports a folder that cannot be used at once
  this->Watch = std::thread(
    [this]
    {
      constexpr std::chrono::milliseconds pause(2);
      std::unique_lock<std::mutex> lock(this->Mutex);
      while (!this->End.wait_for(lock, pause, [this] { return this->IsEnding; }))
      {
        this->All->keepLimit();
      }
    });
  this->list();
}

PagedMemory::~PagedMemory()
{
  this->unlist();
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->IsEnding = true;
  }
  this->End.notify_all();
  this->Watch.join();
}

std::uint64_t PagedMemory::limit() const
{
  return this->All->Limit;
}

void PagedMemory::keepLimit()
{
  this->All->keepLimit();
}

std::unique_ptr<PagedMemory> limitedMemory(
  const std::string& folder, std::uint64_t limit, const std::string& advice)
{
  if (limit == 0)
  {
    return nullptr;
  }
  const std::string chosen =
    folder.empty() ? std::filesystem::temp_directory_path().string() : folder;
  return std::make_unique<PagedMemory>(chosen, limit, advice);
}

std::unique_ptr<GrowingMemory> PagedMemory::reserve(std::size_t size)
{
  return std::make_unique<File>(this->Folder, this->Advice, size, this->All);
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippPagedMemory_h
#define tippPagedMemory_h

#include "Arrays/Buffer.h"
#include "Arrays/GrowingMemory.h"
#include "Arrays/ReservedArray.h"
#include "Files/MemoryLimits.h"
#include "vtkTIPPIOModule.h"

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

namespace tipp
{

/// Memory for arrays that may be larger than the machine's. Each array is a mapped file without a
/// name, which vanishes with the array or the process. While the process has more memory resident
/// than a limit, a thread hands pages of the arrays back to the system, which writes them to the
/// files when it needs the memory. Reading or writing such a page brings it back, so programs need
/// not know, but should access the arrays in long runs.
///
/// The limit holds for all memory of the process, but only pages of these arrays are handed back.
class VTKTIPPIO_EXPORT PagedMemory : public LimitedMemory
{
public:
  /// `folder`: where the files are. `limit`: in bytes. `advice`: the end of the message of a full
  /// disk, such as "name another folder by --scratch". Throws IOError if files cannot be made.
  PagedMemory(
    const std::string& folder, std::uint64_t limit, std::string advice = "name another folder");
  /// Pages of arrays that still exist are no longer handed back.
  ~PagedMemory() override;
  PagedMemory(const PagedMemory&) = delete;
  PagedMemory& operator=(const PagedMemory&) = delete;

  /// Hands pages back if more memory than the limit is resident. The thread does so, too, but may
  /// have to wait for a processor: loops over whole arrays call keepMemoryLimits().
  void keepLimit() override;

  std::uint64_t limit() const; ///< in bytes

  /// Returns memory of `size` bytes, whose space on the disk is reserved as it grows, so that a
  /// full disk is an error of grow(), not a crash later. This and grow() throw IOError.
  std::unique_ptr<GrowingMemory> reserve(std::size_t size);

  template <typename T>
  ReservedArray<T> reservedArray(std::size_t most)
  {
    return { most, this->reserve(most * sizeof(T)) };
  }
  /// An array of zeros.
  template <typename T>
  Buffer<T> buffer(std::size_t size)
  {
    if (size == 0)
    {
      return {};
    }
    std::unique_ptr<GrowingMemory> memory = this->reserve(size * sizeof(T));
    memory->grow(size * sizeof(T));
    return { size, std::move(memory) };
  }

private:
  class Pages;
  class File;
  std::string Folder;
  std::string Advice;
  std::shared_ptr<Pages> All; ///< shared with the files
  std::mutex Mutex;
  std::condition_variable End;
  bool IsEnding = false;
  std::thread Watch; ///< last, because it uses the others
};

/// Returns memory with a limit in bytes, as for PagedMemory; null if it is 0. An empty folder is
/// the system's one for temporary files. Throws IOError.
VTKTIPPIO_EXPORT std::unique_ptr<PagedMemory> limitedMemory(
  const std::string& folder, std::uint64_t limit, const std::string& advice);

/// Returns an array in `memory`, or in the process's own memory if it is null. Its values are
/// undefined.
template <typename T>
Buffer<T> bufferIn(PagedMemory* memory, std::size_t size)
{
  return memory ? memory->buffer<T>(size) : Buffer<T>(size);
}

} // namespace tipp

#endif

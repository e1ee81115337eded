// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReservedArray_h
#define tippReservedArray_h

#include "Arrays/GrowingMemory.h"

#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace tipp
{

/// An array of zeros that never moves. It reserves addresses for `most` elements, and takes memory
/// for the elements that are written, so that threads can append while others read. Or it lies in
/// other memory, with the same properties: elements are then used after grow() only.
template <typename T>
class ReservedArray
{
  static_assert(std::is_trivially_copyable_v<T>, "elements begin as zeros and are never destroyed");

public:
  ReservedArray() = default;

  /// Reserves addresses for `most` elements, or for as many as the machine's memory can hold.
  /// Throws std::bad_alloc.
  explicit ReservedArray(std::size_t most)
  {
    const std::size_t machine =
      std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGESIZE));
    this->Most = std::max<std::size_t>(1, std::min(most, machine / sizeof(T)));
    // A limit on addresses (ulimit -v) may allow less.
    for (;; this->Most /= 2)
    {
      void* const memory = mmap(nullptr, this->Most * sizeof(T), PROT_READ | PROT_WRITE,
        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
      if (memory != MAP_FAILED)
      {
        this->Data = static_cast<T*>(memory);
        return;
      }
      if (this->Most * sizeof(T) < LeastBytes)
      {
        throw std::bad_alloc();
      }
    }
  }
  /// Uses other memory, which has addresses for `most` elements.
  ReservedArray(std::size_t most, std::unique_ptr<GrowingMemory> memory)
    : Data(static_cast<T*>(memory->data()))
    , Most(most)
    , Memory(std::move(memory))
  {
  }
  ReservedArray(const ReservedArray&) = delete;
  ReservedArray& operator=(const ReservedArray&) = delete;
  ~ReservedArray()
  {
    if (this->Data && !this->Memory)
    {
      munmap(this->Data, this->Most * sizeof(T));
    }
  }

  std::size_t capacity() const { return this->Most; }
  /// Makes the first `size` elements usable, at most capacity(). Threads may call it at the same
  /// time. Throws what GrowingMemory::grow() throws.
  void grow(std::size_t size)
  {
    if (this->Memory && size > this->Usable.load(std::memory_order_acquire))
    {
      // Another thread's larger number may be replaced; that only costs a further call.
      this->Usable.store(
        this->Memory->grow(size * sizeof(T)) / sizeof(T), std::memory_order_release);
    }
  }
  T* data() { return this->Data; }
  const T* data() const { return this->Data; }
  T& operator[](std::size_t i) { return this->Data[i]; }
  const T& operator[](std::size_t i) const { return this->Data[i]; }

private:
  static constexpr std::size_t LeastBytes = std::size_t(1) << 20;

  T* Data = nullptr;
  std::size_t Most = 0;
  std::unique_ptr<GrowingMemory> Memory; ///< null: addresses of its own
  std::atomic<std::size_t> Usable{ 0 };  ///< elements, in other memory
};

} // namespace tipp

#endif

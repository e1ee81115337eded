// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReservedArray_h
#define tippReservedArray_h

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <unistd.h>
#include <utility>

namespace tipp
{

/// An array of zeros that never moves. It reserves addresses for `most` elements, and takes memory
/// for the elements that are written, so that threads can append while others read.
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
  ReservedArray(ReservedArray&& other) noexcept { *this = std::move(other); }
  ReservedArray& operator=(ReservedArray&& other) noexcept
  {
    std::swap(this->Data, other.Data);
    std::swap(this->Most, other.Most);
    return *this;
  }
  ~ReservedArray()
  {
    if (this->Data)
    {
      munmap(this->Data, this->Most * sizeof(T));
    }
  }

  std::size_t capacity() const { return this->Most; }
  T* data() { return this->Data; }
  const T* data() const { return this->Data; }
  T& operator[](std::size_t i) { return this->Data[i]; }
  const T& operator[](std::size_t i) const { return this->Data[i]; }

private:
  static constexpr std::size_t LeastBytes = std::size_t(1) << 20;

  T* Data = nullptr;
  std::size_t Most = 0;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBuffer_h
#define tippBuffer_h

#include "Arrays/GrowingMemory.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace tipp
{

/// An uninitialised array that owns its memory and can hand it over (see release()). It does not
/// request huge pages: in a virtual machine whose host reclaims free memory, first touching them is
/// slower.
template <typename T>
class Buffer
{
public:
  Buffer() = default;
  explicit Buffer(std::size_t size)
    : Data(allocate(size))
    , Size(size)
  {
  }
  /// An array of `size` zeros in other memory, which has room for them.
  Buffer(std::size_t size, std::unique_ptr<GrowingMemory> memory)
    : Size(size)
  {
    T* const data = static_cast<T*>(memory->data());
    this->Data = std::unique_ptr<T, Free>(data, Free{ std::move(memory) });
  }
  Buffer(Buffer&& other) noexcept
    : Data(std::move(other.Data))
    , Size(std::exchange(other.Size, 0))
  {
  }
  Buffer& operator=(Buffer&& other) noexcept
  {
    this->Data = std::move(other.Data);
    this->Size = std::exchange(other.Size, 0);
    return *this;
  }

  /// Takes over another array's memory. The new size is the number of whole elements that fit into
  /// it.
  template <typename U>
  explicit Buffer(Buffer<U>&& other) noexcept
    : Size(other.size() * sizeof(U) / sizeof(T))
  {
    this->Data.reset(reinterpret_cast<T*>(other.release()));
  }

  T* data() { return this->Data.get(); }
  const T* data() const { return this->Data.get(); }
  /// The memory as values of another type.
  template <typename U>
  U* as()
  {
    return reinterpret_cast<U*>(this->data());
  }
  template <typename U>
  const U* as() const
  {
    return reinterpret_cast<const U*>(this->data());
  }
  std::size_t size() const { return this->Size; }
  bool empty() const { return this->Size == 0; }
  T& operator[](std::size_t i) { return this->Data.get()[i]; }
  const T& operator[](std::size_t i) const { return this->Data.get()[i]; }
  T* begin() { return this->data(); }
  T* end() { return this->data() + this->Size; }
  const T* begin() const { return this->data(); }
  const T* end() const { return this->data() + this->Size; }

  /// Shortens the array to its first `size` elements; the memory stays allocated.
  void truncate(std::size_t size) { this->Size = size; }

  /// Returns the memory, or a copy if the array lies in other memory. The caller owns it and must
  /// free it with free(). Never null, not even for an empty array, since VTK and NumPy reject null
  /// arrays.
  T* release()
  {
    if (this->Data.get_deleter().Memory)
    {
      Buffer copy(this->Size);
      std::copy(this->begin(), this->end(), copy.begin());
      *this = std::move(copy);
    }
    this->Size = 0;
    return this->Data ? this->Data.release() : static_cast<T*>(std::malloc(sizeof(T)));
  }

private:
  struct Free
  {
    std::unique_ptr<GrowingMemory> Memory = nullptr; ///< that of the array; null: malloc's

    void operator()(T* memory)
    {
      if (this->Memory)
      {
        this->Memory.reset();
      }
      else
      {
        std::free(memory);
      }
    }
  };

  static T* allocate(std::size_t size)
  {
    if (size == 0)
    {
      return nullptr;
    }
    if (size > PTRDIFF_MAX / sizeof(T))
    {
      throw std::bad_alloc();
    }
    void* memory = std::malloc(size * sizeof(T));
    return memory ? static_cast<T*>(memory) : throw std::bad_alloc();
  }

  std::unique_ptr<T, Free> Data;
  std::size_t Size = 0;
};

/// An allocator that leaves new elements uninitialised: zeroing them first can cost as much as the
/// work that follows.
template <typename T>
class UninitialisedAllocator : public std::allocator<T>
{
public:
  template <typename U>
  struct rebind
  {
    using other = UninitialisedAllocator<U>;
  };

  template <typename U>
  void construct(U* memory)
  {
    ::new (static_cast<void*>(memory)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* memory, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(memory)) U{ std::forward<Arguments>(arguments)... };
  }
};

/// A vector whose resize() does not initialise elements.
template <typename T>
using Uninitialised = std::vector<T, UninitialisedAllocator<T>>;

} // namespace tipp

#endif

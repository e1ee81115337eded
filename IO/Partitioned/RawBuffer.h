// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippRawBuffer_h
#define tippRawBuffer_h

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>

namespace tipp
{

/// Uninitialised memory from malloc that a VTK array can take ownership of (VTK_DATA_ARRAY_FREE).
class RawBuffer
{
public:
  RawBuffer() = default;
  explicit RawBuffer(std::size_t bytes)
    // malloc(0) may return null, which VTK does not accept as an array.
    : Memory(std::malloc(bytes == 0 ? 1 : bytes))
    , Bytes(bytes)
  {
    if (!this->Memory)
    {
      throw std::bad_alloc();
    }
  }

  char* data() const { return static_cast<char*>(this->Memory.get()); }
  template <typename Value>
  Value* as() const
  {
    return static_cast<Value*>(this->Memory.get());
  }
  std::size_t size() const { return this->Bytes; }

  /// Releases ownership; the caller must free() the memory.
  void* release() { return this->Memory.release(); }

private:
  struct Free
  {
    void operator()(void* memory) const { std::free(memory); }
  };
  std::unique_ptr<void, Free> Memory;
  std::size_t Bytes = 0;
};

} // namespace tipp

#endif

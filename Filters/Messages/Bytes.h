// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippBytes_h
#define tippBytes_h

#include "Triangulation/Buffer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace tipp
{

using Bytes = Buffer<char>;

/// Serialises values and arrays into consecutive bytes.
class ByteWriter
{
public:
  template <typename T>
  void value(const T& v)
  {
    static_assert(std::is_trivially_copyable<T>::value, "values are copied byte by byte");
    this->raw(&v, sizeof(T));
  }

  /// Writes the count, then the values.
  template <typename T>
  void array(const T* values, std::size_t count)
  {
    static_assert(std::is_trivially_copyable<T>::value, "values are copied byte by byte");
    this->value(std::uint64_t(count));
    this->raw(values, count * sizeof(T));
  }
  template <typename T>
  void array(const std::vector<T>& values)
  {
    this->array(values.data(), values.size());
  }
  void text(const std::string& s) { this->array(s.data(), s.size()); }

  void raw(const void* data, std::size_t size)
  {
    const char* begin = static_cast<const char*>(data);
    if (this->Sink && this->Size + size > heldBytes)
    {
      this->flush();
      if (size > heldBytes)
      {
        this->Sink(begin, size);
        return;
      }
    }
    if (size > this->Written.size() - this->Size)
    {
      this->reserve(std::max(this->Size + size, 2 * this->Size));
    }
    std::copy_n(begin, size, this->Written.data() + this->Size);
    this->Size += size;
  }

  /// From now on passes what is written to `sink`, block by block, instead of keeping it in memory.
  /// flush() passes the last block.
  void setSink(std::function<void(const char* data, std::size_t size)> sink)
  {
    this->Sink = std::move(sink);
  }
  void flush()
  {
    this->Sink(this->Written.data(), this->Size);
    this->Size = 0;
  }

  void reserve(std::size_t size)
  {
    if (size > this->Written.size())
    {
      Bytes larger(size);
      std::copy_n(this->Written.data(), this->Size, larger.data());
      this->Written = std::move(larger);
    }
  }
  std::size_t size() const { return this->Size; }
  const char* data() const { return this->Written.data(); }

  Bytes take()
  {
    this->Written.truncate(std::exchange(this->Size, 0));
    return std::move(this->Written);
  }

private:
  static constexpr std::size_t heldBytes = std::size_t(1) << 16;

  Bytes Written; ///< allocated larger than Size
  std::size_t Size = 0;
  std::function<void(const char*, std::size_t)> Sink;
};

/// Reads what a ByteWriter wrote. Throws std::runtime_error instead of reading beyond the end.
class ByteReader
{
public:
  ByteReader(const char* data, std::size_t size)
    : At(data)
    , End(data + size)
  {
  }
  explicit ByteReader(const Bytes& bytes)
    : ByteReader(bytes.data(), bytes.size())
  {
  }

  template <typename T>
  T value()
  {
    T v;
    std::memcpy(&v, this->raw(sizeof(T)), sizeof(T));
    return v;
  }

  template <typename T>
  std::vector<T> array()
  {
    std::vector<T> values;
    this->array(values);
    return values;
  }
  template <typename T>
  void array(std::vector<T>& values)
  {
    const std::uint64_t count = this->value<std::uint64_t>();
    if (count > this->left() / sizeof(T))
    {
      throw std::runtime_error("A message from another rank is damaged: an array ends early.");
    }
    values.resize(count);
    const char* from = this->raw(count * sizeof(T));
    if (count > 0)
    {
      std::memcpy(values.data(), from, count * sizeof(T));
    }
  }
  std::string text()
  {
    const std::vector<char> letters = this->array<char>();
    return std::string(letters.begin(), letters.end());
  }

  const char* raw(std::size_t size)
  {
    if (size > this->left())
    {
      throw std::runtime_error("A message from another rank is damaged: it ends early.");
    }
    const char* begin = this->At;
    this->At += size;
    return begin;
  }

  std::size_t left() const { return static_cast<std::size_t>(this->End - this->At); }

private:
  const char* At;
  const char* End;
};

} // namespace tipp

#endif

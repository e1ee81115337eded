// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippArchive_h
#define tippArchive_h

#include "Arrays/Buffer.h"

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

/// Saves values as consecutive bytes, for messages and scratch files. Numbers and trivially
/// copyable structs are saved as they are in memory, texts and vectors with their size first; any
/// other type needs a function `serialize(archive, value)` that saves its members. LoadArchive
/// restores the values in the same order with the same serialize().
class SaveArchive
{
public:
  template <typename... T>
  void operator()(const T&... values)
  {
    (this->save(values), ...);
  }

  /// Saves the count, then the values, which must be trivially copyable: like a vector of them.
  template <typename T>
  void array(const T* values, std::size_t count)
  {
    static_assert(std::is_trivially_copyable<T>::value, "values are copied byte by byte");
    this->save(std::uint64_t(count));
    this->raw(values, count * sizeof(T));
  }

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

  /// From now on passes the saved bytes to `sink`, block by block, instead of keeping them in
  /// memory. flush() passes the last block.
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

  template <typename T>
  void save(const T& value)
  {
    static_assert(!std::is_pointer<std::decay_t<T>>::value, "what it points to is not saved");
    if constexpr (std::is_trivially_copyable<T>::value)
    {
      this->raw(&value, sizeof(T));
    }
    else
    {
      serialize(*this, const_cast<T&>(value)); // serialize() does not modify the value when saving
    }
  }
  template <typename T>
  void save(const std::vector<T>& values)
  {
    if constexpr (std::is_trivially_copyable<T>::value)
    {
      this->array(values.data(), values.size());
    }
    else
    {
      this->save(std::uint64_t(values.size()));
      for (const T& value : values)
      {
        this->save(value);
      }
    }
  }
  void save(const std::string& text) { this->array(text.data(), text.size()); }

  Bytes Written; ///< may be larger than Size, to avoid reallocation
  std::size_t Size = 0;
  std::function<void(const char*, std::size_t)> Sink;
};

/// Restores what a SaveArchive saved. Throws std::runtime_error instead of reading beyond the end.
class LoadArchive
{
public:
  LoadArchive(const char* data, std::size_t size)
    : At(data)
    , End(data + size)
  {
  }
  explicit LoadArchive(const Bytes& bytes)
    : LoadArchive(bytes.data(), bytes.size())
  {
  }

  template <typename... T>
  void operator()(T&... values)
  {
    (this->load(values), ...);
  }
  template <typename T>
  T get()
  {
    T value{};
    this->load(value);
    return value;
  }

  const char* raw(std::size_t size)
  {
    if (size > this->left())
    {
      throw std::runtime_error("A message or a temporary file is damaged: it ends early.");
    }
    const char* begin = this->At;
    this->At += size;
    return begin;
  }

  std::size_t left() const { return static_cast<std::size_t>(this->End - this->At); }

private:
  template <typename T>
  void load(T& value)
  {
    if constexpr (std::is_trivially_copyable<T>::value)
    {
      std::memcpy(&value, this->raw(sizeof(T)), sizeof(T));
    }
    else
    {
      serialize(*this, value);
    }
  }
  template <typename T>
  void load(std::vector<T>& values)
  {
    if constexpr (std::is_trivially_copyable<T>::value)
    {
      values.resize(this->count(sizeof(T)));
      const char* from = this->raw(values.size() * sizeof(T));
      if (!values.empty())
      {
        std::memcpy(values.data(), from, values.size() * sizeof(T));
      }
    }
    else
    {
      values.clear();
      for (std::uint64_t left = this->get<std::uint64_t>(); left > 0; --left)
      {
        this->load(values.emplace_back());
      }
    }
  }
  void load(std::string& text)
  {
    const std::size_t size = this->count(1);
    text.assign(this->raw(size), size);
  }
  std::size_t count(std::size_t bytesEach)
  {
    const auto count = this->get<std::uint64_t>();
    if (count > this->left() / bytesEach)
    {
      throw std::runtime_error("A message or a temporary file is damaged: an array ends early.");
    }
    return std::size_t(count);
  }

  const char* At;
  const char* End;
};

template <typename... T>
Bytes packed(const T&... values)
{
  SaveArchive archive;
  archive(values...);
  return archive.take();
}

template <typename T>
T unpacked(const Bytes& bytes)
{
  return LoadArchive(bytes).get<T>();
}

} // namespace tipp

#endif

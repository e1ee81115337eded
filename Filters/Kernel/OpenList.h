// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOpenList_h
#define tippOpenList_h

#include "Arrays/Buffer.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tipp
{

/// A list with room behind its end, so that items can be written there before it is known how many
/// of them are added.
template <typename T>
class OpenList
{
public:
  std::size_t size() const { return this->Size; }
  const T& operator[](std::size_t i) const { return this->Items[i]; }
  T* begin() { return this->Items.begin(); }
  T* end() { return this->Items.begin() + this->Size; }
  const T* begin() const { return this->Items.begin(); }
  const T* end() const { return this->Items.begin() + this->Size; }

  void clear() { this->Size = 0; }

  /// Makes room for `count` more items behind the end.
  void makeRoom(std::size_t count)
  {
    if (__builtin_expect(this->Items.size() - this->Size < count, 0))
    {
      this->enlarge(count);
    }
  }

  /// Moves the end, by no more than there is room.
  void setEnd(const T* end) { this->Size = std::size_t(end - this->Items.begin()); }

private:
  [[gnu::noinline]] void enlarge(std::size_t count)
  {
    Buffer<T> more(2 * (this->Size + count));
    std::copy_n(this->Items.begin(), this->Size, more.begin());
    this->Items = std::move(more);
  }

  Buffer<T> Items;
  std::size_t Size = 0;
};

} // namespace tipp

#endif

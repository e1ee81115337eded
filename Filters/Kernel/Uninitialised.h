// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippUninitialised_h
#define tippUninitialised_h

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace tipp
{

/// Leaves value-initialised elements uninitialised: writing zeros first costs as much as the work
/// that follows.
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
  void construct(U* place)
  {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) U{ std::forward<Arguments>(arguments)... };
  }
};

/// A vector whose resize() writes nothing.
template <typename T>
using Uninitialised = std::vector<T, UninitialisedAllocator<T>>;

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSharedMemory_h
#define tippSharedMemory_h

#include "vtkTIPPIOModule.h"

#include <cstddef>

namespace tipp
{

/// Memory that a process and its children share, of a size that may change after they start.
class VTKTIPPIO_EXPORT SharedMemory
{
public:
  /// Throws IOError if the system has no such memory.
  SharedMemory();
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  /// Makes room for `bytes` bytes and returns their address in this process. The content is lost.
  /// Throws IOError.
  char* resize(std::size_t bytes);

  /// Returns the address in this process of the first `bytes` bytes, after another process has
  /// called resize(). Throws IOError if there are less.
  char* map(std::size_t bytes);

private:
  void unmap();

  int Descriptor;
  char* Address = nullptr;
  std::size_t Mapped = 0;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIOError_h
#define tippIOError_h

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <stdexcept>
#include <string>

namespace tipp
{

/// Thrown if a file cannot be read or written. what() is one sentence for the user: which file,
/// where in it, what is wrong and what to do.
class VTKTIPPIO_EXPORT IOError : public std::runtime_error
{
public:
  explicit IOError(const std::string& sentence);
  IOError(const std::string& path, const std::string& problem);
  IOError(const std::string& path, std::int64_t line, const std::string& problem);
  ~IOError() override;

  /// The file or folder; empty if there is none.
  const std::string& path() const { return this->Path; }

private:
  std::string Path;
};

} // namespace tipp

#endif

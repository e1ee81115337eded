// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippIOError_h
#define tippIOError_h

#include "vtkTIPPIOModule.h"

#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>

namespace tipp
{

/// Thrown if a file cannot be read or written. what() is one sentence for the user: which file,
/// where in it, what is wrong and what to do.
class VTKTIPPIO_EXPORT IOError : public std::runtime_error
{
public:
  IOError(const std::string& path, const std::string& problem);
  IOError(const std::string& path, std::int64_t line, const std::string& problem);
  explicit IOError(const std::string& sentence);
  ~IOError() override;

  /// The file or folder; empty if there is none.
  const std::string& path() const { return this->Path; }

private:
  std::string Path;
};

/// Replaces control characters: text from a damaged file may hold any bytes, and a message must
/// stay on one line.
VTKTIPPIO_EXPORT std::string onOneLine(std::string message);

/// Formats text from a file for a message: on one line, and shortened if it is long.
VTKTIPPIO_EXPORT std::string shownText(const std::string& text);

/// Returns `intro` and the quoted names, for a message that lists alternatives: "; there are 'a',
/// 'b'". After twenty names it gives the number of the others. Without names: "; there are none".
VTKTIPPIO_EXPORT std::string listOfNames(
  const std::set<std::string>& names, const std::string& intro);

} // namespace tipp

#endif

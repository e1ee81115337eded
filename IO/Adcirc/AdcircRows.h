// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippAdcircRows_h
#define tippAdcircRows_h

#include "Files/TextFile.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tipp
{

/// The lines of one of ADCIRC's text files, as rows of numbers; what is wrong with one is an
/// IOError that names its line.
class AdcircRows
{
public:
  /// `kind` completes "check that it is ...". Both texts must outlive this.
  AdcircRows(const std::string& path, std::string_view text, std::string kind);

  void skipTitle();
  /// Makes the next line the row, with so many fields at least; `what` is for errors.
  void next(std::size_t fields, const char* what);
  std::size_t fields() const { return this->Row.size(); }
  std::int64_t integer(std::size_t field) const;
  double number(std::size_t field) const;
  /// At most, after the row.
  std::int64_t remainingLines() const
  {
    return this->Total - std::int64_t(this->Lines.lineNumber());
  }

  std::int64_t lineNumber() const { return this->Lines.lineNumber(); }

  [[noreturn]] void fail(const std::string& problem) const;

private:
  const std::string& Path;
  std::string Kind;
  LineReader Lines;
  std::int64_t Total; ///< counted once: files are long
  std::vector<std::string_view> Row;
};

} // namespace tipp

#endif

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

/// Reads the lines of an ADCIRC text file as rows of numbers; errors are IOErrors that name the
/// line.
class AdcircRows
{
public:
  /// `kind` completes "check that it is ...". `path` and `text` must outlive this object.
  AdcircRows(const std::string& path, std::string_view text, std::string kind);

  void skipTitle();
  /// Reads the next line, which must have at least `fields` fields; `what` is for errors.
  void next(std::size_t fields, const char* what);
  std::size_t fields() const { return this->Row.size(); }
  std::int64_t integer(std::size_t field) const;
  double number(std::size_t field) const;
  /// An upper bound of the number of lines after the row.
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
  std::int64_t Total; ///< computed once, because files are long
  std::vector<std::string_view> Row;
};

} // namespace tipp

#endif

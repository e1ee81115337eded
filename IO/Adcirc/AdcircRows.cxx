// SPDX-License-Identifier: BSD-3-Clause
#include "Adcirc/AdcircRows.h"

#include "Files/IOError.h"

#include <utility>

namespace tipp
{

AdcircRows::AdcircRows(const std::string& path, std::string_view text, std::string kind)
  : Path(path)
  , Kind(std::move(kind))
  , Lines(text)
  , Total(this->Lines.remainingLines())
{
}

void AdcircRows::skipTitle()
{
  std::string_view title;
  this->Lines.next(title);
}

void AdcircRows::next(std::size_t fields, const char* what)
{
  std::string_view line;
  if (!this->Lines.next(line))
  {
    this->fail(std::string("the file ends before ") + what + "; copy it again.");
  }
  splitFields(line, ' ', this->Row);
  if (this->Row.size() < fields)
  {
    this->fail(
      std::string("has too few numbers for ") + what + "; check that it is " + this->Kind + ".");
  }
}

std::int64_t AdcircRows::integer(std::size_t field) const
{
  std::int64_t value = 0;
  if (!parseInteger(this->Row[field], value))
  {
    this->fail("'" + std::string(this->Row[field]) + "' is not an integer; correct the line.");
  }
  return value;
}

double AdcircRows::number(std::size_t field) const
{
  double value = 0;
  if (!parseNumber(this->Row[field], value))
  {
    this->fail("'" + std::string(this->Row[field]) + "' is not a number; correct the line.");
  }
  return value;
}

void AdcircRows::fail(const std::string& problem) const
{
  throw IOError(this->Path, this->Lines.lineNumber(), problem);
}

} // namespace tipp

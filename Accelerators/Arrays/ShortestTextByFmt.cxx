// SPDX-License-Identifier: BSD-3-Clause
// Writes the same texts as ShortestText.cxx for the Python wheel, which contains fmt in any case:
// the tables of std::to_chars() would be 3 % of the wheel.
#include "Arrays/ShortestText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tipp
{
namespace
{

/// The shortest digits of a finite number other than 0, and the power of ten of the first one.
struct Digits
{
  NumberText Text;
  int Count = 0;
  int Exponent = 0;

  explicit Digits(double size)
  {
    NumberText shortest;
    char* const end = fmt::format_to_n(shortest.data(), shortest.size() - 1, "{}", size).out;
    *end = '\0';
    char* const mark = std::find(shortest.data(), end, 'e');
    char* const point = std::find(shortest.data(), mark, '.');
    int exponent = int(point - shortest.data()); // of the first character
    for (const char* at = shortest.data(); at < mark; ++at)
    {
      exponent -= at == point ? 0 : 1;
      if (*at != '.' && (this->Count > 0 || *at != '0'))
      {
        this->Exponent = this->Count == 0 ? exponent : this->Exponent;
        this->Text[std::size_t(this->Count++)] = *at;
      }
    }
    this->Exponent += mark < end ? std::atoi(mark + 1) : 0;
    while (this->Count > 1 && this->Text[std::size_t(this->Count) - 1] == '0')
    {
      --this->Count;
    }
  }

  int scientificLength() const
  {
    return this->Count + (this->Count > 1 ? 1 : 0) + (std::abs(this->Exponent) < 100 ? 4 : 5);
  }

  int fixedLength() const
  {
    return this->Exponent < 0            ? 1 - this->Exponent + this->Count
      : this->Exponent < this->Count - 1 ? this->Count + 1
                                         : this->Exponent + 1;
  }
};

char* append(char* to, const char* text, int count)
{
  std::memcpy(to, text, std::size_t(count));
  return to + count;
}

char* writeScientific(const Digits& digits, char* to)
{
  *to++ = digits.Text[0];
  if (digits.Count > 1)
  {
    *to++ = '.';
    to = append(to, digits.Text.data() + 1, digits.Count - 1);
  }
  return to + std::snprintf(to, 6, "e%+03d", digits.Exponent);
}

char* writeFixed(const Digits& digits, double size, char* to)
{
  if (digits.Exponent < 0)
  {
    to = append(to, "0.", 2);
    to = std::fill_n(to, -digits.Exponent - 1, '0');
    return append(to, digits.Text.data(), digits.Count);
  }
  if (digits.Exponent >= digits.Count - 1)
  {
    // A whole number has all of its digits.
    constexpr std::size_t most = 25;
    return to + std::snprintf(to, most, "%.0f", size);
  }
  to = append(to, digits.Text.data(), digits.Exponent + 1);
  *to++ = '.';
  return append(to, digits.Text.data() + digits.Exponent + 1, digits.Count - digits.Exponent - 1);
}

char* write(NumberText& text, double value, bool isScientific)
{
  char* to = text.data();
  if (std::signbit(value))
  {
    *to++ = '-';
  }
  const double size = std::fabs(value);
  if (!std::isfinite(size))
  {
    return append(to, std::isnan(size) ? "nan" : "inf", 3);
  }
  if (size == 0)
  {
    return isScientific ? append(to, "0e+00", 5) : append(to, "0", 1);
  }
  const Digits digits(size);
  return isScientific || digits.scientificLength() < digits.fixedLength()
    ? writeScientific(digits, to)
    : writeFixed(digits, size, to);
}

} // namespace

char* writeShortest(NumberText& text, double value)
{
  return write(text, value, false);
}

char* writeShortestScientific(NumberText& text, double value)
{
  return write(text, value, true);
}

} // namespace tipp

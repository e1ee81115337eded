// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSelafinText_h
#define tippSelafinText_h

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace tipp
{
namespace test
{

/// Makes SELAFIN files of four nodes and two triangles or a quadrilateral.
struct SelafinText
{
  bool IsBig = true;
  bool IsDouble = false;
  bool HasQuadrilaterals = false;
  bool HasDate = true;
  std::int32_t Planes = 0;
  std::vector<double> Times{ 0, 60 };

  template <typename T>
  std::string bytes(T value) const
  {
    std::string text(reinterpret_cast<const char*>(&value), sizeof value);
    if (this->IsBig)
    {
      std::reverse(text.begin(), text.end());
    }
    return text;
  }
  std::string record(const std::string& content) const
  {
    const std::string length = this->bytes(std::uint32_t(content.size()));
    return length + content + length;
  }
  std::string integers(const std::vector<std::int32_t>& values) const
  {
    std::string text;
    for (const std::int32_t value : values)
    {
      text += this->bytes(value);
    }
    return this->record(text);
  }
  std::string reals(const std::vector<double>& values) const
  {
    std::string text;
    for (const double value : values)
    {
      text += this->IsDouble ? this->bytes(value) : this->bytes(float(value));
    }
    return this->record(text);
  }

  std::string text() const
  {
    std::string title(80, ' ');
    title.replace(72, 8, this->IsDouble ? "SERAFIND" : "SERAFIN ");
    std::string all = this->record(title) + this->integers({ 2, 0 });
    all += this->record("WATER DEPTH     M               ");
    all += this->record("VELOCITY U      M/S             ");
    all += this->integers({ 1, 0, 1000, 2000, 0, 0, this->Planes, 0, 0, this->HasDate ? 1 : 0 });
    all += this->HasDate ? this->integers({ 2008, 9, 1, 6, 30, 0 }) : "";
    all += this->HasQuadrilaterals
      ? this->integers({ 1, 4, 4, 1 }) + this->integers({ 1, 2, 3, 4 })
      : this->integers({ 2, 4, 3, 1 }) + this->integers({ 1, 2, 3, 1, 3, 4 });
    all += this->integers({ 1, 2, 3, 4 });
    all += this->reals({ 0, 1, 1, 0 }) + this->reals({ 0, 0, 1, 1 });
    for (const double time : this->Times)
    {
      all += this->reals({ time }) + this->reals({ 1 + time, 2, 3, 4 }) +
        this->reals({ 5, 6, 7, 8 + time });
    }
    return all;
  }
};

} // namespace test
} // namespace tipp

#endif

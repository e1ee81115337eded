// SPDX-License-Identifier: BSD-3-Clause
#include "Npy/NpyHeader.h"

#include <charconv>

namespace tipp
{
namespace
{

class Scanner
{
public:
  explicit Scanner(std::string_view text)
    : Text(text)
  {
  }

  bool take(std::string_view token)
  {
    this->skipSpace();
    if (this->Text.substr(0, token.size()) != token)
    {
      return false;
    }
    this->Text.remove_prefix(token.size());
    return true;
  }

  bool takeString(std::string& value)
  {
    const char* const quote = this->take("'") ? "'" : (this->take("\"") ? "\"" : nullptr);
    const std::size_t end = quote ? this->Text.find(quote) : std::string_view::npos;
    if (end == std::string_view::npos)
    {
      return false;
    }
    value = this->Text.substr(0, end);
    this->Text.remove_prefix(end + 1);
    return true;
  }

  bool takeBool(bool& value)
  {
    value = this->take("True");
    return value || this->take("False");
  }

  bool takeExtent(std::int64_t& value)
  {
    this->skipSpace();
    const char* const end = this->Text.data() + this->Text.size();
    const auto [stop, error] = std::from_chars(this->Text.data(), end, value);
    if (error != std::errc() || value < 0)
    {
      return false;
    }
    this->Text.remove_prefix(std::size_t(stop - this->Text.data()));
    return true;
  }

  bool takeShape(std::vector<std::int64_t>& shape)
  {
    if (!this->take("("))
    {
      return false;
    }
    while (!this->take(")"))
    {
      shape.emplace_back();
      if (!this->takeExtent(shape.back()))
      {
        return false;
      }
      if (!this->take(","))
      {
        return this->take(")");
      }
    }
    return true;
  }

  bool atEnd()
  {
    this->skipSpace();
    return this->Text.empty();
  }

private:
  void skipSpace()
  {
    const std::size_t start = this->Text.find_first_not_of(" \t\r\n");
    this->Text.remove_prefix(start == std::string_view::npos ? this->Text.size() : start);
  }

  std::string_view Text;
};

} // namespace

std::optional<NpyHeader> parseNpyHeader(std::string_view text)
{
  Scanner scanner(text);
  NpyHeader header;
  bool descr = false;
  bool order = false;
  bool shape = false;
  if (!scanner.take("{"))
  {
    return std::nullopt;
  }
  while (!scanner.take("}"))
  {
    std::string key;
    if (!scanner.takeString(key) || !scanner.take(":"))
    {
      return std::nullopt;
    }
    const bool good = (key == "descr" && !descr && (descr = scanner.takeString(header.Descr))) ||
      (key == "fortran_order" && !order && (order = scanner.takeBool(header.FortranOrder))) ||
      (key == "shape" && !shape && (shape = scanner.takeShape(header.Shape)));
    if (!good || (!scanner.take(",") && !scanner.take("}")))
    {
      return std::nullopt;
    }
    if (descr && order && shape)
    {
      scanner.take("}");
      return scanner.atEnd() ? std::make_optional(header) : std::nullopt;
    }
  }
  return std::nullopt;
}

} // namespace tipp

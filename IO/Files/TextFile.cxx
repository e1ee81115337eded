// SPDX-License-Identifier: BSD-3-Clause
#include "Files/TextFile.h"

#include "Arrays/ShortestText.h"
#include "Files/Formats.h"
#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/Platform.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace tipp
{
namespace
{

[[noreturn]] void failToCopy()
{
  throw IOError("The standard input cannot be copied to a temporary file (" +
    std::string(std::strerror(errno)) + "); name a file instead.");
}

/// Returns the descriptor of a file without a name, which goes away with the process.
int copyStandardInput()
{
  const char* const folder = std::getenv("TMPDIR");
  std::string path = std::string(folder && *folder ? folder : "/tmp") + "/tipp-XXXXXX";
  const int file = mkstemp(path.data());
  if (file < 0)
  {
    failToCopy();
  }
  unlink(path.c_str());
  std::vector<char> block(std::size_t(1) << 20);
  for (std::uint64_t size = 0;;)
  {
    const ssize_t got = read(STDIN_FILENO, block.data(), block.size());
    if (got == 0)
    {
      return file;
    }
    if (got < 0 && errno != EINTR)
    {
      failToCopy();
    }
    const std::size_t bytes = got > 0 ? std::size_t(got) : 0;
    writeFully(file, "The copy of the standard input in " + path, size, block.data(), bytes);
    size += bytes;
  }
}

} // namespace

std::string openablePath(const std::string& path)
{
  if (path != "-")
  {
    return path;
  }
  static const int copy = copyStandardInput();
  return pathOfDescriptor(copy);
}

namespace
{

bool isBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimBlanks(std::string_view text)
{
  while (!text.empty() && isBlank(text.front()))
  {
    text.remove_prefix(1);
  }
  while (!text.empty() && isBlank(text.back()))
  {
    text.remove_suffix(1);
  }
  return text;
}

/// The length of the byte order mark at the beginning of a text; 0: there is none.
std::size_t sizeOfMark(std::string_view text)
{
  constexpr std::string_view mark = "\xef\xbb\xbf";
  return text.substr(0, mark.size()) == mark ? mark.size() : 0;
}

/// A line without the \r of \r\n.
std::string_view withoutReturn(std::string_view line)
{
  return !line.empty() && line.back() == '\r' ? line.substr(0, line.size() - 1) : line;
}

/// The index after the text in double quotes that begins at `at`, in which two quotes are one; npos
/// if the quote does not end.
std::size_t endOfQuoted(std::string_view line, std::size_t at)
{
  for (std::size_t end = line.find('"', at + 1); end != std::string_view::npos;)
  {
    if (end + 1 == line.size() || line[end + 1] != '"')
    {
      return end + 1;
    }
    end = line.find('"', end + 2);
  }
  return std::string_view::npos;
}

bool splitAtBlanks(std::string_view line, std::vector<std::string_view>& fields)
{
  bool isClosed = true;
  std::size_t at = 0;
  while (at < line.size())
  {
    while (at < line.size() && isBlank(line[at]))
    {
      ++at;
    }
    const std::size_t start = at;
    if (at < line.size() && line[at] == '"')
    {
      const std::size_t end = endOfQuoted(line, at);
      isClosed = isClosed && end != std::string_view::npos;
      at = std::min(end, line.size());
    }
    while (at < line.size() && !isBlank(line[at]))
    {
      ++at;
    }
    if (at > start)
    {
      fields.push_back(line.substr(start, at - start));
    }
  }
  return isClosed;
}

/// Throws IOError unless `text`, the beginning of a file, may be text. `path` is "-" for the
/// standard input.
void requireText(const std::string& path, std::string_view text)
{
  constexpr std::string_view signatures[][2] = { { "\x1f\x8b", "gzip" },
    { "\xfd"
      "7zXZ",
      "xz" },
    { "\x28\xb5\x2f\xfd", "zstd" } };
  for (const auto& [signature, program] : signatures)
  {
    if (text.substr(0, signature.size()) == signature)
    {
      throw IOError(path,
        "is compressed; decompress it first, as in \"" + std::string(program) +
          " -dc FILE | tipp ...\", or give it the extension of such files.");
    }
  }
  if (text.substr(0, 2) == "\xff\xfe" || text.substr(0, 2) == "\xfe\xff")
  {
    throw IOError(path, "is UTF-16 text; save it as UTF-8, as with 'iconv -f UTF-16 -t UTF-8'.");
  }
  if (text.substr(0, 4) == "\x89HDF")
  {
    throw IOError(path,
      "is not text but HDF5, as NetCDF 4 and VTK's .vtkhdf are; give it the extension of these.");
  }
  if (text.size() > 3 && text.substr(0, 3) == "CDF" &&
    (text[3] == 1 || text[3] == 2 || text[3] == 5))
  {
    throw IOError(path, "is not text but NetCDF; give it the extension .nc.");
  }
  if (text.substr(0, 4096).find('\0') != std::string_view::npos)
  {
    const std::string problem = "is not a text file; give it the extension of what it is.";
    if (formatOf(path, Use::Points | Use::Triangles))
    {
      throw IOError(path, problem);
    }
    refuseKind(path, problem);
  }
}

} // namespace

std::string readTextFile(const std::string& path)
{
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
    std::fopen(path.c_str(), "rb"), std::fclose);
  if (!file)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  std::string text;
  std::size_t size = 0;
  std::size_t got = 0;
  do
  {
    text.resize(std::max<std::size_t>(std::size_t(1) << 20, 2 * size));
    got = std::fread(&text[size], 1, text.size() - size, file.get());
    size += got;
  } while (size == text.size());
  if (std::ferror(file.get()))
  {
    throw IOError(path, std::string("cannot be read (") + std::strerror(errno) + ").");
  }
  text.resize(size);
  requireText(path, text);
  return text;
}

LineReader::LineReader(std::string_view text)
  : Rest(text.substr(sizeOfMark(text)))
{
}

bool LineReader::next(std::string_view& line)
{
  if (this->Rest.empty())
  {
    return false;
  }
  const std::size_t end = std::min(this->Rest.find('\n'), this->Rest.size());
  line = withoutReturn(this->Rest.substr(0, end));
  this->Rest.remove_prefix(std::min(end + 1, this->Rest.size()));
  ++this->Number;
  return true;
}

std::string lowerCase(std::string_view text)
{
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

namespace
{

/// The length of the UTF-8 character at the beginning of a text; 0: there is none.
std::size_t utf8Length(std::string_view text)
{
  const auto byte = [&](std::size_t i)
  { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  const std::size_t length = first < 0x80 ? 1
    : first >= 0xC2 && first < 0xE0       ? 2
    : first >= 0xE0 && first < 0xF0       ? 3
    : first >= 0xF0 && first < 0xF5       ? 4
                                          : 0;
  for (std::size_t i = 1; i < length; ++i)
  {
    if (byte(i) < 0x80 || byte(i) > 0xBF)
    {
      return 0;
    }
  }
  // Not overlong, no surrogates, not beyond U+10FFFF.
  const bool isBad = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F) ||
    (first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F);
  return isBad ? 0 : length;
}

} // namespace

std::string utf8Of(std::string_view text)
{
  bool isUtf8 = true;
  for (std::size_t at = 0; at < text.size() && isUtf8;)
  {
    const std::size_t length = utf8Length(text.substr(at));
    isUtf8 = length > 0;
    at += length;
  }
  std::string result;
  for (const char c : text)
  {
    const auto code = static_cast<unsigned char>(c);
    if (isUtf8 || code < 0x80)
    {
      result += c;
      continue;
    }
    result += char(0xC0 | code >> 6);
    result += char(0x80 | (code & 0x3F));
  }
  return result;
}

std::string_view trimField(std::string_view field)
{
  field = trimBlanks(field);
  if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
  {
    field = trimBlanks(field.substr(1, field.size() - 2));
  }
  return field;
}

namespace
{

/// Parses a number of digits and at most one decimal point, up to 2^53 without the point. Such a
/// number is a quotient of two integers that doubles hold, and division rounds correctly: Clinger,
/// How to read floating point numbers accurately, 1990. Returns false for all other fields.
bool parseShortNumber(std::string_view field, double& value)
{
  constexpr std::size_t mostDigits = 15; // 10^15 < 2^53
  constexpr std::array<double, mostDigits + 1> powers = { 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7,
    1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15 };
  const bool isNegative = !field.empty() && field.front() == '-';
  field.remove_prefix(isNegative ? 1 : 0);
  if (field.empty() || field.size() > mostDigits + 1)
  {
    return false;
  }
  std::uint64_t number = 0;
  std::size_t digits = 0;
  std::size_t afterPoint = 0; // the point itself is counted
  for (const char c : field)
  {
    const unsigned digit = static_cast<unsigned char>(c) - unsigned('0');
    if (digit > 9 && (c != '.' || afterPoint > 0))
    {
      return false;
    }
    const bool isDigit = digit <= 9;
    number = isDigit ? 10 * number + digit : number;
    digits += isDigit ? 1 : 0;
    afterPoint += !isDigit || afterPoint > 0 ? 1 : 0;
  }
  if (digits == 0 || digits > mostDigits)
  {
    return false;
  }
  const double quotient = double(number) / powers[afterPoint > 0 ? afterPoint - 1 : 0];
  value = isNegative ? -quotient : quotient;
  return true;
}

} // namespace

bool parseNumber(std::string_view field, double& value)
{
  if (parseShortNumber(field, value))
  {
    return true;
  }
  field = trimField(field);
  if (field.size() > 1 && field[0] == '+' && field[1] != '-')
  {
    field.remove_prefix(1);
  }
  const char* const end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(field.data(), end, value);
  if (error == std::errc::result_out_of_range && stop == end)
  {
    value = std::strtod(std::string(field).c_str(), nullptr); // rounds to 0 or infinity
    return true;
  }
  return error == std::errc() && stop == end;
}

bool parseInteger(std::string_view field, std::int64_t& value)
{
  const auto number = wholeNumber<std::int64_t>(trimField(field));
  value = number.value_or(value);
  return number.has_value();
}

bool parseWhole(std::string_view field, std::int64_t& value)
{
  if (parseInteger(field, value))
  {
    return true;
  }
  double number = 0;
  const bool isWhole =
    parseNumber(field, number) && std::floor(number) == number && std::fabs(number) <= 0x1p53;
  value = isWhole ? std::int64_t(number) : 0;
  return isWhole;
}

bool splitFields(std::string_view line, char delimiter, std::vector<std::string_view>& fields)
{
  fields.clear();
  if (delimiter == ' ')
  {
    return splitAtBlanks(line, fields);
  }
  bool isClosed = true;
  std::size_t start = 0;
  while (true)
  {
    std::size_t from = start;
    while (from < line.size() && isBlank(line[from]) && line[from] != delimiter)
    {
      ++from;
    }
    if (from < line.size() && line[from] == '"')
    {
      const std::size_t end = endOfQuoted(line, from);
      isClosed = isClosed && end != std::string_view::npos;
      from = std::min(end, line.size());
    }
    const std::size_t end = std::min(line.find(delimiter, from), line.size());
    fields.push_back(line.substr(start, end - start));
    if (end == line.size())
    {
      return isClosed;
    }
    start = end + 1;
  }
}

NumberRows::NumberRows(const std::string& path, std::string kind, char comment)
  : Path(path)
  , Kind(std::move(kind))
  , Comment(comment)
  , Text(readTextFile(path))
  , Lines(this->Text)
  , Total(1 + std::count(this->Text.begin(), this->Text.end(), '\n'))
{
}

void NumberRows::next(std::size_t fields, const char* what)
{
  if (!this->nextIfAny())
  {
    this->fail(std::string("the file ends before ") + what + "; copy it again.");
  }
  this->require(fields, what);
}

bool NumberRows::nextIfAny()
{
  std::string_view line;
  do
  {
    if (!this->Lines.next(line))
    {
      return false;
    }
    splitFields(this->Comment ? line.substr(0, line.find(this->Comment)) : line, ' ', this->Row);
  } while (this->Comment && this->Row.empty());
  return true;
}

void NumberRows::require(std::size_t fields, const char* what) const
{
  if (this->Row.size() < fields)
  {
    this->fail(
      std::string("has too few numbers for ") + what + "; check that it is " + this->Kind + ".");
  }
}

double NumberRows::number(std::size_t field) const
{
  double value = 0;
  if (!parseNumber(this->Row[field], value))
  {
    this->fail("'" + std::string(this->Row[field]) + "' is not a number; correct the line.");
  }
  return value;
}

std::int64_t NumberRows::integer(std::size_t field) const
{
  std::int64_t value = 0;
  if (!parseWhole(this->Row[field], value))
  {
    this->fail("'" + std::string(this->Row[field]) + "' is not an integer; correct the line.");
  }
  return value;
}

void NumberRows::fail(const std::string& problem) const
{
  throw IOError(this->Path, this->Lines.lineNumber(), problem);
}

namespace
{

/// The program that decompresses a file to its standard output; empty if the file is not
/// compressed.
std::string decompressorOf(const std::string& path)
{
  const std::string extension = extensionOf(path);
  return extension == ".gz" ? "gzip"
    : extension == ".xz"    ? "xz"
    : extension == ".zst"   ? "zstd"
                            : "";
}

/// Quotes a path for the shell.
std::string quoted(const std::string& path)
{
  std::string word = "'";
  for (const char c : path)
  {
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return word + "'";
}

} // namespace

FileLines::FileLines(const std::string& path, std::size_t blockBytes)
  : Path(path)
  , Program(decompressorOf(path))
  , File(std::fopen(openablePath(path).c_str(), "rb"), std::fclose)
  , BlockBytes(blockBytes)
{
  if (!this->File)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  if (!this->Program.empty())
  {
    const std::string command =
      "exec " + this->Program + " -dc < " + quoted(path) + " 2> /dev/null";
    this->File = { popen(command.c_str(), "r"), pclose };
    if (!this->File)
    {
      throw IOError(path, "cannot be decompressed, since no process can be started.");
    }
  }
  this->readMore();
  requireText(this->Path, { this->Buffer.data(), this->End });
  struct stat status = {};
  if (this->End > 0 && this->File && fstat(fileno(this->File.get()), &status) == 0 &&
    S_ISREG(status.st_mode))
  {
    const auto lines =
      std::count(this->Buffer.begin(), this->Buffer.begin() + std::ptrdiff_t(this->End), '\n');
    this->Expected =
      std::int64_t(double(lines + 1) * std::max(1.0, double(status.st_size) / double(this->End)));
  }
  const std::string_view begin(this->Buffer.data(), this->End);
  this->Begin = sizeOfMark(begin);
  // Old Macintosh files end lines with \r alone.
  const std::size_t ending = begin.find_first_of("\r\n");
  if (ending + 1 < begin.size() && begin[ending] == '\r' && begin.find('\n') == begin.npos)
  {
    this->LineEnd = '\r';
  }
}

/// Appends the next bytes to the buffer. Returns false at the end.
bool FileLines::readMore()
{
  constexpr std::size_t longest = std::size_t(64) << 20;
  if (!this->File)
  {
    return false;
  }
  const std::size_t left = this->End - this->Begin;
  if (left > longest)
  {
    throw IOError(
      this->Path, this->Number + 1, "is longer than any line of points; check the file.");
  }
  std::copy(this->Buffer.begin() + std::ptrdiff_t(this->Begin),
    this->Buffer.begin() + std::ptrdiff_t(this->End), this->Buffer.begin());
  this->Buffer.resize(std::max(this->Buffer.size(), std::max(left, this->BlockBytes) + left));
  const std::size_t got =
    std::fread(&this->Buffer[left], 1, this->Buffer.size() - left, this->File.get());
  if (std::ferror(this->File.get()))
  {
    throw IOError(this->Path, std::string("cannot be read (") + std::strerror(errno) + ").");
  }
  this->Begin = 0;
  this->End = left + got;
  if (got == 0 && !this->Program.empty())
  {
    this->endDecompression();
  }
  return got > 0;
}

void FileLines::endDecompression()
{
  constexpr int notFound = 127; // the shell's exit status
  const int status = pclose(this->File.release());
  if (status != 0)
  {
    const bool isMissing = WIFEXITED(status) && WEXITSTATUS(status) == notFound;
    throw IOError(this->Path,
      isMissing ? "needs the program " + this->Program + ", which is not there; install it."
                : "cannot be decompressed by " + this->Program + "; copy it again.");
  }
}

bool FileLines::next(std::string_view& line)
{
  std::size_t looked = 0; // bytes already searched for an end of line
  for (;;)
  {
    const std::string_view rest(this->Buffer.data() + this->Begin, this->End - this->Begin);
    std::size_t end = rest.find(this->LineEnd, looked);
    if (end == std::string_view::npos)
    {
      looked = rest.size();
      if (this->readMore())
      {
        continue;
      }
      if (looked == 0)
      {
        return false;
      }
      end = looked; // the last line has no end of line
    }
    // readMore() may have moved the buffer.
    line = withoutReturn({ this->Buffer.data() + this->Begin, end });
    this->Begin = std::min(this->Begin + end + 1, this->End);
    ++this->Number;
    return true;
  }
}

std::string shortText(double value)
{
  NumberText text;
  const char* const end = writeShortest(text, value);
  return std::string(text.data(), std::size_t(end - text.data()));
}

std::string exactText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfFile.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/RawArray.h"
#include "Files/TextFile.h"
#include "Netcdf/ClassicHeader.h"
#include "Netcdf/NetcdfValues.h"
#include "Ranks/Archive.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <utility>

#include <unistd.h>

namespace tipp
{
namespace
{

std::string textOf(const Bytes& bytes)
{
  return { bytes.data(), bytes.size() };
}

/// Answers requests in the helper: an empty one opens the file, others are a part and its bytes.
HelperProcess::Answer answerer(const std::string& path, const std::string& group)
{
  const auto library = std::make_shared<NetcdfLibrary>();
  return [library, path, group](const std::string& request, SharedMemory& memory) -> std::string
  {
    if (request.empty())
    {
      return textOf(packed(library->open(path, group)));
    }
    LoadArchive archive(request.data(), request.size());
    NetcdfPart part;
    std::uint64_t bytes = 0;
    archive(part, bytes);
    // Where chunks hold all steps of a few nodes, a step is all of the file decompressed.
    HelperProcess::limitWork(600);
    library->read(part, memory.resize(std::size_t(bytes)));
    return {};
  };
}

bool isNumber(const NetcdfVariable& variable)
{
  return variable.Type.has_value();
}

std::size_t valueBytes(const NetcdfVariable& variable)
{
  return isNumber(variable) ? scalarSize(*variable.Type) : 1;
}

/// Throws unless the file is of one of NetCDF's formats or, with `hasGroups`, of HDF5; those based
/// on HDF5 may have other bytes before.
void checkBeginning(const std::string& path, bool hasGroups)
{
  const InputFile file(path);
  constexpr std::size_t size = 8;
  char begin[size] = {};
  file.read(0, begin, std::size_t(std::min<std::uint64_t>(size, file.size())));
  if (!hasGroups && std::memcmp(begin, "CDF", 3) == 0)
  {
    checkClassicFile(file);
    return;
  }
  bool isHdf = false;
  for (std::uint64_t at = 0; !isHdf && at + size <= file.size(); at = at == 0 ? 512 : 2 * at)
  {
    file.read(at, begin, size);
    isHdf = std::memcmp(begin, "\211HDF\r\n\032\n", size) == 0;
  }
  if (!isHdf)
  {
    throw IOError(path,
      std::string("is not ") + (hasGroups ? "an HDF5" : "a NetCDF") +
        " file; copy it again, or check its name.");
  }
}

/// Throws if the parts of the content do not fit together.
void checkContent(const std::string& path, const NetcdfContent& content)
{
  for (const NetcdfVariable& variable : content.Variables)
  {
    for (const int dimension : variable.Dimensions)
    {
      if (dimension < 0 || std::size_t(dimension) >= content.Dimensions.size() ||
        content.size(dimension) < 0)
      {
        throw IOError(
          path, "is damaged: '" + variable.Name + "' has an unknown dimension; copy it again.");
      }
    }
  }
}

} // namespace

NetcdfFile::NetcdfFile(const std::string& path, const std::string& group)
  : Path(path)
  , Group(group)
{
  checkBeginning(path, !group.empty());
  this->start();
}

void NetcdfFile::start()
{
  this->Helper = std::make_unique<HelperProcess>(answerer(this->Path, this->Group));
  const std::string what = "opening it";
  this->Helper->send({});
  const std::string answer = this->receive(what);
  try
  {
    LoadArchive archive(answer.data(), answer.size());
    NetcdfContent content;
    archive(content);
    checkContent(this->Path, content);
    // Callers keep references to variables, also if the helper is started again.
    if (!this->HasContent)
    {
      this->Content = std::move(content);
    }
    this->HasContent = true;
  }
  catch (const IOError&)
  {
    throw;
  }
  catch (const std::exception&)
  {
    throw IOError(
      this->Path, "is damaged: the NetCDF library failed while " + what + "; copy the file again.");
  }
}

std::string NetcdfFile::receive(const std::string& what)
{
  try
  {
    return this->Helper->receive();
  }
  catch (const HelperEnded&)
  {
    this->Helper.reset();
    throw IOError(
      this->Path, "is damaged: the NetCDF library failed while " + what + "; copy the file again.");
  }
  catch (const IOError& error)
  {
    throw IOError(this->Path,
      "cannot be read: the NetCDF library reports '" + std::string(error.what()) + "' while " +
        what + "; copy the file again.");
  }
  catch (...) // the user has aborted
  {
    this->Helper.reset();
    throw;
  }
}

std::size_t NetcdfFile::checkPart(const NetcdfVariable& variable, const NetcdfPart& part) const
{
  const std::vector<std::int64_t> shape = this->Content.shape(variable);
  if (part.Start.size() != shape.size() || part.Count.size() != shape.size())
  {
    throw std::invalid_argument("a part of a variable has other dimensions");
  }
  const double memory = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  // The values are in the shared memory and, as doubles, in the caller's.
  const double each = double(valueBytes(variable) + sizeof(double));
  double values = 1;
  for (std::size_t i = 0; i < shape.size(); ++i)
  {
    if (part.Start[i] < 0 || part.Count[i] < 0 || part.Start[i] > shape[i] - part.Count[i])
    {
      throw std::out_of_range("a part beyond a variable is asked for");
    }
    values *= double(part.Count[i]);
  }
  if (values * each > memory)
  {
    throw IOError(this->Path,
      "says that '" + variable.Name + "' has " +
        std::to_string(std::uint64_t(std::min(values, 1e19))) +
        " values to be read at once, more than the memory of this machine holds; copy the file "
        "again if it should be smaller.");
  }
  return std::size_t(values);
}

std::size_t NetcdfFile::requireNumbers(const NetcdfVariable& variable, const NetcdfPart& part) const
{
  if (!isNumber(variable))
  {
    throw IOError(this->Path, "has '" + variable.Name + "' as text; it should be numbers.");
  }
  for (const char* const factor : { "scale_factor", "add_offset" })
  {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const NetcdfAttribute* const attribute = variable.find(factor);
    if (attribute && attribute->Numbers.size() > 1)
    {
      throw IOError(this->Path,
        "gives '" + variable.Name + "' " + std::to_string(attribute->Numbers.size()) +
          " values of " + factor + "; it should be one number for all values.");
    }
    if (attribute && !std::isfinite(variable.number(factor).value_or(none)))
    {
      throw IOError(this->Path,
        "gives '" + variable.Name + "' the " + factor + " '" + shownText(variable.text(factor)) +
          "', which is no finite number; correct the attribute.");
    }
  }
  return this->checkPart(variable, part);
}

const char* NetcdfFile::fetch(
  const NetcdfVariable& variable, const NetcdfPart& part, std::size_t bytes)
{
  const std::string what = "reading '" + variable.Name + "'";
  if (this->Pending && !(*this->Pending == part))
  {
    this->Pending.reset();
    if (this->Helper)
    {
      try
      {
        this->receive(what);
      }
      catch (const IOError&)
      {
        this->Helper.reset(); // this failure is of a part that nobody has asked for
      }
    }
  }
  if (!this->Helper)
  {
    this->Pending.reset();
    this->start();
  }
  try
  {
    if (!this->Pending)
    {
      this->Helper->send(textOf(packed(part, std::uint64_t(bytes))));
    }
    this->Pending.reset();
    this->receive(what);
    return this->Helper->memory(bytes);
  }
  catch (const HelperEnded&)
  {
    this->Helper.reset();
    throw IOError(
      this->Path, "is damaged: the NetCDF library failed while " + what + "; copy the file again.");
  }
}

void NetcdfFile::read(const NetcdfVariable& variable, const std::vector<std::int64_t>& start,
  const std::vector<std::int64_t>& count, std::vector<double>& values)
{
  const NetcdfPart part{ variable.Id, start, count };
  const std::size_t size = this->requireNumbers(variable, part);
  values.resize(size);
  if (size > 0)
  {
    const char* const stored = this->fetch(variable, part, size * valueBytes(variable));
    unpackValues(packingOf(variable), stored, size, values.data());
  }
}

std::vector<double> NetcdfFile::read(const NetcdfVariable& variable)
{
  const std::vector<std::int64_t> shape = this->Content.shape(variable);
  std::vector<double> values;
  this->read(variable, std::vector<std::int64_t>(shape.size(), 0), shape, values);
  return values;
}

std::vector<std::int64_t> NetcdfFile::readIntegers(const NetcdfVariable& variable)
{
  const std::vector<std::int64_t> shape = this->Content.shape(variable);
  return this->readIntegers(variable, std::vector<std::int64_t>(shape.size(), 0), shape);
}

std::vector<std::int64_t> NetcdfFile::readIntegers(const NetcdfVariable& variable,
  const std::vector<std::int64_t>& start, const std::vector<std::int64_t>& count)
{
  constexpr double most = 9007199254740992; // 2^53: larger ones are not exact as doubles
  constexpr std::size_t block = 4096;
  const NetcdfPart part{ variable.Id, start, count };
  const std::size_t size = this->requireNumbers(variable, part);
  std::vector<std::int64_t> integers(size, Missing);
  std::vector<double> values(std::min(block, size));
  const char* const stored =
    size > 0 ? this->fetch(variable, part, size * valueBytes(variable)) : nullptr;
  const NetcdfPacking packing = packingOf(variable);
  for (std::size_t begin = 0; begin < size; begin += block)
  {
    const std::size_t some = std::min(block, size - begin);
    unpackValues(packing, stored + begin * valueBytes(variable), some, values.data());
    for (std::size_t i = 0; i < some; ++i)
    {
      const double value = values[i];
      if (std::fabs(value) > most || std::floor(value) < value)
      {
        throw IOError(this->Path,
          "has in '" + variable.Name + "', which should be integers, the value " +
            shortText(value) + "; copy the file again.");
      }
      integers[begin + i] = std::isnan(value) ? Missing : std::int64_t(value);
    }
  }
  return integers;
}

void NetcdfFile::readStored(const NetcdfVariable& variable, const std::vector<std::int64_t>& start,
  const std::vector<std::int64_t>& count, std::vector<char>& bytes)
{
  const NetcdfPart part{ variable.Id, start, count };
  bytes.resize(this->requireNumbers(variable, part) * valueBytes(variable));
  if (!bytes.empty())
  {
    const char* const stored = this->fetch(variable, part, bytes.size());
    std::copy(stored, stored + bytes.size(), bytes.begin());
  }
}

std::string NetcdfFile::readText(const NetcdfVariable& variable)
{
  const std::vector<std::int64_t> shape = this->Content.shape(variable);
  const NetcdfPart part{ variable.Id, std::vector<std::int64_t>(shape.size(), 0), shape };
  const std::size_t size = this->checkPart(variable, part);
  return !variable.IsText || size == 0 ? "" : std::string(this->fetch(variable, part, size), size);
}

void NetcdfFile::rest()
{
  this->Pending.reset();
  this->Helper.reset();
}

void NetcdfFile::prefetch(const NetcdfVariable& variable, const std::vector<std::int64_t>& start,
  const std::vector<std::int64_t>& count)
{
  const NetcdfPart part{ variable.Id, start, count };
  const std::size_t bytes = this->checkPart(variable, part) * valueBytes(variable);
  if (!this->Helper || this->Pending || bytes == 0)
  {
    return;
  }
  try
  {
    this->Helper->send(textOf(packed(part, std::uint64_t(bytes))));
    this->Pending = part;
  }
  catch (const HelperEnded&)
  {
    this->Helper.reset(); // read() starts another one
  }
}

} // namespace tipp

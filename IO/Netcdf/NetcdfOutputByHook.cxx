// SPDX-License-Identifier: BSD-3-Clause
// Replaces Netcdf/NetcdfOutput.cxx in a build without the NetCDF library.
#include "Netcdf/NetcdfOutput.h"

#include "Files/IOError.h"
#include "Files/RawArray.h"
#include "Files/TextFile.h"
#include "Netcdf/NetcdfHook.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <utility>

namespace tipp
{
namespace
{

/// Returns what the NetCDF library reports of a new variable's name, or an empty text. Other
/// libraries take a slash for a group, and write some other names that no program reads.
std::string objectionTo(const std::string& name, const NetcdfContent& content)
{
  constexpr std::size_t longest = 256;
  const auto isControl = [](unsigned char c) { return c < ' ' || c == 127 || c == '/'; };
  const auto first = static_cast<unsigned char>(name.empty() ? ' ' : name.front());
  const bool isGood = (first > 127 || std::isalnum(first) != 0 || first == '_') &&
    name.back() != ' ' && std::none_of(name.begin(), name.end(), isControl) && utf8Of(name) == name;
  return !isGood            ? "NetCDF: Name contains illegal characters"
    : name.size() > longest ? "NetCDF: NC_MAX_NAME exceeded"
    : content.find(name)    ? "NetCDF: String match to name in use"
                            : "";
}

} // namespace

NetcdfSink::~NetcdfSink() = default;

struct NetcdfOutput::State
{
  State(const std::string& path, const std::optional<PathState>& before, std::string advice)
    : Path(path)
    , Advice(std::move(advice))
    , Pending(path, before)
  {
  }

  NetcdfVariable& variable(int number)
  {
    return this->Definitions.Content.Variables.at(std::size_t(number));
  }
  NetcdfStorage& storage(int number) { return this->Definitions.Storage.at(std::size_t(number)); }
  std::vector<NetcdfAttribute>& attributes(int number)
  {
    return number == global ? this->Definitions.Content.Attributes
                            : this->variable(number).Attributes;
  }

  /// Calls work() and reports its error.
  template <typename Work>
  void check(const Work& work)
  {
    try
    {
      work();
    }
    catch (const std::runtime_error& error)
    {
      throw IOError(this->Path,
        std::string("cannot be written as NetCDF: ") + error.what() + "; is the disk full?");
    }
  }

  const std::string Path;
  const std::string Advice;
  PendingFile Pending;
  NetcdfDefinitions Definitions;
  std::unique_ptr<NetcdfSink> Sink;
};

const int NetcdfOutput::global = -1;

NetcdfOutput::NetcdfOutput(const std::string& path, const std::optional<PathState>& before,
  bool isClassic, std::string advice)
  : Own(std::make_unique<State>(path, before, std::move(advice)))
{
  requireWriter(path);
  this->Own->Pending.unlock();
  this->Own->Definitions.IsClassic = isClassic;
}

NetcdfOutput::~NetcdfOutput() = default;

void NetcdfOutput::requireWriter(const std::string& path)
{
  const NetcdfHook& hook = netcdfHook();
  const std::string missing =
    hook.missing ? hook.missing(true) : "cannot be written: this build writes no NetCDF.";
  if (!missing.empty())
  {
    throw IOError(path, missing);
  }
}

void NetcdfOutput::setText(int variable, const char* name, const std::string& text) const
{
  if (!text.empty())
  {
    this->Own->attributes(variable).push_back({ name, text, {}, false });
  }
}

void NetcdfOutput::setInteger(int variable, const char* name, int value) const
{
  this->Own->attributes(variable).push_back({ name, "", { double(value) }, false });
}

int NetcdfOutput::addDimension(const std::string& name, std::size_t size) const
{
  std::vector<NetcdfDimension>& dimensions = this->Own->Definitions.Content.Dimensions;
  dimensions.push_back({ name, std::int64_t(size) });
  return int(dimensions.size()) - 1;
}

int NetcdfOutput::addUnlimited(const std::string& name) const
{
  return this->addDimension(name, 0);
}

int NetcdfOutput::addVariable(
  const std::string& name, Scalar type, const std::vector<int>& dimensions) const
{
  NetcdfDefinitions& definitions = this->Own->Definitions;
  const std::string objection = objectionTo(name, definitions.Content);
  if (!objection.empty())
  {
    throw IOError(this->Own->Path,
      "cannot be written as NetCDF, at '" + name + "': " + objection + "; " + this->Own->Advice);
  }
  NetcdfVariable variable;
  variable.Name = name;
  variable.Id = int(definitions.Storage.size());
  variable.Type = type;
  variable.Dimensions = dimensions;
  definitions.Content.Variables.push_back(variable);
  definitions.Storage.emplace_back();
  return variable.Id;
}

void NetcdfOutput::compress(int variable, const std::vector<std::size_t>& chunk) const
{
  this->Own->storage(variable).Chunk = chunk;
}

void NetcdfOutput::fillWithNaN(int variable, Scalar) const
{
  this->Own->storage(variable).Missing = NetcdfStorage::Fill::NaN;
}

void NetcdfOutput::withoutFill(int variable) const
{
  this->Own->storage(variable).Missing = NetcdfStorage::Fill::None;
}

void NetcdfOutput::endDefinitions() const
{
  State& own = *this->Own;
  own.check(
    [&own] { own.Sink = netcdfHook().create(own.Pending.temporaryPath(), own.Definitions); });
}

void NetcdfOutput::write(int variable, const std::vector<std::size_t>& start,
  const std::vector<std::size_t>& count, const void* values) const
{
  const NetcdfPart part{ variable, { start.begin(), start.end() }, { count.begin(), count.end() } };
  std::size_t bytes = scalarSize(*this->Own->variable(variable).Type);
  for (const std::size_t size : count)
  {
    bytes *= size;
  }
  this->Own->check([&] { this->Own->Sink->write(part, values, bytes); });
}

void NetcdfOutput::close()
{
  this->Own->check([this] { this->Own->Sink->close(); });
  this->Own->Sink.reset();
  this->Own->Pending.commit();
}

} // namespace tipp

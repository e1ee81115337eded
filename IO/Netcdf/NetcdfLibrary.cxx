// SPDX-License-Identifier: BSD-3-Clause
#include "Netcdf/NetcdfLibrary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include <netcdf.h>

namespace tipp
{
namespace
{

void check(int status)
{
  if (status == NC_ENOFILTER || status == NC_EFILTER)
  {
    throw std::runtime_error("it is compressed by a method that the HDF5 library here does not "
                             "have; install its plugin, or convert the file by 'nccopy -d 1'");
  }
  if (status != NC_NOERR)
  {
    throw std::runtime_error(nc_strerror(status));
  }
}

std::optional<Scalar> scalarOfNetcdf(nc_type type)
{
  constexpr std::array<std::pair<nc_type, Scalar>, 10> types = { { { NC_BYTE, Scalar::Int8 },
    { NC_UBYTE, Scalar::UInt8 }, { NC_SHORT, Scalar::Int16 }, { NC_USHORT, Scalar::UInt16 },
    { NC_INT, Scalar::Int32 }, { NC_UINT, Scalar::UInt32 }, { NC_INT64, Scalar::Int64 },
    { NC_UINT64, Scalar::UInt64 }, { NC_FLOAT, Scalar::Float32 },
    { NC_DOUBLE, Scalar::Float64 } } };
  const auto* const found = std::find_if(
    types.begin(), types.end(), [type](const auto& pair) { return pair.first == type; });
  return found == types.end() ? std::nullopt : std::make_optional(found->second);
}

std::string stringAttribute(int file, int variable, const char* name, std::size_t length)
{
  std::vector<char*> texts(length, nullptr);
  check(nc_get_att_string(file, variable, name, texts.data()));
  std::string joined;
  for (const char* text : texts)
  {
    joined += (joined.empty() ? "" : " ") + std::string(text ? text : "");
  }
  nc_free_string(length, texts.data());
  return joined;
}

} // namespace

NetcdfLibrary::~NetcdfLibrary()
{
  if (this->File >= 0)
  {
    nc_close(this->File);
  }
}

NetcdfContent NetcdfLibrary::open(const std::string& path, const std::string& group)
{
  // Locks fail on many file systems of clusters, and a model may still be writing the file.
  setenv("HDF5_USE_FILE_LOCKING", "FALSE", 0);
  check(nc_open(path.c_str(), NC_NOWRITE, &this->File));
  int first = this->File;
  if (!group.empty() && nc_inq_grp_full_ncid(this->File, group.c_str(), &first) != NC_NOERR)
  {
    throw std::runtime_error("it has no group '" + group + "'");
  }
  NetcdfContent content;
  this->addGroup(first, "", !group.empty(), content);
  this->CacheBytes.assign(this->Variables.size(), 0);
  return content;
}

/// Adds the variables of a group and, if they are wanted, of the groups in it.
void NetcdfLibrary::addGroup(
  int group, const std::string& prefix, bool withGroups, NetcdfContent& content)
{
  int variables = 0;
  int attributes = 0;
  check(nc_inq(group, nullptr, &variables, &attributes, nullptr));
  addDimensions(group, content);
  for (int id = 0; id < variables; ++id)
  {
    NetcdfVariable variable = describe({ group, id });
    variable.Name.insert(0, prefix);
    variable.Id = int(this->Variables.size());
    content.Variables.push_back(std::move(variable));
    this->Variables.push_back({ group, id });
  }
  for (NetcdfAttribute& attribute : attributesOf({ group, NC_GLOBAL }, attributes))
  {
    attribute.Name.insert(0, prefix);
    content.Attributes.push_back(std::move(attribute));
  }
  int count = 0;
  check(withGroups ? nc_inq_grps(group, &count, nullptr) : NC_NOERR);
  std::vector<int> groups(std::size_t(count), 0);
  check(count > 0 ? nc_inq_grps(group, nullptr, groups.data()) : NC_NOERR);
  for (const int part : groups)
  {
    std::array<char, NC_MAX_NAME + 1> name{};
    check(nc_inq_grpname(part, name.data()));
    this->addGroup(part, prefix + name.data() + "/", true, content);
  }
}

/// Sets the dimensions that a group may use, at the index that is their number.
void NetcdfLibrary::addDimensions(int group, NetcdfContent& content)
{
  int count = 0;
  check(nc_inq_dimids(group, &count, nullptr, 1));
  std::vector<int> ids(std::size_t(count), 0);
  check(count > 0 ? nc_inq_dimids(group, nullptr, ids.data(), 1) : NC_NOERR);
  constexpr int most = 1 << 20;
  for (const int id : ids)
  {
    if (id < 0 || id > most)
    {
      throw std::runtime_error("it has too many dimensions");
    }
    std::array<char, NC_MAX_NAME + 1> name{};
    std::size_t size = 0;
    check(nc_inq_dim(group, id, name.data(), &size));
    content.Dimensions.resize(std::max(content.Dimensions.size(), std::size_t(id) + 1));
    content.Dimensions[std::size_t(id)] = { name.data(), std::int64_t(size) };
  }
}

NetcdfVariable NetcdfLibrary::describe(const Variable& of)
{
  std::array<char, NC_MAX_NAME + 1> name{};
  std::array<int, NC_MAX_VAR_DIMS> dimensions{};
  nc_type type = NC_NAT;
  int count = 0;
  int attributes = 0;
  check(nc_inq_var(of.Group, of.Id, name.data(), &type, &count, dimensions.data(), &attributes));
  NetcdfVariable variable;
  variable.Name = name.data();
  variable.Type = scalarOfNetcdf(type);
  variable.IsText = type == NC_CHAR;
  variable.Dimensions.assign(dimensions.begin(), dimensions.begin() + count);
  variable.Attributes = attributesOf(of, attributes);
  return variable;
}

std::vector<NetcdfAttribute> NetcdfLibrary::attributesOf(const Variable& variable, int count)
{
  std::vector<NetcdfAttribute> attributes;
  for (int i = 0; i < count; ++i)
  {
    attributes.push_back(attributeOf(variable, i));
  }
  return attributes;
}

NetcdfAttribute NetcdfLibrary::attributeOf(const Variable& variable, int index)
{
  constexpr std::size_t mostNumbers = std::size_t(1) << 16; // no convention has longer ones
  std::array<char, NC_MAX_NAME + 1> name{};
  check(nc_inq_attname(variable.Group, variable.Id, index, name.data()));
  nc_type type = NC_NAT;
  std::size_t length = 0;
  check(nc_inq_att(variable.Group, variable.Id, name.data(), &type, &length));
  NetcdfAttribute attribute;
  attribute.Name = name.data();
  attribute.IsFloat = type == NC_FLOAT;
  if (length > 16 * mostNumbers)
  {
    return attribute;
  }
  if (type == NC_CHAR)
  {
    attribute.Text.resize(length);
    check(nc_get_att_text(variable.Group, variable.Id, name.data(), attribute.Text.data()));
    attribute.Text.erase(std::min(attribute.Text.find('\0'), attribute.Text.size()));
  }
  else if (type == NC_STRING && length <= mostNumbers)
  {
    attribute.Text = stringAttribute(variable.Group, variable.Id, name.data(), length);
  }
  else if (scalarOfNetcdf(type) && length <= mostNumbers)
  {
    attribute.Numbers.resize(length);
    check(nc_get_att_double(variable.Group, variable.Id, name.data(), attribute.Numbers.data()));
  }
  return attribute;
}

/// Lets the library keep the chunks that it will need again, so that it decompresses them once:
/// those of the part, at whose end the next one may begin, and, where chunks hold several steps,
/// all that a step needs.
void NetcdfLibrary::enlargeCache(const NetcdfPart& part)
{
  constexpr double most = double(std::size_t(512) << 20);
  constexpr double usual = double(std::size_t(16) << 20);
  std::array<int, NC_MAX_VAR_DIMS> dimensions{};
  std::array<std::size_t, NC_MAX_VAR_DIMS> chunk{};
  int count = 0;
  int storage = NC_CONTIGUOUS;
  nc_type type = NC_NAT;
  std::size_t bytes = 0;
  const auto [file, id] = this->Variables[std::size_t(part.Variable)];
  if (nc_inq_var(file, id, nullptr, &type, &count, dimensions.data(), nullptr) != 0 ||
    nc_inq_var_chunking(file, id, &storage, chunk.data()) != 0 ||
    nc_inq_type(file, type, nullptr, &bytes) != 0 || storage != NC_CHUNKED ||
    std::size_t(count) != part.Count.size())
  {
    return;
  }
  const auto isStep = [&](std::size_t i) { return part.Count[i] == 1 && chunk[i] > 1; };
  bool holdsSteps = false;
  for (std::size_t i = 0; i < part.Count.size(); ++i)
  {
    holdsSteps = holdsSteps || isStep(i);
  }
  double needed = double(bytes);
  double chunks = 1;
  for (std::size_t i = 0; i < part.Count.size(); ++i)
  {
    std::size_t size = 0;
    nc_inq_dimlen(file, dimensions[i], &size);
    const double side = std::max(double(chunk[i]), 1.0);
    const double all = std::ceil(double(size) / side);
    const double touched = std::min(all, std::ceil(double(part.Count[i]) / side));
    const double along = isStep(i) ? 1 : holdsSteps ? all : touched;
    needed *= along * side;
    chunks *= std::max(along, 1.0);
  }
  std::size_t& known = this->CacheBytes[std::size_t(part.Variable)];
  if (needed > std::max(usual, double(known)) && needed <= most)
  {
    known = std::size_t(needed);
    nc_set_var_chunk_cache(
      file, id, known + std::size_t(usual), std::size_t(10 * chunks) + 1009, 0.75F);
  }
}

void NetcdfLibrary::read(const NetcdfPart& part, void* to)
{
  if (part.Variable < 0 || std::size_t(part.Variable) >= this->CacheBytes.size())
  {
    throw std::runtime_error("there is no such variable");
  }
  this->enlargeCache(part);
  const std::vector<std::size_t> start(part.Start.begin(), part.Start.end());
  const std::vector<std::size_t> count(part.Count.begin(), part.Count.end());
  const auto [file, id] = this->Variables[std::size_t(part.Variable)];
  check(nc_get_vara(file, id, start.data(), count.data(), to));
}

} // namespace tipp

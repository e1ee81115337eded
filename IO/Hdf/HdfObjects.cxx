// SPDX-License-Identifier: BSD-3-Clause
#include "Hdf/HdfObjects.h"

#include "Files/RawArray.h"

#include <algorithm>
#include <array>
#include <climits>
#include <set>
#include <type_traits>
#include <utility>

namespace tipp
{
namespace
{

/// The types of messages of an object's header.
enum class Message : std::uint8_t
{
  Dataspace = 1,
  LinkInfo = 2,
  Datatype = 3,
  FillValue = 5,
  Link = 6,
  Layout = 8,
  GroupInfo = 10,
  Attribute = 12
};

/// Appends a number, little-endian, in `bytes` bytes.
void append(std::string& to, std::uint64_t number, int bytes)
{
  for (int i = 0; i < bytes; ++i)
  {
    to += char(number >> (CHAR_BIT * i));
  }
}

void pad(std::string& to)
{
  to.append((8 - to.size() % 8) % 8, '\0');
}

std::uint32_t rotated(std::uint32_t value, int bits)
{
  return (value << bits) | (value >> (32 - bits));
}

/// The checksum of HDF5's metadata: Bob Jenkins' lookup3, hashlittle()
/// (https://burtleburtle.net/bob/c/lookup3.c).
std::uint32_t metadataChecksum(const std::string& bytes)
{
  const std::uint32_t start = 0xdeadbeefU + std::uint32_t(bytes.size());
  std::array<std::uint32_t, 3> s = { start, start, start };
  std::size_t at = 0;
  const auto addBlock = [&](std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      s[i / 4] += std::uint32_t(static_cast<unsigned char>(bytes[at + i])) << (CHAR_BIT * (i % 4));
    }
    at += count;
  };
  for (; bytes.size() - at > 12;)
  {
    addBlock(12);
    constexpr std::array<int, 6> mix = { 4, 6, 8, 16, 19, 4 };
    for (std::size_t i = 0; i < mix.size(); ++i)
    {
      std::uint32_t& changed = s[i % 3];
      std::uint32_t& last = s[(i + 2) % 3];
      changed = (changed - last) ^ rotated(last, mix[i]);
      last += s[(i + 1) % 3];
    }
  }
  if (at == bytes.size())
  {
    return s[2];
  }
  addBlock(bytes.size() - at);
  constexpr std::array<int, 7> last = { 14, 11, 25, 16, 4, 14, 24 };
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    const std::uint32_t other = s[(i + 1) % 3];
    std::uint32_t& changed = s[(i + 2) % 3];
    changed = (changed ^ other) - rotated(other, last[i]);
  }
  return s[2];
}

void appendChecksum(std::string& to)
{
  append(to, metadataChecksum(to), 4);
}

/// The encoding of a type of numbers.
std::string datatypeOf(Scalar type)
{
  const std::uint64_t bytes = scalarSize(type);
  bool isSigned = false;
  bool isFloat = false;
  withScalar(type,
    [&](auto value)
    {
      isFloat = std::is_floating_point_v<decltype(value)>;
      isSigned = std::is_signed_v<decltype(value)>;
    });
  std::string text;
  append(
    text, isFloat ? 0x11 : 0x10, 1); // version 1, class of floating-point or fixed-point numbers
  // An implied leading bit of the mantissa, and the position of the sign; or whether there is a
  // sign.
  append(text, isFloat ? 0x20 + (8 * bytes - 1) * 256 : isSigned ? 8 : 0, 3);
  append(text, bytes, 4);
  append(text, 0, 2);
  append(text, 8 * bytes, 2);
  if (isFloat)
  {
    const bool isWide = bytes == 8;
    append(text, isWide ? 52 : 23, 1); // where the exponent is, and its bits
    append(text, isWide ? 11 : 8, 1);
    append(text, 0, 1); // where the mantissa is, and its bits
    append(text, isWide ? 52 : 23, 1);
    append(text, isWide ? 1023 : 127, 4); // bias of the exponent
  }
  return text;
}

std::string dataspaceOf(const std::vector<std::uint64_t>& sizes)
{
  std::string text;
  append(text, 2, 1);
  append(text, sizes.size(), 1);
  append(text, 0, 1);
  append(text, sizes.empty() ? 0 : 1, 1); // a scalar, or an array
  for (const std::uint64_t size : sizes)
  {
    append(text, size, 8);
  }
  return text;
}

std::string messageOf(Message type, const std::string& data)
{
  std::string text;
  append(text, std::uint64_t(type), 1);
  append(text, data.size(), 2);
  append(text, 0, 1);
  return text + data;
}

/// The messages of an array but for its layout. Its elements are zeros where none are stored.
std::string describe(const HdfShape& shape, bool isVirtual)
{
  std::string fill;
  append(fill, 3, 1);
  append(fill, isVirtual ? 0x0b : 0x0a, 1); // when space is allocated: incrementally, or late
  return messageOf(Message::Dataspace, dataspaceOf(shape.Sizes)) +
    messageOf(Message::Datatype, datatypeOf(shape.Type)) + messageOf(Message::FillValue, fill);
}

std::string attributeOf(const std::string& name, const std::string& datatype,
  const std::vector<std::uint64_t>& sizes, const std::string& data)
{
  const std::string dataspace = dataspaceOf(sizes);
  std::string text;
  append(text, 3, 1);
  append(text, 0, 1);
  append(text, name.size() + 1, 2);
  append(text, datatype.size(), 2);
  append(text, dataspace.size(), 2);
  append(text, 0, 1); // ASCII
  text.append(name).append(1, '\0').append(datatype).append(dataspace).append(data);
  return messageOf(Message::Attribute, text);
}

std::string linkTo(const HdfLink& link)
{
  std::string text;
  append(text, 1, 1);
  append(text, 0x11, 1); // the name's size has two bytes, and its encoding is stated
  append(text, 1, 1);    // UTF-8
  append(text, link.Name.size(), 2);
  text += link.Name;
  append(text, link.Object, 8);
  return messageOf(Message::Link, text);
}

/// The list of a virtual array's sources.
std::string encodeSources(const HdfShape& shape, const std::vector<HdfSource>& sources)
{
  const std::size_t rank = shape.Sizes.size();
  std::string text;
  append(text, 0, 1);
  append(text, sources.size(), 8);
  for (const HdfSource& source : sources)
  {
    text.append(source.File).append(1, '\0').append(source.Array).append(1, '\0');
    append(text, 3, 4); // all of the source
    append(text, 1, 4);
    append(text, 0, 8);
    append(text, 2, 4); // a box in the virtual array
    append(text, 2, 4);
    append(text, 1, 1);
    append(text, 4 + 32 * rank, 4);
    append(text, rank, 4);
    for (std::size_t i = 0; i < rank; ++i)
    {
      append(text, i == 0 ? source.First : 0, 8);
      append(text, 1, 8);
      append(text, 1, 8);
      append(text, i == 0 ? source.Count : shape.Sizes[i], 8);
    }
  }
  appendChecksum(text);
  return text;
}

/// A global heap with one object, number 1.
std::string heapOf(const std::string& object)
{
  constexpr std::size_t fewestBytes = 4096;
  std::string text;
  append(text, 1, 2);
  append(text, 0, 6);
  append(text, object.size(), 8);
  text += object;
  pad(text);
  const std::size_t used = 16 + text.size();
  if (used < fewestBytes)
  {
    append(text, 0, 8); // object 0 is what is free
    append(text, fewestBytes - used, 8);
    text.resize(fewestBytes - 16, '\0');
  }
  std::string heap = "GCOL";
  append(heap, 1, 4);
  append(heap, 16 + text.size(), 8);
  return heap + text;
}

} // namespace

HdfObjects::HdfObjects()
  : Pending(superblockBytes, '\0')
{
}

std::string HdfObjects::take()
{
  this->Taken += this->Pending.size();
  return std::exchange(this->Pending, std::string());
}

HdfAddress HdfObjects::addBytes(const void* data, std::size_t bytes)
{
  const HdfAddress address = this->end();
  this->Pending.append(static_cast<const char*>(data), bytes);
  pad(this->Pending);
  return address;
}

/// Adds an object's header, version 2.
HdfAddress HdfObjects::addHeader(const std::string& messages)
{
  std::string text = "OHDR";
  append(text, 2, 1);
  append(text, 2, 1); // the size of the messages has four bytes
  append(text, messages.size(), 4);
  text += messages;
  appendChecksum(text);
  return this->addBytes(text.data(), text.size());
}

HdfAddress HdfObjects::addArray(const HdfShape& shape, HdfAddress data)
{
  std::uint64_t bytes = scalarSize(shape.Type);
  for (const std::uint64_t size : shape.Sizes)
  {
    bytes *= size;
  }
  std::string layout;
  append(layout, 3, 1);
  append(layout, 1, 1);
  append(layout, bytes == 0 ? nowhere : data, 8);
  append(layout, bytes, 8);
  return this->addHeader(describe(shape, false) + messageOf(Message::Layout, layout));
}

HdfAddress HdfObjects::addNumbers(const std::vector<std::int64_t>& numbers)
{
  const HdfAddress data = this->addBytes(numbers.data(), numbers.size() * sizeof(std::int64_t));
  return this->addArray({ Scalar::Int64, { numbers.size() } }, data);
}

HdfAddress HdfObjects::addNumbers(const std::vector<double>& numbers)
{
  const HdfAddress data = this->addBytes(numbers.data(), numbers.size() * sizeof(double));
  return this->addArray({ Scalar::Float64, { numbers.size() } }, data);
}

HdfAddress HdfObjects::addVirtualArray(const HdfShape& shape, const std::vector<HdfSource>& sources)
{
  if (sources.empty())
  {
    return this->addArray(shape, nowhere);
  }
  const std::string heap = heapOf(encodeSources(shape, sources));
  const HdfAddress list = this->addBytes(heap.data(), heap.size());
  std::string layout;
  append(layout, 4, 1);
  append(layout, 3, 1);
  append(layout, list, 8);
  append(layout, 1, 4);
  return this->addHeader(describe(shape, true) + messageOf(Message::Layout, layout));
}

HdfAddress HdfObjects::addGroup(
  const std::vector<HdfLink>& links, const std::vector<std::string>& attributes)
{
  std::string info;
  append(info, 0, 2);
  append(info, nowhere, 8);
  append(info, nowhere, 8);
  std::string messages =
    messageOf(Message::LinkInfo, info) + messageOf(Message::GroupInfo, std::string(2, '\0'));
  for (const std::string& attribute : attributes)
  {
    messages += attribute;
  }
  for (const HdfLink& link : links)
  {
    messages += linkTo(link);
  }
  return this->addHeader(messages);
}

std::string HdfObjects::textAttribute(const std::string& name, const std::string& text)
{
  std::string datatype;
  append(datatype, 0x13, 1); // version 1, class of texts
  append(datatype, 1, 3);    // zeros at the end are no part of the text
  append(datatype, text.size(), 4);
  return attributeOf(name, datatype, {}, text);
}

std::string HdfObjects::numberAttribute(
  const std::string& name, const std::vector<std::int64_t>& numbers)
{
  std::string data;
  for (const std::int64_t number : numbers)
  {
    append(data, std::uint64_t(number), 8);
  }
  const std::vector<std::uint64_t> sizes(numbers.size() == 1 ? 0 : 1, numbers.size());
  return attributeOf(name, datatypeOf(Scalar::Int64), sizes, data);
}

std::string HdfObjects::superblock(std::uint64_t base, std::uint64_t fileBytes, HdfAddress root)
{
  std::string text = "\x89HDF\r\n\x1a\n";
  append(text, 2, 1); // version 2, and eight bytes each for addresses and sizes
  append(text, 8, 1);
  append(text, 8, 1);
  append(text, 0, 1);
  append(text, base, 8);
  append(text, nowhere, 8);
  append(text, fileBytes, 8);
  append(text, root, 8);
  appendChecksum(text);
  return text;
}

std::vector<std::string> hdfNamesOf(const std::vector<std::string>& names)
{
  std::set<std::string> known;
  std::vector<std::string> changed;
  for (std::string name : names)
  {
    name.resize(std::min(name.size(), HdfObjects::mostNameBytes - 20));
    for (char& letter : name)
    {
      letter = letter == '/' || letter == '\0' ? '_' : letter;
    }
    name = name.empty() || name == "." ? "_" : name;
    std::string free = name;
    for (int i = 2; !known.insert(free).second; ++i)
    {
      free = name + "_" + std::to_string(i);
    }
    changed.push_back(free);
  }
  return changed;
}

} // namespace tipp

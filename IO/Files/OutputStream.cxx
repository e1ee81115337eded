// SPDX-License-Identifier: BSD-3-Clause
#include "Files/OutputStream.h"

#include "Files/IOError.h"

#include <algorithm>

namespace tipp
{

OutputStream::OutputStream(const OutputFile& file)
  : std::ostream(nullptr)
  , Content(file)
{
  this->rdbuf(&this->Content);
}

void OutputStream::finish()
{
  this->flush();
  if (!this->Content.failure().empty())
  {
    throw IOError(this->Content.failure());
  }
  if (this->fail())
  {
    throw IOError("The output could not be formatted.");
  }
}

OutputStream::Buffer::Buffer(const OutputFile& file)
  : File(file)
  , Bytes(std::size_t(1) << 16)
{
  this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
}

/// Writes nothing after a failure: the file is unusable in any case.
bool OutputStream::Buffer::write(const char* from, std::size_t count)
{
  if (!this->Failure.empty())
  {
    return false;
  }
  try
  {
    this->File.write(this->Start, from, count);
  }
  catch (const IOError& error)
  {
    this->Failure = error.what();
    return false;
  }
  this->Start += count;
  this->End = std::max(this->End, this->Start);
  return true;
}

int OutputStream::Buffer::sync()
{
  const bool isWritten = this->write(this->pbase(), std::size_t(this->pptr() - this->pbase()));
  this->setp(this->Bytes.data(), this->Bytes.data() + this->Bytes.size());
  return isWritten ? 0 : -1;
}

int OutputStream::Buffer::overflow(int character)
{
  if (this->sync() != 0)
  {
    return traits_type::eof();
  }
  if (character != traits_type::eof())
  {
    this->sputc(char(character));
  }
  return traits_type::not_eof(character);
}

std::streamsize OutputStream::Buffer::xsputn(const char* from, std::streamsize count)
{
  if (count > this->epptr() - this->pptr())
  {
    return this->sync() == 0 && this->write(from, std::size_t(count)) ? count : 0;
  }
  std::copy_n(from, count, this->pptr());
  this->pbump(int(count));
  return count;
}

OutputStream::Buffer::pos_type OutputStream::Buffer::seekoff(
  off_type by, std::ios_base::seekdir from, std::ios_base::openmode)
{
  if (this->sync() != 0)
  {
    return off_type(-1);
  }
  const std::uint64_t base = from == std::ios_base::beg ? 0
    : from == std::ios_base::cur                        ? this->Start
                                                        : this->End;
  this->Start = base + std::uint64_t(by);
  return off_type(this->Start);
}

OutputStream::Buffer::pos_type OutputStream::Buffer::seekpos(
  pos_type to, std::ios_base::openmode mode)
{
  return this->seekoff(off_type(to), std::ios_base::beg, mode);
}

} // namespace tipp

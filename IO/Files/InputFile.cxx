// SPDX-License-Identifier: BSD-3-Clause
#include "Files/InputFile.h"

#include "Files/IOError.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace tipp
{

InputFile::InputFile(const std::string& path)
  : Path(path)
  // O_NONBLOCK: opening a pipe, which is refused below, must not wait for its writer.
  , Descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK))
{
  if (this->Descriptor < 0)
  {
    throw IOError(path, std::string("cannot be opened (") + std::strerror(errno) + ").");
  }
  struct stat status = {};
  if (fstat(this->Descriptor, &status) != 0 || !S_ISREG(status.st_mode))
  {
    close(this->Descriptor);
    throw IOError(path,
      S_ISDIR(status.st_mode) ? "is a folder, not a file; name a file in it."
                              : "is not an ordinary file; copy it to one.");
  }
  this->Size = std::uint64_t(status.st_size);
}

InputFile::~InputFile()
{
  close(this->Descriptor);
}

std::size_t readUpTo(
  int descriptor, const std::string& path, std::uint64_t offset, void* to, std::size_t bytes)
{
  // A system call transfers less than 2 GiB.
  constexpr std::size_t most = std::size_t(1) << 30;
  std::size_t done = 0;
  while (done < bytes)
  {
    const ssize_t got = pread(descriptor, static_cast<char*>(to) + done,
      std::min(bytes - done, most), off_t(offset + done));
    if (got < 0 && errno == EINTR)
    {
      continue;
    }
    if (got < 0)
    {
      throw IOError(path, std::string("cannot be read (") + std::strerror(errno) + ").");
    }
    if (got == 0)
    {
      break;
    }
    done += std::size_t(got);
  }
  return done;
}

void InputFile::read(std::uint64_t offset, void* to, std::size_t bytes) const
{
  const std::size_t done = readUpTo(this->Descriptor, this->Path, offset, to, bytes);
  if (done < bytes)
  {
    throw IOError(this->Path,
      "ends at byte " + std::to_string(offset + done) + ", " + std::to_string(bytes - done) +
        " bytes before its data do; copy or make it again.");
  }
}

std::string extensionOf(const std::string& path)
{
  const std::size_t end = path.find_last_not_of('/'); // "mesh.tipp/" is a folder's name, too
  return lowerCase(std::filesystem::path(path.substr(0, end + 1)).extension().string());
}

namespace
{

struct Kind
{
  const char* Extensions; ///< separated by blanks
  const char* Name;
  const char* Command; ///< what to do; with FILE as the file's name
};

constexpr const char* meshio = "convert it, as with 'meshio convert FILE out.vtu'.";

constexpr std::array<Kind, 10> kinds = { {
  { ".14 .grd", "an ADCIRC grid", "convert it, as with 'tipp flatten FILE -o mesh'." },
  { ".ex2 .exo .e", "an Exodus file", meshio },
  // meshio reads only TetGen's files, in space.
  { ".node", "a file of TetGen or Triangle",
    "take the points of one in the plane, as with \"awk 'NR > 1 {print $2, $3, $4}' FILE > "
    "points.xyz\", and convert one in space, as with 'meshio convert FILE out.vtu'." },
  { ".ele", "a file of TetGen or Triangle", meshio },
  { ".msh", "a file of Gmsh", meshio },
  { ".xml", "a mesh of DOLFIN or other XML", meshio },
  { ".2dm", "a mesh of SMS",
    "take its points, as with \"awk '/^ND/ {print $3, $4, $5}' FILE > points.xyz\"." },
  { ".med", "a mesh of Salome", meshio },
  { ".nc .nc4 .cdf", "a NetCDF file",
    "give a text file, such as ADCIRC's ASCII output, or convert a raster, as with "
    "'gdal_translate FILE out.xyz'." },
  { ".e57", "an E57 file", "convert it, as with 'pdal translate FILE out.las'." },
} };

} // namespace

std::string conversionAdvice(const std::string& path)
{
  namespace fs = std::filesystem;
  const std::string name = fs::path(path).filename().string();
  const bool isCompressed = extensionOf(path) == ".gz";
  const std::string plain = isCompressed ? fs::path(name).stem().string() : name;
  const std::string extension = extensionOf(plain) + " ";
  const auto kind = std::find_if(kinds.begin(), kinds.end(),
    [&extension](const Kind& k)
    { return (k.Extensions + std::string(" ")).find(extension) != std::string::npos; });
  if (extension == " " || kind == kinds.end())
  {
    return "";
  }
  std::string command = kind->Command;
  for (std::size_t at = command.find("FILE"); at != std::string::npos;
       at = command.find("FILE", at + plain.size()))
  {
    command.replace(at, 4, plain);
  }
  const std::string unpack = isCompressed ? "unpack it, as with 'gunzip " + name + "', and " : "";
  return std::string("is ") + kind->Name + ", which is not read here; " + unpack + command;
}

void refuseKind(const std::string& path, const std::string& problem)
{
  const std::string advice = conversionAdvice(path);
  throw IOError(path, advice.empty() ? problem : advice);
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#include "Files/RequireApart.h"

#include "Files/IOError.h"
#include "Files/InputFile.h"
#include "Files/OutputFile.h"
#include "Files/TextFile.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace tipp
{

namespace fs = std::filesystem;

namespace
{

fs::path resolved(const std::string& path)
{
  std::error_code failure;
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), failure);
  return whole.has_filename() ? whole : whole.parent_path();
}

/// The path that the output will have once links are resolved, even if the target does not exist.
fs::path finalPath(const std::string& output)
{
  try
  {
    return outputPath(output);
  }
  catch (const IOError&) // reported when the output is opened
  {
    return resolved(output);
  }
}

bool isWithin(const fs::path& path, const fs::path& folder)
{
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
    folder.end();
}

/// The files that a parallel VTK XML file (.pvtu ...) refers to: its "Source" attributes.
std::vector<std::string> piecesNamedBy(const std::string& path)
{
  const std::string text = readTextFile(path);
  const std::string label = "Source=\"";
  std::vector<std::string> pieces;
  for (std::size_t at = text.find(label); at != std::string::npos; at = text.find(label, at))
  {
    at += label.size();
    const std::string name = text.substr(at, text.find('"', at) - at);
    pieces.push_back((fs::path(path).parent_path() / name).string());
  }
  return pieces;
}

/// The file itself, or the files of a flat or partitioned mesh.
std::vector<std::string> filesOfInput(const std::string& path)
{
  std::error_code failure;
  std::vector<std::string> files;
  if (!fs::is_directory(path, failure))
  {
    const std::string name = fs::path(path).filename().string();
    const bool isIndex = name == "index.json" || name == "mesh.pvtu" ||
      (name == "mesh.vtkhdf" && fs::exists(fs::path(path).replace_filename("tables.bin"), failure));
    if (isIndex)
    {
      files = filesOfInput(fs::absolute(path).parent_path().string());
    }
    files.push_back(path);
    if (!isIndex && extensionOf(path).rfind(".pvt", 0) == 0 && fs::is_regular_file(path, failure))
    {
      const std::vector<std::string> pieces = piecesNamedBy(path);
      files.insert(files.end(), pieces.begin(), pieces.end());
    }
    return files;
  }
  for (const char* const part : { "", "pieces", "point_data", "cell_data" })
  {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(path) / part, failure))
    {
      if (entry.is_regular_file(failure))
      {
        files.push_back(entry.path().string());
      }
    }
  }
  return files;
}

/// Checks an output that exists; one that does not cannot be an input.
void requireNoInput(const std::string& output, const std::string& input)
{
  std::error_code failure;
  const bool isFolder = fs::is_directory(output, failure);
  const fs::path folder = resolved(output);
  for (const std::string& file : filesOfInput(input))
  {
    const bool isHit =
      isFolder ? isWithin(resolved(file), folder) : fs::equivalent(file, output, failure);
    if (isHit)
    {
      throw IOError(output,
        (isFolder ? "holds an input of the run, " + input
                  : std::string("is also an input of the run")) +
          ", so it cannot be the output; name another.");
    }
  }
}

} // namespace

void requireApart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs)
{
  std::error_code failure;
  for (std::size_t i = 0; i < outputs.size(); ++i)
  {
    const std::string& output = outputs[i];
    if (output.empty())
    {
      continue;
    }
    for (std::size_t j = 0; j < i; ++j)
    {
      const bool isSame = !outputs[j].empty() &&
        (isWithin(finalPath(output), finalPath(outputs[j])) ||
          isWithin(finalPath(outputs[j]), finalPath(output)) ||
          fs::equivalent(output, outputs[j], failure));
      if (isSame)
      {
        throw IOError(
          output, "is the same as the output " + outputs[j] + " or lies in it; name another.");
      }
    }
    if (!fs::exists(output, failure))
    {
      continue;
    }
    for (const std::string& input : inputs)
    {
      if (!input.empty())
      {
        requireNoInput(output, input);
      }
    }
  }
}

} // namespace tipp

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippTemporaryPaths_h
#define tippTemporaryPaths_h

#include "vtkTIPPIOModule.h"

#include <functional>
#include <string>

namespace tipp
{

/// Registers a temporary file or folder while the object lives, so that code that ends the process
/// without unwinding, such as a signal handler's thread, can remove it. The object itself removes
/// nothing.
class VTKTIPPIO_EXPORT TemporaryPath
{
public:
  TemporaryPath() = default;
  ~TemporaryPath() { this->unlist(); }
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  void list(const std::string& path);
  /// From now on messages show paths in the folder `temporary` as paths in `final`.
  void showAs(const std::string& temporary, const std::string& final);
  void unlist();
  /// A kept path is not removed when the process ends: a later run resumes from it.
  void keep(bool kept);

private:
  std::string Path;
  std::string Shown; ///< the folder that messages replace by its final path
};

/// A temporary file, which is removed with the object, or when a signal ends the process.
class VTKTIPPIO_EXPORT TemporaryFile
{
public:
  explicit TemporaryFile(const std::string& path);
  ~TemporaryFile();

  const std::string& path() const { return this->Path; }

private:
  const std::string Path;
  TemporaryPath Listed;
};

/// Returns the path to show to the user: for a path in a registered folder, the finished output's.
VTKTIPPIO_EXPORT std::string shownPath(const std::string& path);

/// Runs `move`, which moves an output to `path`; endTemporaryPaths() does not interrupt it.
VTKTIPPIO_EXPORT void commitOutput(const std::string& path, const std::function<void()>& move);

/// The result of endTemporaryPaths().
struct EndedPaths
{
  bool HasOutput = false; ///< an output outside of the registered paths was committed
  bool HasKept = false;   ///< a registered path was kept
};

/// Removes all registered paths that are not kept. Afterwards no output can be committed and no
/// path registered or released: threads that try block for ever. Call it just before the process
/// ends.
VTKTIPPIO_EXPORT EndedPaths endTemporaryPaths();

/// Returns "." + name + ending, shortened so that with a suffix it is still a valid file name;
/// different names give different results.
VTKTIPPIO_EXPORT std::string hiddenName(const std::string& name, const std::string& ending);

/// Returns 16 hexadecimal digits that depend on the text.
std::string hashText(const std::string& text);

/// The name of the file that marks a WorkFolder as made here; it holds what the folder is for.
inline constexpr const char* workFolderMark = ".tipp-work";

/// Removes the files that runs write and folders that become empty, but not the folder itself.
/// Other files stay, since they are not ours.
void clearWorkFolder(const std::string& folder);

/// Removes the files that runs write, the mark of a WorkFolder, and the folder itself if it is
/// empty then. Other files stay, since they are not ours.
void removeWorkFolder(const std::string& folder);

} // namespace tipp

#endif

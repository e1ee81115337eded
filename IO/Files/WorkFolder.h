// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippWorkFolder_h
#define tippWorkFolder_h

#include "Files/OutputFile.h"
#include "Files/TemporaryPaths.h"
#include "vtkTIPPIOModule.h"

#include <optional>
#include <string>

namespace tipp
{

/// A folder for temporary files, which this process uses alone. The destructor removes it unless it
/// is kept; so does the end of the process by a signal. A file in the folder marks it as made here,
/// and only files that runs write are removed from it, so that no user loses others.
///
/// All functions that make one throw IOError if the folder cannot be made.
class VTKTIPPIO_EXPORT WorkFolder
{
public:
  /// Makes a folder "tipp-XXXXXX" among the system's temporary files (TMPDIR). All that is in it is
  /// removed with it.
  static WorkFolder inSystem() { return WorkFolder(Kind::System, "", ""); }

  /// Makes a hidden folder ".NAME.tmp.XXXXXX" beside an output. Folders that killed processes of
  /// this user have left for the same output are removed first.
  static WorkFolder beside(const std::string& output)
  {
    return WorkFolder(Kind::Beside, output, "");
  }

  /// Makes the folder ".NAME.part" beside an output. It may exist, left by an interrupted run, and
  /// is then kept until keep(false). Throws IOError also if another process uses it.
  static WorkFolder lasting(const std::string& output)
  {
    return WorkFolder(Kind::Lasting, output, "");
  }
  /// The path of the folder that lasting() makes.
  static std::string lastingPath(const std::string& output);

  /// Makes the folder `path`, or reuses it if it is empty or was made for the same purpose, a text
  /// that its mark holds. Its parent folder is made, too.
  static WorkFolder at(const std::string& path, const std::string& purpose)
  {
    return WorkFolder(Kind::Given, path, purpose);
  }

  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::string& path() const { return this->Path; }

  bool isKept() const { return this->Kept; }
  /// Sets whether the folder stays when this object or the process ends.
  void keep(bool kept = true);
  /// Keeps the folder, and takes its mark away: it belongs to the user, and no run removes it.
  void giveUp();
  /// Removes the files that runs write, but not the folder.
  void clear() { clearWorkFolder(this->Path); }
  /// From now on messages show paths in the folder `inside` as paths in `final`.
  void showAs(const std::string& inside, const std::string& final)
  {
    this->Listed.showAs(inside, final);
  }

private:
  enum class Kind
  {
    System,
    Beside,
    Lasting,
    Given
  };
  WorkFolder(Kind kind, const std::string& where, const std::string& purpose);
  void makeUnique(const std::string& start, const std::string& output);
  void openLasting(const std::string& output);

  std::string Path;
  TemporaryPath Listed;
  bool HasOnlyOurs = false; ///< all that is in the folder may be removed
  bool Kept = false;
  std::optional<OutputFile> Lock; ///< the folder, locked while it is open
};

} // namespace tipp

#endif

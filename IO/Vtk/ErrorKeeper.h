// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippErrorKeeper_h
#define tippErrorKeeper_h

#include "vtkCommand.h"
#include "vtkTIPPIOModule.h"

#include <string>
#include <vector>

namespace tipp
{

/// Observes ErrorEvent and WarningEvent: keeps the texts instead of printing them, without the
/// source file, line, class and address that VTK puts before them.
class VTKTIPPIO_EXPORT ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }

  void Execute(vtkObject*, unsigned long event, void* text) override;

  /// The first one, which says most; empty if there was none.
  std::string message() const { return this->Messages.empty() ? "" : this->Messages.front(); }

  bool HasError = false;
  std::vector<std::string> Messages;
};

/// What VTK's text "ERROR: In file, line n\nclass (address): what went wrong\n\n" says, in one
/// line.
VTKTIPPIO_EXPORT std::string plainMessage(const std::string& text);

} // namespace tipp

#endif

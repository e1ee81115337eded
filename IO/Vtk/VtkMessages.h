// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippVtkMessages_h
#define tippVtkMessages_h

#include "Files/IOError.h"
#include "vtkTIPPIOModule.h"

#include "vtkCommand.h"

#include <set>
#include <string>
#include <vector>

class vtkFieldData;

namespace tipp
{

/// Observes ErrorEvent and WarningEvent: collects the messages instead of printing them, without
/// the prefix of source file, line, class and address.
class VTKTIPPIO_EXPORT ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }

  void Execute(vtkObject*, unsigned long event, void* text) override;

  /// The first message, which is the most specific; empty if there was none.
  std::string message() const { return this->Messages.empty() ? "" : this->Messages.front(); }

  bool HasError = false;
  std::vector<std::string> Messages;
};

/// Extracts the message from VTK's "ERROR: In file, line n\nclass (address): message\n\n", on one
/// line.
VTKTIPPIO_EXPORT std::string plainMessage(const std::string& text);

/// The names of the arrays; unnamed ones are skipped.
VTKTIPPIO_EXPORT std::set<std::string> arrayNames(vtkFieldData* data);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippErrorKeeper_h
#define tippErrorKeeper_h

#include "vtkCommand.h"

#include <string>

namespace tipp
{

/// Observes ErrorEvent and WarningEvent: keeps the first text, which tells most, instead of
/// printing it.
class ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }

  void Execute(vtkObject*, unsigned long event, void* text) override
  {
    this->HasError = this->HasError || event == vtkCommand::ErrorEvent;
    if (this->Message.empty() && text)
    {
      this->Message = static_cast<const char*>(text);
    }
  }

  bool HasError = false;
  std::string Message;
};

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippErrorKeeper_h
#define tippErrorKeeper_h

#include "vtkCommand.h"

#include <string>

namespace tipp
{

/// Observes ErrorEvent: keeps the first error's text instead of printing it.
class ErrorKeeper : public vtkCommand
{
public:
  static ErrorKeeper* New() { return new ErrorKeeper; }

  void Execute(vtkObject*, unsigned long, void* text) override
  {
    if (this->Message.empty())
    {
      this->Message = text ? static_cast<const char*>(text) : "unknown error";
    }
  }

  std::string Message;
};

} // namespace tipp

#endif

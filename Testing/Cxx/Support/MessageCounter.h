// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMessageCounter_h
#define tippMessageCounter_h

#include "vtkCommand.h"

#include <string>

namespace tipp
{
namespace test
{

/// Observes VTK's error or warning events: counts them and keeps their texts instead of printing.
class MessageCounter : public vtkCommand
{
public:
  static MessageCounter* New() { return new MessageCounter; }
  void Execute(vtkObject*, unsigned long, void* text) override
  {
    ++this->Count;
    this->Text += text ? static_cast<const char*>(text) : "";
  }
  int Count = 0;
  std::string Text; ///< all texts, joined
};

} // namespace test
} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMessageCounter_h
#define tippMessageCounter_h

#include "vtkCommand.h"

#include <string>

namespace tipp
{
namespace test
{

/// Counts the errors or warnings that it is told of and keeps their texts instead of printing them.
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
  std::string Text; ///< of all
};

} // namespace test
} // namespace tipp

#endif

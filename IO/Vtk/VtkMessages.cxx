// SPDX-License-Identifier: BSD-3-Clause
#include "Vtk/VtkMessages.h"

#include "vtkAbstractArray.h"
#include "vtkFieldData.h"

#include <algorithm>
#include <cctype>
#include <regex>

namespace tipp
{

void ErrorKeeper::Execute(vtkObject*, unsigned long event, void* text)
{
  this->HasError = this->HasError || event == vtkCommand::ErrorEvent;
  const std::string message = plainMessage(text ? static_cast<const char*>(text) : "");
  // The pipeline's own message adds nothing to the error before it.
  const bool isEcho = message.find("returned failure for request") != std::string::npos;
  if (!message.empty() && !isEcho)
  {
    this->Messages.push_back(message);
  }
}

std::string plainMessage(const std::string& text)
{
  static const std::regex header("^(ERROR|Warning|Generic Warning): In .*, line [0-9]+\n");
  static const std::regex object("^[A-Za-z_]\\w* \\((0x)?[0-9a-fA-F]+\\): ");
  static const std::regex address(" ?\\((0x)?[0-9a-fA-F]{6,}\\)");
  std::string message = std::regex_replace(text, header, "");
  message = std::regex_replace(message, object, "");
  message.erase(std::min(message.find('\n'), message.size()));
  message = std::regex_replace(message, address, "");
  // Text from a damaged file may hold any bytes.
  std::replace_if(
    message.begin(), message.end(), [](unsigned char letter) { return std::iscntrl(letter) != 0; },
    '?');
  while (!message.empty() && std::isspace(static_cast<unsigned char>(message.back())) != 0)
  {
    message.pop_back();
  }
  return message;
}

std::set<std::string> arrayNames(vtkFieldData* data)
{
  std::set<std::string> names;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    const char* const name = data->GetAbstractArray(i)->GetName();
    if (name && *name)
    {
      names.insert(name);
    }
  }
  return names;
}

} // namespace tipp

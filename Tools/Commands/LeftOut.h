// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLeftOut_h
#define tippLeftOut_h

#include "Files/IOError.h"

#include <CLI/CLI.hpp>

#include <string>

namespace tipp
{

/// Adds a command that this build lacks: whatever its arguments are, it throws IOError with
/// `sentence`, which says what to do instead.
inline void addLeftOut(CLI::App& app, const std::string& name, const std::string& sentence)
{
  CLI::App* const command = app.add_subcommand(name, "(not in this build)");
  command->allow_extras();
  command->footer(sentence);
  command->callback([sentence] { throw IOError(sentence); });
}

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
// Replaces the command that needs the checker, in the Python wheel.
#include "Commands/Commands.h"
#include "Commands/LeftOut.h"

namespace tipp
{

void addCheckCommand(CLI::App& app, int&)
{
  addLeftOut(app, "check",
    "'tipp check' needs CGAL, and the wheel is built without it; in Python, "
    "tipp.check(points, triangles) does the same.");
}

} // namespace tipp

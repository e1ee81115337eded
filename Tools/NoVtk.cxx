// SPDX-License-Identifier: BSD-3-Clause
// Replaces everything that needs VTK, in a build without it: ranks, VTK's files, means and volumes.
#include "NoVtk.h"
#include "Commands/Commands.h"
#include "Commands/LeftOut.h"
#include "Commands/VtkFiles.h"
#include "Console/Process.h"

#include <stdexcept>
#include <string>

namespace tipp
{

void prepareVtk() {}

MpiSession::MpiSession()
{
  if (startedRank() >= 0)
  {
    throw std::runtime_error("this tipp was built without MPI and works on one rank; start it "
                             "without mpirun, which needs a build against a VTK with MPI.");
  }
}

MpiSession::~MpiSession() = default;

vtkMultiProcessController* MpiSession::controller() const
{
  return this->Controller;
}

bool MpiSession::isFirst() const
{
  return true;
}

int MpiSession::ranks() const
{
  return 1;
}

MeshPart readVtkPart(const std::string& path, int)
{
  refuseVtkMesh(path);
}

void flattenVtkFile(const std::string& path, const std::function<void(const Flattened& flattened)>&)
{
  refuseVtkMesh(path);
}

void addRemapCommand(CLI::App& app, int&)
{
  addLeftOut(app, "remap",
    "'tipp remap' needs VTK, and this tipp was built without it; in "
    "Python, tipp.remap(source, target) does the same.");
}

void addVolumeCommand(CLI::App& app, int&)
{
  addLeftOut(app, "volume",
    "'tipp volume' needs VTK, and this tipp was built without it; in Python, "
    "tipp.volume(before, after) does the same.");
}

} // namespace tipp

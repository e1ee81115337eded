// Replaces MpiTransport.cxx in a build without MPI.
#include "Messages/RankTransport.h"

#include "Partitioning/Ranks.h"

#include <stdexcept>

namespace tipp
{

std::unique_ptr<RankTransport> RankTransport::open(vtkMultiProcessController* controller)
{
  if (Ranks(controller).count() > 1)
  {
    throw std::invalid_argument("TIPP was built without MPI, so that it works on one rank alone; "
                                "build it with -DTIPP_USE_MPI=ON against a VTK that has MPI.");
  }
  return nullptr;
}

} // namespace tipp

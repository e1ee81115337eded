// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMpiSession_h
#define tippMpiSession_h

class vtkMultiProcessController;

namespace tipp
{

/// The rank that mpirun or a batch system started this process as; -1: none. Does not need MPI to
/// be initialised.
int startedRank();

/// Whether this process is a rank other than the first, which has no work in a command that runs on
/// the first rank only.
inline bool isIdleRank()
{
  return startedRank() > 0;
}

/// Initialises MPI for the object's lifetime if mpirun or a batch system started the process.
/// Throws std::runtime_error if that is so in a build without MPI.
class MpiSession
{
public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// Null for a process without MPI. Not owned by the caller.
  vtkMultiProcessController* controller() const;
  /// Whether this is the first rank, the one that prints messages.
  bool isFirst() const;

private:
  vtkMultiProcessController* Controller = nullptr;
};

} // namespace tipp

#endif

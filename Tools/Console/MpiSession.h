// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippMpiSession_h
#define tippMpiSession_h

class vtkMultiProcessController;

namespace tipp
{

/// The rank that mpirun or a batch system started this process as; -1: none. Known before MPI is.
int startedRank();

/// Whether this process is a rank with nothing to do in a command that the first one does alone.
inline bool isIdleRank()
{
  return startedRank() > 0;
}

/// MPI while this lives, if mpirun or a batch system has started the process; else nothing. Throws
/// std::runtime_error if that is so in a build without MPI.
class MpiSession
{
public:
  MpiSession();
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  /// Null for a process alone.
  vtkMultiProcessController* controller() const;
  /// Of all ranks, the one that speaks.
  bool isFirst() const;

private:
  vtkMultiProcessController* Controller = nullptr;
};

} // namespace tipp

#endif

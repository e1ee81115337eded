// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippCompatibility_h
#define tippCompatibility_h

// What differs between the VTK releases that the filters are built against.

#include "vtkAlgorithm.h"

namespace tipp
{
namespace compatibility
{

// VTK 9.3 and ParaView 5.11 also stop when a filter upstream or downstream was aborted.
template <typename Algorithm>
auto abortRequested(Algorithm* algorithm, int) -> decltype(algorithm->CheckAbort())
{
  return algorithm->CheckAbort();
}

template <typename Algorithm>
bool abortRequested(Algorithm* algorithm, long)
{
  return algorithm->GetAbortExecute() != 0;
}

} // namespace compatibility

/// Whether the user asked the running algorithm to stop.
inline bool abortRequested(vtkAlgorithm* algorithm)
{
  return compatibility::abortRequested(algorithm, 0);
}

} // namespace tipp

#endif

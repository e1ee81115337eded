// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDescribeArrays_h
#define tippDescribeArrays_h

#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"

#include <vector>

namespace tipp
{

/// Gives `result` the flat mesh's attributes as its arrays, one for each step of those that vary in
/// time, and returns where they lie, in the same order. Throws IOError where two names would be the
/// same in the pieces.
std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result);

} // namespace tipp

#endif

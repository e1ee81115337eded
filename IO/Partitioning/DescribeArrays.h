// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippDescribeArrays_h
#define tippDescribeArrays_h

#include "Flat/FlatMesh.h"
#include "Partitioned/PartitionedMesh.h"

#include <vector>

namespace tipp
{

/// Lists the flat mesh's attributes in result.Arrays, one for each step of those that vary in time,
/// and returns their arrays in the same order. Throws IOError if two names would be equal in the
/// pieces.
std::vector<RawArray> describeArrays(const FlatMesh& mesh, PartitionedMesh& result);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippOpenSeries_h
#define tippOpenSeries_h

#include "Series/MeshSeries.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace tipp
{

/// Opens the output of a model, or a flat or partitioned mesh of triangles. Throws IOError.
std::unique_ptr<MeshSeries> openSeries(const std::string& path, const SeriesOptions& options);

/// Whether a text is one number of a time step, or empty.
bool isOneStep(const std::string& text);

/// Returns what is wrong with a text for parseSteps(); empty if it is right.
std::string checkSteps(const std::string& text);

/// Returns the numbers of the time steps that a text asks for, of the `count` steps of the file
/// `path`: "N", "all" or "FIRST:LAST:STRIDE", where each may be left out, and LAST is included. An
/// empty text is step 0. Throws IOError if there is no such step.
std::vector<std::size_t> parseSteps(
  const std::string& text, std::size_t count, const std::string& path);

} // namespace tipp

#endif

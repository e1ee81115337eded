// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippSeriesReport_h
#define tippSeriesReport_h

namespace tipp
{

class MeshSeries;

/// Warns of each variable that the output of a model has and `series` does not offer, with the
/// reason.
void warnOfVariablesLeftOut(const MeshSeries& series);

/// Prints the mesh, its variables, the time steps, and what is left out.
void describeSeries(MeshSeries& series);

} // namespace tipp

#endif

// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippLoaders_h
#define tippLoaders_h

#include "Loading/ArrayFiles.h"

namespace tipp
{

/// One function per kind of Loader, over the same files; `m` is at least 1.
std::unique_ptr<VertexLoader> makeDirectLoader(ArrayFiles files, std::int64_t m, int threads);
std::unique_ptr<VertexLoader> makeFineLoader(ArrayFiles files, std::int64_t m, int threads);
std::unique_ptr<VertexLoader> makeLruLoader(ArrayFiles files, std::int64_t m, std::int64_t blocks);
std::unique_ptr<VertexLoader> makeMmapLoader(ArrayFiles files, int threads);

} // namespace tipp

#endif

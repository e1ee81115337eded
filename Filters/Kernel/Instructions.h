// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInstructions_h
#define tippInstructions_h

namespace tipp
{

/// Which of the processor's instructions the kernel may use. The triangles are the same, bit for
/// bit: no multiplication and addition are contracted in either.
enum class Instructions
{
  Common, ///< what every processor of the architecture has
  Best    ///< what this one has
};

#ifdef __x86_64__
/// Whether code compiled for AVX2 and the bit manipulations that came with it may run.
inline bool hasAvx2(Instructions instructions)
{
  return instructions == Instructions::Best && __builtin_cpu_supports("avx2") &&
    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
#endif

} // namespace tipp

#endif

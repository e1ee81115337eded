// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInstructions_h
#define tippInstructions_h

namespace tipp
{

/// Which instruction set the kernel may use. The triangles are identical, bit for bit: neither
/// version contracts a multiplication and an addition.
enum class Instructions
{
  Common, ///< the architecture's baseline
  Best    ///< the best one that this processor supports
};

#ifdef __x86_64__
/// Whether code compiled for AVX2, BMI and BMI2 may run.
inline bool hasAvx2(Instructions instructions)
{
  return instructions == Instructions::Best && __builtin_cpu_supports("avx2") &&
    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
#endif

} // namespace tipp

#endif

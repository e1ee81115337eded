// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInstructions_h
#define tippInstructions_h

namespace tipp
{

/// Which instruction set work may use. The results are identical, bit for bit: no version contracts
/// a multiplication and an addition.
enum class Instructions
{
  Common, ///< the architecture's baseline
  Avx2,   ///< at most AVX2
  Best    ///< the best one that this processor supports
};

/// @name Running work() compiled for an instruction set
/// `flatten` inlines all calls into these functions, so that everything is compiled for it.
///@{
template <typename Work>
[[gnu::flatten]] void runCommon(const Work& work)
{
  work();
}
#ifdef __x86_64__
template <typename Work>
[[gnu::flatten, gnu::target("avx2,bmi,bmi2")]] void runAvx2(const Work& work)
{
  work();
}
template <typename Work>
[[gnu::flatten, gnu::target("avx2,bmi,bmi2,avx512f,avx512vl,avx512dq")]] void runAvx512(
  const Work& work)
{
  work();
}
#endif

/// Uses AVX2 if it can. AVX-512 would gain nothing where 16 registers suffice, and would be one
/// more version of the code.
template <typename Work>
void runWith(Instructions instructions, const Work& work)
{
#ifdef __x86_64__
  if (instructions != Instructions::Common && __builtin_cpu_supports("avx2") &&
    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2"))
  {
    runAvx2(work);
    return;
  }
#endif
  static_cast<void>(instructions);
  runCommon(work);
}

/// Like runWith(), but uses AVX-512 if it can, for its 32 registers. For work on pairs of doubles:
/// with AVX-512's wider vectors, some processors lower their clock.
template <typename Work>
void runWithManyRegisters(Instructions instructions, const Work& work)
{
#ifdef __x86_64__
  if (instructions == Instructions::Best && __builtin_cpu_supports("avx512vl") &&
    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("bmi") &&
    __builtin_cpu_supports("bmi2"))
  {
    runAvx512(work);
    return;
  }
#endif
  runWith(instructions, work);
}
///@}

} // namespace tipp

#endif

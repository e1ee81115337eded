// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippInstructions_h
#define tippInstructions_h

namespace tipp
{

/// Which instruction set work may use. The results are identical, bit for bit: neither version
/// contracts a multiplication and an addition.
enum class Instructions
{
  Common, ///< the architecture's baseline
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
#endif

template <typename Work>
void runWith(Instructions instructions, const Work& work)
{
#ifdef __x86_64__
  if (instructions == Instructions::Best && __builtin_cpu_supports("avx2") &&
    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2"))
  {
    runAvx2(work);
    return;
  }
#endif
  static_cast<void>(instructions);
  runCommon(work);
}
///@}

} // namespace tipp

#endif

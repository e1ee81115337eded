// SPDX-License-Identifier: BSD-3-Clause
#ifndef tippReadOrder_h
#define tippReadOrder_h

#include <cstddef>
#include <map>
#include <optional>

namespace tipp
{

/// Learns in which order a caller reads variables and steps, to expect the next one.
class ReadOrder
{
public:
  struct Item
  {
    std::size_t Variable = 0;
    std::size_t Step = 0;
  };

  void add(std::size_t variable, std::size_t step)
  {
    if (this->Last && step >= this->Last->Step)
    {
      this->After[this->Last->Variable] = { variable, step - this->Last->Step };
    }
    this->Last = Item{ variable, step };
  }

  /// What followed the variable when it was last read, at the step that corresponds.
  std::optional<Item> next(std::size_t variable, std::size_t step) const
  {
    const auto found = this->After.find(variable);
    return found == this->After.end()
      ? std::nullopt
      : std::make_optional(Item{ found->second.Variable, step + found->second.Step });
  }

private:
  std::optional<Item> Last;
  std::map<std::size_t, Item> After; ///< Step: the number of steps from one to the other
};

} // namespace tipp

#endif

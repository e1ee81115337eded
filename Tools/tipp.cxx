// SPDX-License-Identifier: BSD-3-Clause
#include "Commands/RunTool.h"

int main(int argc, char** argv)
{
  return tipp::runTool(argc, argv);
}

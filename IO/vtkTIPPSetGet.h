// SPDX-License-Identifier: BSD-3-Clause
/**
 * @file vtkTIPPSetGet.h
 * @brief macros that combine those of vtkSetGet.h
 */

#ifndef vtkTIPPSetGet_h
#define vtkTIPPSetGet_h

#include "vtkSetGet.h"

/// Declares SetName(), GetName(), NameOn() and NameOff().
#define vtkTIPPSwitchMacro(name, type)                                                             \
  vtkSetMacro(name, type);                                                                         \
  vtkGetMacro(name, type);                                                                         \
  vtkBooleanMacro(name, type)

/// Declares SetName(), which clamps the value to [min, max], and GetName().
#define vtkTIPPClampedMacro(name, type, min, max)                                                  \
  vtkSetClampMacro(name, type, min, max);                                                          \
  vtkGetMacro(name, type)

#endif

/* SPDX-License-Identifier: MIT */
/* The name of laws.h in version 1.0. */
#include "laws.h"

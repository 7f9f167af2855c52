/* Every search is the full one. */
#define CLU_FULL_SEARCH
#include "full/kernels/quick.h"

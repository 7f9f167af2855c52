/* The kernels' C core in double, as C++: what is eight doubles wide has operators of its own there (halves.h). */
#include "kernels/native.c"

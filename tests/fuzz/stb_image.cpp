// The library's reader once more, compiled here so that the fuzzers see into it: Debian's libstb is not instrumented.
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>

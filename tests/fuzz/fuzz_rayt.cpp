#include "tests/fuzz/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    clucida::fuzz::try_text(data, size, clucida::scene::Format::rayt);
    return 0;
}

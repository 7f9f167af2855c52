/// Photographs of scenes. They are read from files: here from one that has no name and lies in memory.
#include "scene/error.h"
#include "scene/photograph.h"
#include "tests/fuzz/picture_size.h"

#include <cstdlib>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace {

void write_file(int file, const std::uint8_t* data, std::size_t size)
{
    if (ftruncate(file, 0) != 0) std::abort();
    for (std::size_t done = 0; done < size;) {
        const ssize_t n = pwrite(file, data + done, size - done, static_cast<off_t>(done));
        if (n <= 0) std::abort();
        done += static_cast<std::size_t>(n);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace clucida::scene;
    if (clucida::fuzz::too_large(data, size)) return 0;
    static const int file = memfd_create("photograph", 0);
    if (file < 0) std::abort();
    write_file(file, data, size);
    Photograph photograph;
    photograph.path = "photograph";
    photograph.file = "/proc/self/fd/" + std::to_string(file);
    try {
        const Texels texels = load_photograph(photograph);
        if (texels.width < 1 || texels.height < 1) std::abort();
        if (texels.rgb.size() != std::size_t{texels.width} * texels.height) std::abort();
    } catch (const Error&) { // not a photograph
    }
    return 0;
}

/// Pictures that `compare` reads. What was read is written and read again without loss.
#include "host/errors.h"
#include "host/picture_file.h"
#include "tests/fuzz/picture_size.h"

#include <cstdlib>
#include <cstring>

namespace {

using namespace clucida::host;

bool same_bits(const Picture& a, const Picture& b)
{
    return a.width == b.width && a.height == b.height && a.rgb.size() == b.rgb.size() &&
           std::memcmp(a.rgb.data(), b.rgb.data(), a.rgb.size() * sizeof(float)) == 0;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (clucida::fuzz::too_large(data, size)) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    try {
        const Picture picture = decode(bytes, "picture");
        if (picture.rgb.size() != std::size_t{3} * picture.width * picture.height) std::abort();
        if (!same_bits(picture, decode(encode(picture, FileFormat::pfm), "again"))) std::abort();
    } catch (const Failure&) { // not a picture
    }
    return 0;
}

#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/picture_file.h"
#include "scene/picture_check.h"
#include "scene/pnm.h"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <bit>
#include <climits>
#include <cstring>
#include <memory>
#include <sstream>

namespace clucida::host {
namespace {

struct FreeStb {
    void operator()(void* p) const { stbi_image_free(p); }
};
template <class T>
using StbArray = std::unique_ptr<T, FreeStb>;

/// A table from samples to linear light.
std::vector<float> linear_table(unsigned levels, Transfer transfer)
{
    std::vector<float> table(levels);
    for (unsigned i = 0; i < levels; ++i) {
        const double x = static_cast<double>(i) / (levels - 1);
        table[i] = static_cast<float>(transfer == Transfer::srgb ? srgb_decode(x) : x);
    }
    return table;
}

template <class T>
Picture from_samples(const T* samples, int width, int height, unsigned levels, Transfer transfer)
{
    const auto table = linear_table(levels, transfer);
    Picture picture = make_picture(static_cast<unsigned>(width), static_cast<unsigned>(height));
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = table[samples[i]];
    return picture;
}

Picture from_floats(const float* samples, int width, int height)
{
    Picture picture = make_picture(static_cast<unsigned>(width), static_cast<unsigned>(height));
    std::copy(samples, samples + picture.rgb.size(), picture.rgb.begin());
    return picture;
}

float swapped(float value)
{
    auto bits = std::bit_cast<std::uint32_t>(value);
    bits = bits >> 24 | (bits >> 8 & 0xff00) | (bits << 8 & 0xff0000) | bits << 24;
    return std::bit_cast<float>(bits);
}

Picture decode_pfm(std::string_view bytes, const std::string& name)
{
    std::istringstream header(std::string(bytes.substr(0, 256)));
    std::string magic;
    unsigned width = 0, height = 0;
    double scale = 0;
    header >> magic >> width >> height >> scale;
    if (!header || width < 1 || height < 1 || width > 65536 || height > 65536 || scale == 0)
        throw Failure(fmt::format("{}: the header of the float map is wrong", name));
    const std::size_t begin = static_cast<std::size_t>(header.tellg()) + 1;
    const std::size_t row = std::size_t{3} * width * sizeof(float);
    if (bytes.size() < begin || bytes.size() - begin < row * height)
        throw Failure(fmt::format("{}: the float map is cut short", name));
    Picture picture = make_picture(width, height);
    for (std::size_t y = 0; y < height; ++y)
        std::memcpy(picture.rgb.data() + y * 3 * width, bytes.data() + begin + (height - 1 - y) * row, row);
    if (scale > 0)
        for (float& v : picture.rgb) v = swapped(v);
    return picture;
}

Picture decode_pnm(std::string_view bytes, const std::string& name, Transfer transfer)
{
    const scene::Pnm pnm = scene::read_pnm(bytes);
    if (!pnm.fault.empty()) throw Failure(fmt::format("{}: {}", name, pnm.fault));
    return from_samples(pnm.samples.data(), static_cast<int>(pnm.width), static_cast<int>(pnm.height), pnm.most + 1,
                        transfer);
}

} // namespace

Picture decode(std::string_view bytes, const std::string& name, Transfer transfer)
{
    if (bytes.substr(0, 2) == "PF") return decode_pfm(bytes, name);
    if (scene::is_pnm(bytes)) return decode_pnm(bytes, name, transfer);
    if (bytes.size() > INT_MAX) throw Failure(fmt::format("{}: the file is too large", name));
    if (const std::string fault = scene::picture_fault(bytes); !fault.empty())
        throw Failure(fmt::format("{}: not a picture that can be read ({})", name, fault));
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    if (stbi_is_hdr_from_memory(data, size)) {
        const StbArray<float> pixels(stbi_loadf_from_memory(data, size, &width, &height, &channels, 3));
        if (pixels) return from_floats(pixels.get(), width, height);
    } else if (stbi_is_16_bit_from_memory(data, size)) {
        const StbArray<stbi_us> pixels(stbi_load_16_from_memory(data, size, &width, &height, &channels, 3));
        if (pixels) return from_samples(pixels.get(), width, height, 65536, transfer);
    } else {
        const StbArray<stbi_uc> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 3));
        if (pixels) return from_samples(pixels.get(), width, height, 256, transfer);
    }
    throw Failure(fmt::format("{}: not a picture that can be read ({})", name, stbi_failure_reason()));
}

Picture read_picture(const std::filesystem::path& file, Transfer transfer)
{
    return decode(read_file(file), file.string(), transfer);
}

} // namespace clucida::host
